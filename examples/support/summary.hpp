// SPDX-License-Identifier: MIT
// The result of a run in a few numbers: as JSON and on the screen.
#pragma once

#include <axistokes/accuracy/driver.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

namespace examples {

/// What a run came to, and how long it took.
template <class Simulator>
struct Ending {
    axistokes::DriverResult<Simulator> result;
    std::string failure;  // the cause, or empty
    double wall_seconds = 0;
};

/// Keys that every run has. The estimate is null where there is none: the JSON format has no infinity.
template <class Simulator>
nlohmann::ordered_json summarize(const Simulator& simulator, const Ending<Simulator>& ending) {
    const auto& result = ending.result;
    const auto& configuration = result.configuration;
    const auto& shape = configuration.shape;
    const auto& discretization = simulator.scene().discretization();
    const axistokes::Measures<double> measures = discretization.measures(shape);
    const auto [bottom, top] = discretization.pole_curvatures(shape);

    nlohmann::ordered_json summary;
    if (result.velocity) {
        summary["velocity"] = *result.velocity;
        summary["lag"] = *result.velocity - simulator.scene().centreline_velocity(configuration.position);
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
    summary["stationary"] = result.stationary;
    summary["time"] = simulator.time();
    summary["steps"] = simulator.history().size();
    summary["elements"] = shape.elements();
    summary["wall_seconds"] = ending.wall_seconds;
    summary["position"] = configuration.position;
    if (result.residual) {
        summary["residual"] = *result.residual;
    }
    if (result.instant && result.instant->solution.tension.size() > 0) {
        const auto tension = result.instant->surface.at_nodes(result.instant->solution.tension);
        summary["tension_min"] = tension.minCoeff();
        summary["tension_max"] = tension.maxCoeff();
    }
    summary["error_estimate"] = std::isfinite(result.error_estimate) ? nlohmann::ordered_json(result.error_estimate)
                                                                     : nlohmann::ordered_json(nullptr);
    summary["error_met"] = result.error_met();
    summary["accuracy"] = result.eps;
    if (!result.newton_failure.empty()) {
        summary["newton_failure"] = result.newton_failure;
    }
    if (!result.refinement_failure.empty()) {
        summary["refinement_failure"] = result.refinement_failure;
    }
    if (result.newton_iterations > 0) {
        summary["newton_iterations"] = result.newton_iterations;
        summary["newton_evaluations"] = result.newton_evaluations;
    }
    if (result.growth_rate) {
        summary["stable"] = *result.growth_rate < 0;
        summary["leading_growth_rate"] = *result.growth_rate;
        summary["stability_elements"] = result.stability_elements;
    }
    if (!ending.failure.empty()) {
        summary["failure"] = ending.failure;
    }
    if (result.interrupted) {
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
