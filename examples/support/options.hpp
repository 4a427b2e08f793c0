// SPDX-License-Identifier: MIT
// Options that the simulations share.
#pragma once

#include "checkpoints.hpp"
#include "method.hpp"
#include "progress.hpp"
#include <axistokes/accuracy.hpp>
#include <axistokes/accuracy/driver_params.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/simulator.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace examples {

/// How long to run, how finely, and where the results go.
struct RunOptions {
    MethodOptions method;
    std::optional<axistokes::Index> elements;
    std::optional<double> tolerance;
    std::optional<double> step_tolerance;
    std::optional<double> time_step;
    std::optional<double> time;
    std::optional<axistokes::Index> steps;
    std::string directory;
    Checkpoints checkpoints;
    bool vtk = false;
    bool flow_field = false;
    std::vector<double> frame_times;

    void add_to(CommandLine& app);

    void add_output_to(CommandLine& app);

    /// Whether the number of elements is to follow from the accuracy.
    bool adapts() const { return !elements; }

    axistokes::Index elements_or(axistokes::Index otherwise) const {
        const axistokes::Index count = elements.value_or(otherwise);
        axistokes::detail::require(count <= 4000, "number of elements", count, "at most 4000 (the matrices are dense)");
        return count;
    }

    /// Whether the way matters and not only where it ends.
    bool transient() const { return time.has_value() || !frame_times.empty(); }

    /// With the integrator that wins where none was chosen: extrapolation, if the way matters.
    RunOptions resolved() const {
        RunOptions options = *this;
        if (transient() && !time_step) {
            options.method.usual_integrator = "adaptive";
        }
        return options;
    }

    /// Without a preset only the number of elements follows from an accuracy, of 1e-4, and is the usual one at least.
    axistokes::DriverParams<double> driver_params() const {
        axistokes::DriverParams<double> driver;
        driver.elements = elements ? std::optional(elements_or(0)) : std::nullopt;
        driver.transient = transient();
        driver.way = method.way();
        if (const auto accuracy = method.accuracy()) {
            driver.eps = accuracy->eps;
            driver.unresolved = accuracy->unresolved;
            driver.newton_tolerance = accuracy->residual;
            driver.to_round_off = true;
            driver.integrals = accuracy->quadrature;
            if (method.kind() == DiscretizationKind::adaptive) {
                // Differences over close nodes leave more round-off than series.
                driver.newton_tolerance = std::max(driver.newton_tolerance, 1e-9);
                driver.to_round_off = false;
            }
            driver.first_elements = method.high_order() ? 16 : 32;
        } else {
            driver.first_elements = method.high_order() ? 32 : 64;
        }
        driver.newton_tolerance = tolerance.value_or(driver.newton_tolerance);
        return driver;
    }

    axistokes::SimulationParams<double> params() const {
        method.check();
        axistokes::detail::require(!(method.newton() && time), "--time", time.value_or(0),
                                   "absent with --stationary newton, which leads to no given time");
        for (const double frame_time : frame_times) {
            axistokes::detail::require(frame_time >= 0, "--frame-times", frame_time, ">= 0");
            axistokes::detail::require(!time || frame_time <= *time, "--frame-times", frame_time, "not beyond --time");
        }
        if (method.integrator_name() == "adaptive" && time_step) {
            const bool chosen = method.integrator.has_value();
            axistokes::detail::require(false, "--dt", *time_step,
                                       chosen ? "absent with --integrator adaptive, which chooses its steps"
                                              : "absent with --preset-accuracy, unless --integrator is given too");
        }
        axistokes::SimulationParams<double> params;
        if (const auto accuracy = method.accuracy()) {
            params.tolerance = accuracy->residual;
            params.step_tolerance = transient() ? accuracy->step : accuracy->step_to_stationary;
        }
        params.tolerance = tolerance.value_or(params.tolerance);
        params.step_tolerance = step_tolerance.value_or(params.step_tolerance);
        params.time_step = time_step;
        params.longest_time = time.value_or(params.longest_time);
        params.landing_times = frame_times;
        params.most_steps = steps.value_or(params.most_steps);
        params.referee = !method.no_referee;
        params.proceed = [] { return !InterruptGuard::interrupted(); };
        return params;
    }
};

/// The initial spheroid of a vesicle.
struct VesicleOptions {
    double excess_area = 0.6;
    std::string kind = "prolate";

    void add_to(CommandLine& app);

    void add_kind_to(CommandLine& app);

    axistokes::SpheroidKind spheroid_kind() const {
        axistokes::detail::require(kind == "prolate" || kind == "oblate", "initial shape", kind, "prolate or oblate");
        return kind == "prolate" ? axistokes::SpheroidKind::prolate : axistokes::SpheroidKind::oblate;
    }

    axistokes::Meridian<double> shape(axistokes::Index elements) const {
        return axistokes::spheroid_of_excess_area<double>(excess_area, spheroid_kind(), elements);
    }
};

}  // namespace examples
