// SPDX-License-Identifier: MIT
// Finds the motion of a rigid body, with as many elements as the accuracy takes.
#include "../support/body_case.hpp"
#include "../support/results.hpp"
#include "../support/thin_film.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace examples {

namespace {

double relative_gap(const BodyCase& c) {
    return 1 - c.shape(128).r.maxCoeff() / *c.surroundings.tube_radius;
}

/// With tolerances relative to that: a tenth of it, and no less than double precision can tell.
BodyCase resolved(BodyCase c) {
    if (!c.surroundings.tube_radius) {
        return c;
    }
    const double left = 10 * remainder(relative_gap(c));
    c.tolerance = tightened(c.tolerance, left);
    if (c.surroundings.wall) {
        c.surroundings.wall->tolerance = tightened(c.surroundings.wall->tolerance, left, 1e-11);
    }
    return c;
}

}  // namespace

int run_body(const BodyCase& given) {
    using axistokes::Index;
    const BodyCase c = resolved(given);
    if (!c.run.directory.empty()) {
        axistokes::create_output_directory(c.run.directory);
    }
    const auto begin = std::chrono::steady_clock::now();
    const InterruptGuard guard;
    const AnyDiscretization discretization = AnyDiscretization::of(c.run.method.kind(), c.tolerance);
    const auto simulation = [&](Index elements) {
        return Simulation(Scene(kernel_for(c.surroundings, c.tolerance), discretization, Law(RigidBody()), c.drive,
                                Solver(), wall_for(c.surroundings)),
                          axistokes::ExtrapolatedEulerOfOrder(1), c.shape(elements), c.run.params());
    };
    auto driver_params = c.run.driver_params();
    if (!c.run.method.preset) {
        driver_params.elements = c.run.elements_or(c.elements);
    }
    Driver driver(simulation, driver_params, [](const Simulation&) { return true; });
    Ending ending = run_to_the_end(driver, begin);
    ending.result.error_estimate += wall_error(driver.simulation(), ending.result, c.surroundings);
    if (c.surroundings.tube_radius) {
        // No number of elements tells what the integrals lack.
        ending.result.error_estimate += c.tolerance / (10 * remainder(relative_gap(c)));
    }
    nlohmann::ordered_json summary = summarize(driver.simulation(), ending);
    summary["discretization"] = c.run.method.discretization_name();
    if (c.run.method.preset) {
        summary["preset_accuracy"] = *c.run.method.preset;
    }
    if (c.surroundings.tube_radius) {
        summary.update(tube_summary(driver.simulation(), ending, c.mean_velocity));
    }
    if (const auto* instant = ending.result.instant()) {
        summary.update(
            c.details({instant->surface.nodes, instant->surface.weight, instant->solution.force, instant->velocity}));
    }
    summary["parameters"] = c.parameters;
    return conclude(driver.simulation(), ending, c.run, Frames(), summary, nullptr);
}

}  // namespace examples
