// SPDX-License-Identifier: MIT
// The result of a run in a few numbers: as JSON and on the screen.
#pragma once

#include <axistokes/scene.hpp>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

namespace examples {

/// What a run came to, by whatever way, and how long it took.
template <class Simulator>
struct Ending {
    axistokes::Configuration<double> configuration;
    std::optional<typename Simulator::InstantType> instant;
    std::optional<double> velocity;
    std::optional<double> residual;
    double pressure_drop = 0;
    bool stationary = false;
    std::string failure;  // the cause, or empty
    bool interrupted = false;
    double wall_seconds = 0;

    /// Of the simulator's last step, its last good one if it failed. Velocities are those of the shape it ended with: a
    /// step's own are those it started from.
    void take(Simulator& simulator) {
        configuration = simulator.configuration();
        try {
            instant = simulator.instant();
        } catch (const axistokes::SimulationFailure&) {
            // Reported already: the run cannot have ended well on such a shape.
        }
        stationary = simulator.stationary();
        if (!simulator.history().empty()) {
            const auto& last = simulator.history().back();
            velocity = last.velocity;
            residual = last.residual;
            pressure_drop = last.pressure_drop;
        }
        if (instant) {
            velocity = instant->velocity;
            pressure_drop = instant->pressure_drop;
        }
    }
};

template <class Simulator>
nlohmann::ordered_json summarize(const Simulator& simulator, const Ending<Simulator>& ending) {
    const auto& configuration = ending.configuration;
    const auto& shape = configuration.shape;
    const auto& discretization = simulator.scene().discretization();
    const axistokes::Measures<double> measures = discretization.measures(shape);
    const auto [bottom, top] = discretization.pole_curvatures(shape);
    const auto& history = simulator.history();

    nlohmann::ordered_json summary;
    if (ending.velocity) {
        summary["velocity"] = *ending.velocity;
        summary["lag"] = *ending.velocity - simulator.scene().centreline_velocity(configuration.position);
    }
    summary["length"] = shape.z[shape.nodes() - 1] - shape.z[0];
    summary["max_radius"] = discretization.max_radius(shape);
    summary["curvature_top"] = top;
    summary["curvature_bottom"] = bottom;
    summary["bending_energy"] = discretization.bending_energy(shape);
    summary["area"] = measures.area;
    summary["volume"] = measures.volume;
    summary["reduced_volume"] = measures.reduced_volume();
    summary["area_drift"] = measures.area / simulator.initial_area() - 1;
    summary["volume_drift"] = measures.volume / simulator.initial_volume() - 1;
    summary["stationary"] = ending.stationary;
    summary["time"] = history.empty() ? 0.0 : history.back().time;
    summary["steps"] = history.size();
    summary["elements"] = shape.elements();
    summary["wall_seconds"] = ending.wall_seconds;
    summary["position"] = configuration.position;
    if (ending.residual) {
        summary["residual"] = *ending.residual;
    }
    if (!ending.failure.empty()) {
        summary["failure"] = ending.failure;
    }
    if (ending.interrupted) {
        summary["interrupted"] = true;
    }
    return summary;
}

/// A summary as aligned lines: first how the run ended, then the numbers.
inline void print(const nlohmann::ordered_json& summary, const std::string& directory) {
    const bool stationary = summary.at("stationary").get<bool>();
    const std::string state = summary.contains("failure")       ? "FAILED"
                              : summary.contains("interrupted") ? "interrupted"
                              : stationary                      ? "stationary"
                                                                : "not stationary";
    std::cout << state << " after " << summary.at("steps") << " steps, time " << std::setprecision(6)
              << summary.at("time").get<double>() << ", " << std::setprecision(2)
              << summary.at("wall_seconds").get<double>() << " s\n"
              << std::setprecision(8);
    for (const auto& [key, value] : summary.items()) {
        const bool shown = key != "stationary" && key != "steps" && key != "time" && key != "wall_seconds";
        if (shown && value.is_number()) {
            std::cout << "  " << std::left << std::setw(22) << key << std::right << std::setw(16);
            value.is_number_float() ? std::cout << value.get<double>() : std::cout << value;
            std::cout << '\n';
        }
    }
    if (!directory.empty()) {
        std::cout << "written to " << directory << '\n';
    }
}

}  // namespace examples
