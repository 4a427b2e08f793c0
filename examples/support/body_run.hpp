// SPDX-License-Identifier: MIT
// Finds the motion of a rigid body, with as many elements as the accuracy takes.
#pragma once

#include "body_case.hpp"
#include "compiled.hpp"
#include "run.hpp"
#include "tube.hpp"
#include <axistokes/accuracy/driver.hpp>
#include <axistokes/time/explicit_euler.hpp>
#include <axistokes/wall/no_wall.hpp>

#include <chrono>

namespace examples {

template <class Discretization, class Kernel, class Wall>
int run_body_with(const BodyCase& c, const Kernel& kernel, const Wall& wall) {
    using Simulator = axistokes::Simulator<Kernel, Discretization, axistokes::RigidBody<double>, Drive,
                                           axistokes::ExplicitEuler, axistokes::DenseLU<double>, Wall>;
    using axistokes::Index;
    if (!c.run.directory.empty()) {
        axistokes::create_output_directory(c.run.directory);
    }
    const auto begin = std::chrono::steady_clock::now();
    typename Discretization::Params params;
    params.tolerance = c.tolerance;
    const Discretization discretization(params);
    const auto simulator = [&](Index elements) {
        return Simulator(typename Simulator::SceneType(kernel, discretization, axistokes::RigidBody<double>(), c.drive,
                                                       axistokes::DenseLU<double>(), wall),
                         axistokes::ExplicitEuler(), axistokes::nodes_of(discretization, c.shape, elements),
                         c.run.params());
    };
    auto driver_params = c.run.driver_params();
    if (!c.run.method.preset) {
        driver_params.elements = c.run.elements_or(c.elements);
    }
    axistokes::Driver<Simulator> driver(simulator, driver_params);
    Ending<Simulator> ending;
    ending.result = driver.run();
    ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    nlohmann::ordered_json summary = summarize(driver.simulator(), ending);
    summary["discretization"] = axistokes::JudgesItself<Discretization> ? "spectral" : "linear";
    if (c.run.method.preset) {
        summary["preset_accuracy"] = *c.run.method.preset;
    }
    if (c.surroundings.tube_radius) {
        summary.update(tube_summary(driver.simulator(), ending, c.mean_velocity));
    }
    const auto& instant = *ending.result.instant;
    summary.update(
        c.details({instant.surface.nodes, instant.surface.weight, instant.solution.force, instant.velocity}));
    summary["parameters"] = c.parameters;
    return conclude(driver.simulator(), ending, c.run, Frames(), summary);
}

template <class Discretization>
int run_body_in(const BodyCase& c) {
    if (c.surroundings.wall) {
        return run_body_with<Discretization>(c, axistokes::FreeSpaceKernel<double>(), c.surroundings.mesh());
    }
    return run_body_with<Discretization>(c, c.surroundings.kernel(c.tolerance), axistokes::NoWall());
}

}  // namespace examples
