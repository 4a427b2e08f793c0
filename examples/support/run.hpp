// SPDX-License-Identifier: MIT
// Runs a simulator to its end, whatever that is, and writes what there is to write.
#pragma once

#include "frames.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "summary.hpp"
#include <axistokes/io/csv.hpp>
#include <axistokes/io/vtk.hpp>

#include <chrono>
#include <optional>
#include <sstream>
#include <string>

namespace examples {

/// Writes summary.json, shape.csv, history.csv and what else was asked for; nothing without a directory.
template <class Simulator, class InstantType>
void write_results(const Simulator& simulator, const std::optional<InstantType>& instant, const RunOptions& options,
                   const Frames& frames, const nlohmann::ordered_json& summary) {
    if (options.directory.empty()) {
        return;
    }
    const std::filesystem::path directory(options.directory);
    using Scalar = typename Simulator::Scalar;
    const auto& configuration = simulator.configuration();
    // Without velocities and forces (the last shape may be the cause of a failure) at least the shape.
    const std::vector<axistokes::Column<Scalar>> shape =
        instant ? axistokes::shape_columns(configuration, *instant)
                : std::vector<axistokes::Column<Scalar>>{{"r", configuration.shape.r}, {"z", configuration.shape.z}};
    axistokes::write_csv(directory / "shape.csv", shape);
    axistokes::write_csv(directory / "history.csv", axistokes::history_columns(simulator.history()));
    if (!frames.empty()) {
        axistokes::write_csv(directory / "frames.csv", frames.columns());
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

/// `details(simulator, instant)` gives further keys of the summary.
template <class Simulator, class Details>
int run_to_end(Simulator& simulator, const RunOptions& options, const nlohmann::ordered_json& parameters,
               const Details& details) {
    if (!options.directory.empty()) {
        axistokes::create_output_directory(options.directory);  // better now than after the run
    }
    const auto begin = std::chrono::steady_clock::now();
    Ending ending;
    FramesAt kept(options.frame_times);
    kept.visit(0, simulator);
    {
        const InterruptGuard guard;
        ProgressBar bar;
        Approach approach(simulator.params().tolerance);
        const auto observe = [&](const auto& record) {
            const double by_time = record.time / simulator.params().longest_time;
            const double by_steps =
                static_cast<double>(record.step) / static_cast<double>(simulator.params().most_steps);
            std::ostringstream text;
            text << "step " << record.step << "  time " << record.time << "  residual " << record.residual;
            kept.visit(record.time, simulator);
            bar.show(std::max({approach.fraction(record.residual), by_time, by_steps}), text.str());
            ending.interrupted = guard.interrupted();
            return !ending.interrupted;
        };
        try {
            simulator.run(observe);
        } catch (const axistokes::SimulationFailure& failure) {
            ending.failure = failure.what();
        }
    }
    ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

    std::optional<typename Simulator::InstantType> instant;
    try {
        instant = simulator.instant();
    } catch (const axistokes::SimulationFailure&) {
        // Reported already: the run cannot have ended well on such a shape.
    }
    nlohmann::ordered_json summary = summarize(simulator, instant, ending);
    if (instant) {
        summary.update(details(simulator, *instant));
    }
    summary["parameters"] = parameters;
    write_results(simulator, instant, options, kept.frames(), summary);
    print(summary, options.directory);
    if (!ending.failure.empty()) {
        throw axistokes::SimulationFailure(ending.failure);
    }
    return ending.interrupted ? interrupted : success;
}

template <class Simulator>
int run_to_end(Simulator& simulator, const RunOptions& options, const nlohmann::ordered_json& parameters) {
    return run_to_end(simulator, options, parameters,
                      [](const auto&, const auto&) { return nlohmann::ordered_json::object(); });
}

}  // namespace examples
