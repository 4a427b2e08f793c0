// SPDX-License-Identifier: MIT
// Finds the motion of a rigid body, with as many elements as the accuracy takes.
#pragma once

#include "body_case.hpp"
#include "compiled.hpp"
#include "resolution.hpp"
#include "run.hpp"
#include "tube.hpp"
#include <axistokes/simulator.hpp>
#include <axistokes/time/explicit_euler.hpp>
#include <axistokes/wall/no_wall.hpp>

#include <chrono>
#include <cmath>

namespace examples {

template <class Discretization, class Kernel, class Wall>
int run_body_with(const BodyCase& c, const Kernel& kernel, const Wall& wall) {
    using Simulator = axistokes::Simulator<Kernel, Discretization, RigidBody<Discretization>, Drive,
                                           axistokes::ExplicitEuler, axistokes::DenseLU<double>, Wall>;
    using axistokes::Index;
    if (!c.run.directory.empty()) {
        axistokes::create_output_directory(c.run.directory);
    }
    const auto begin = std::chrono::steady_clock::now();
    typename Discretization::Params params;
    params.tolerance = c.tolerance;
    const Discretization discretization(params);
    const auto simulator_with = [&](Index elements) {
        Simulator simulator(nodes_of(discretization, c.shape, elements), c.drive, c.run.params(), kernel,
                            discretization, {}, {}, {}, wall);
        simulator.run();
        return simulator;
    };
    nlohmann::ordered_json details = nlohmann::ordered_json::object();
    constexpr bool spectral = judges_itself<Discretization>;
    constexpr Index most = 2 * most_elements<Discretization>;
    Simulator simulator =
        simulator_with(c.run.adapts() ? first_elements<Discretization> : c.run.elements_or(c.elements));
    if (c.run.adapts()) {
        // The shape may be simple and the traction is not: two results tell the error of the coarser one, or, of second
        // order, that of the finer.
        const double eps = c.run.method.accuracy()->eps;
        double error = 1;
        while (error > eps && simulator.configuration().shape.elements() < most) {
            const auto result = [](const Simulator& s) {
                return Measured{s.history().back().velocity, 1, s.configuration().shape.elements()};
            };
            const Measured coarse = result(simulator);
            const Index next = spectral ? std::min(most, coarse.elements + coarse.elements / 2)
                                        : more_elements(coarse.elements, error, eps, most);
            simulator = simulator_with(next);
            const Measured fine = result(simulator);
            error = spectral ? std::abs(coarse.velocity / fine.velocity - 1) : second_order_error(coarse, fine);
        }
        details["error_estimate"] = error;
        details["error_met"] = error <= eps;
    }

    Ending<Simulator> ending;
    ending.take(simulator);
    ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    nlohmann::ordered_json summary = summarize(simulator, ending);
    summary["discretization"] = spectral ? "spectral" : "linear";
    if (c.run.method.preset) {
        summary["preset_accuracy"] = *c.run.method.preset;
    }
    summary.update(details);
    if (c.surroundings.tube_radius) {
        summary.update(tube_summary(simulator, ending, 0));
    }
    if (ending.instant) {
        const auto& surface = ending.instant->surface;
        summary.update(
            c.details({surface.nodes, surface.weight, ending.instant->solution.force, ending.instant->velocity}));
    }
    summary["parameters"] = c.parameters;
    return conclude(simulator, ending, c.run, Frames(), summary);
}

template <class Discretization>
int run_body_in(const BodyCase& c) {
    if (c.surroundings.wall) {
        return run_body_with<Discretization>(c, axistokes::FreeSpaceKernel<double>(), c.surroundings.mesh());
    }
    return run_body_with<Discretization>(c, c.surroundings.kernel(c.tolerance), axistokes::NoWall());
}

}  // namespace examples
