// SPDX-License-Identifier: MIT
// Finds the motion of a rigid body, with as many elements as the accuracy takes.
#include "../support/body_case.hpp"
#include "../support/results.hpp"

#include <chrono>

namespace examples {

int run_body(const BodyCase& c) {
    using axistokes::Index;
    if (!c.run.directory.empty()) {
        axistokes::create_output_directory(c.run.directory);
    }
    const auto begin = std::chrono::steady_clock::now();
    const AnyDiscretization discretization = AnyDiscretization::of(c.run.method.kind(), c.tolerance);
    const auto simulation = [&](Index elements) {
        return Simulation(Scene(kernel_for(c.surroundings, c.tolerance), discretization, Law(RigidBody()), c.drive,
                                Solver(), wall_for(c.surroundings)),
                          axistokes::ExtrapolatedEulerOfOrder(1),
                          axistokes::nodes_of(discretization, c.shape, elements), c.run.params());
    };
    auto driver_params = c.run.driver_params();
    if (!c.run.method.preset) {
        driver_params.elements = c.run.elements_or(c.elements);
    }
    Driver driver(simulation, driver_params, [](const Simulation&) { return true; });
    Ending ending;
    ending.result = driver.run();
    ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    nlohmann::ordered_json summary = summarize(driver.simulation(), ending);
    summary["discretization"] = c.run.method.discretization_name();
    if (c.run.method.preset) {
        summary["preset_accuracy"] = *c.run.method.preset;
    }
    if (c.surroundings.tube_radius) {
        summary.update(tube_summary(driver.simulation(), ending, c.mean_velocity));
    }
    const auto& instant = *ending.result.instant();
    summary.update(
        c.details({instant.surface.nodes, instant.surface.weight, instant.solution.force, instant.velocity}));
    summary["parameters"] = c.parameters;
    return conclude(driver.simulation(), ending, c.run, Frames(), summary);
}

}  // namespace examples
