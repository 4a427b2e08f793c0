// SPDX-License-Identifier: MIT
// What a run came to: a summary in a few numbers, on the screen and as JSON, and tables.
#pragma once

#include "driver.hpp"
#include "frames.hpp"
#include "options.hpp"
#include <axistokes/io/csv.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <exception>
#include <string>
#include <vector>

namespace examples {

struct Ending {
    Driver::Result result;
    std::string failure;       // the cause, or empty
    std::exception_ptr error;  // likewise
    double wall_seconds = 0;
};

/// Runs; a failure of the simulation is part of the ending, and so is a step that cannot be recorded, which interrupts
/// the run. `begin`: when what it took began.
Ending run_to_the_end(Driver& driver, std::chrono::steady_clock::time_point begin);

/// Relative error of the first body's velocity that a meshed wall leaves, from the usual one of a tenth of the
/// tolerance; 0 without such a wall.
double wall_error(const Simulation& simulation, const Driver::Result& result, const Surroundings& surroundings);

/// The last shape as a table. Without an instant (null: the shape may be the cause of a failure) at least the nodes.
std::vector<axistokes::Column<double>> last_shape_columns(const axistokes::Configuration<double>& configuration,
                                                          const Simulation::InstantType* instant);

/// Keys of how good a run's result is and how it ended. The estimate is null where there is none: the JSON format has
/// no infinity.
void describe_ending(const Ending& ending, nlohmann::ordered_json& summary);

/// Keys that every run of one body has.
nlohmann::ordered_json summarize(const Simulation& simulation, const Ending& ending);

/// Of a particle in a tube (docs/gallery.md, "The summary of a scene in a tube"): the film (R0), the pressure drop that
/// the particle adds (kappa/R0^3) and, in a flow of the given mean velocity V, that drop in eta V/Rc, the mobility U/V,
/// the ratio of tube to discharge haematocrit V/U, the viscosity relative to the fluid's of a piece of tube as long as
/// the particle, and the intrinsic one (the relative increase over the volume fraction, whatever the length); of a
/// meshed wall also its panels, without those on the ends, and all its nodes.
nlohmann::ordered_json tube_summary(const Simulation& simulation, const Ending& ending, double mean_velocity);

/// A summary as aligned lines: first how the run ended, then the numbers.
void print(const nlohmann::ordered_json& summary, const std::string& directory);

/// Once the results are written: deletes the journal, if there is one, unless the run can be gone on with. The exit
/// code; throws the error that ended the run.
int finish(bool unfinished, const std::exception_ptr& error, Journal* journal);

/// Writes, prints and finishes: summary.json, shape.csv, history.csv and what else was asked for; nothing without a
/// directory.
int conclude(const Simulation& simulation, const Ending& ending, const RunOptions& options, const Frames& frames,
             const nlohmann::ordered_json& summary, Journal* journal);

}  // namespace examples
