// SPDX-License-Identifier: MIT
// Writes what a run came to.
#pragma once

#include "exit_code.hpp"
#include "frames.hpp"
#include "last_shape.hpp"
#include "options.hpp"
#include "summary.hpp"
#include <axistokes/io/csv.hpp>
#include <axistokes/io/vtk.hpp>
#include <axistokes/io/wall_stress.hpp>

#include <cmath>
#include <filesystem>
#include <vector>

namespace examples {

/// Writes summary.json, shape.csv, history.csv and what else was asked for; nothing without a directory.
template <class Simulator>
void write_results(const Simulator& simulator, const Ending<Simulator>& ending, const RunOptions& options,
                   const Frames& frames, const nlohmann::ordered_json& summary) {
    if (options.directory.empty()) {
        return;
    }
    const std::filesystem::path directory(options.directory);
    const auto& configuration = ending.result.configuration;
    const auto& instant = ending.result.instant;
    const std::vector<axistokes::Column<double>> shape = last_shape_columns(configuration, instant);
    axistokes::write_csv(directory / "shape.csv", shape);
    axistokes::write_csv(directory / "history.csv", axistokes::history_columns(simulator.history()));
    if (!frames.empty()) {
        axistokes::write_csv(directory / "frames.csv", frames.columns());
    }
    if (instant && std::isfinite(simulator.scene().gap({0, configuration.position}))) {
        const double radius = simulator.scene().gap({0, configuration.position});
        const auto wall = axistokes::wall_stress(simulator.scene(), configuration, *instant, 3 * radius);
        axistokes::write_csv(directory / "wall.csv",
                             std::vector<axistokes::Column<double>>{
                                 {"z", wall.z}, {"shear_stress", wall.shear}, {"pressure", wall.pressure}});
    }
    if (options.vtk) {
        axistokes::write_vtk_surface(directory / "surface.vtp", shape);
    }
    if (options.flow_field && instant) {
        axistokes::write_vtk_flow(directory / "flow.vts",
                                  axistokes::flow_field(simulator.scene(), configuration, *instant), instant->velocity);
    }
    // Last: a summary means that the other files are there.
    axistokes::write_atomically(directory / "summary.json", [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
}

/// Writes and prints; the exit code. Throws SimulationFailure if the run ended with one.
template <class Simulator>
int conclude(const Simulator& simulator, const Ending<Simulator>& ending, const RunOptions& options,
             const Frames& frames, const nlohmann::ordered_json& summary) {
    write_results(simulator, ending, options, frames, summary);
    print(summary, options.directory);
    if (!ending.failure.empty()) {
        throw axistokes::SimulationFailure(ending.failure);
    }
    return ending.result.interrupted ? interrupted : success;
}

}  // namespace examples
