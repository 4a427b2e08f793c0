// SPDX-License-Identifier: MIT
// The result of a run in a few numbers: as JSON and on the screen.
#pragma once

#include <axistokes/geometry/curvature.hpp>
#include <axistokes/geometry/meridian_spline.hpp>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

namespace examples {

/// How a run came to its end, and how long it took.
struct Ending {
    std::string failure;  // the cause, or empty
    bool interrupted = false;
    double wall_seconds = 0;
};

/// Geometry is that of the last good shape; velocities are those of the last step, or of the initial shape if there was
/// none.
template <class Simulator, class InstantType>
nlohmann::ordered_json summarize(const Simulator& simulator, const std::optional<InstantType>& instant,
                                 const Ending& ending) {
    const auto& configuration = simulator.configuration();
    const auto& shape = configuration.shape;
    const axistokes::MeridianSpline<double> spline(shape);
    const axistokes::Measures<double> measures = spline.measures();
    const axistokes::Vector<double> curvature = axistokes::principal_curvatures(shape).meridional;
    const auto& history = simulator.history();

    nlohmann::ordered_json summary;
    if (!history.empty() || instant) {
        const double velocity = history.empty() ? instant->velocity : history.back().velocity;
        summary["velocity"] = velocity;
        summary["lag"] = velocity - simulator.scene().centreline_velocity(configuration.position);
    }
    summary["length"] = shape.z[shape.nodes() - 1] - shape.z[0];
    summary["max_radius"] = spline.max_radius();
    summary["curvature_top"] = curvature[shape.nodes() - 1];
    summary["curvature_bottom"] = curvature[0];
    summary["bending_energy"] = axistokes::bending_energy(shape);
    summary["area"] = measures.area;
    summary["volume"] = measures.volume;
    summary["reduced_volume"] = measures.reduced_volume();
    summary["area_drift"] = measures.area / simulator.initial_area() - 1;
    summary["volume_drift"] = measures.volume / simulator.initial_volume() - 1;
    summary["stationary"] = simulator.stationary();
    summary["time"] = history.empty() ? 0.0 : history.back().time;
    summary["steps"] = history.size();
    summary["elements"] = shape.elements();
    summary["wall_seconds"] = ending.wall_seconds;
    summary["position"] = configuration.position;
    if (!history.empty()) {
        summary["residual"] = history.back().residual;
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
            std::cout << "  " << std::left << std::setw(18) << key << std::right << std::setw(16);
            value.is_number_float() ? std::cout << value.get<double>() : std::cout << value;
            std::cout << '\n';
        }
    }
    if (!directory.empty()) {
        std::cout << "written to " << directory << '\n';
    }
}

}  // namespace examples
