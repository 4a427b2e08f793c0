// SPDX-License-Identifier: MIT
// Largest stable step of the time integrators against the number of elements or modes, their error against the step,
// and what steps chosen from a tolerance cost, on a relaxing vesicle (docs/validation.md, docs/time_stepping.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/time/explicit_euler.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using namespace axistokes;

using examples::AnyDiscretization;

const AnyDiscretization elements = AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt);
const AnyDiscretization series = AnyDiscretization::of(examples::DiscretizationKind::spectral, std::nullopt);

template <class Integrator>
using Relaxation = Simulator<examples::OptionalTubeKernel, AnyDiscretization, examples::Law, examples::Drive,
                             Integrator, examples::Solver, examples::AnyWall>;

template <class Integrator>
Relaxation<Integrator> relaxation(const AnyDiscretization& discretization, const Integrator& integrator,
                                  const Meridian<double>& shape, const SimulationParams<double>& params) {
    return {examples::Scene(examples::OptionalTubeKernel(examples::OptionalTubeImages()), discretization,
                            examples::Law(examples::Vesicle()), examples::Drive(Quiescent<double>()),
                            examples::Solver(), examples::AnyWall()),
            integrator, shape, params};
}

SimulationParams<double> fixed_step(double dt, Index steps) {
    SimulationParams<double> params;
    params.time_step = dt;
    params.most_steps = steps;
    params.tolerance = 1e-12;
    return params;
}

Meridian<double> start(Index count) {
    return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, count);
}

/// Stable: many steps without a failure and without a rise of the bending energy above its first value.
template <class Integrator>
bool stable(const AnyDiscretization& discretization, const Integrator& integrator, Index n, double dt) {
    constexpr Index kSteps = 200;
    auto simulator = relaxation(discretization, integrator, start(n), fixed_step(dt, kSteps));
    const double first = simulator.scene().discretization().bending_energy(simulator.configuration().shape);
    try {
        simulator.run();
    } catch (const SimulationFailure&) {
        return false;
    }
    const auto& history = simulator.history();
    return std::all_of(history.begin(), history.end(), [&](const auto& r) { return r.bending_energy <= first; });
}

/// By bisection of the exponent, to 5 %; `largest` if that is stable.
template <class Integrator>
double largest_stable_step(const AnyDiscretization& discretization, const Integrator& integrator, Index n) {
    constexpr double kLargest = 1;
    if (stable(discretization, integrator, n, kLargest)) {
        return kLargest;
    }
    double low = 1e-8;
    double high = kLargest;
    while (high / low > 1.05) {
        const double middle = std::sqrt(low * high);
        (stable(discretization, integrator, n, middle) ? low : high) = middle;
    }
    return low;
}

using Order = ExtrapolatedEulerOfOrder;
const std::string columns = "explicit_euler,semi_implicit_euler,order_2,order_3,order_4,order_5,order_6";

void stable_steps(examples::Report& table, const std::string& name, const AnyDiscretization& discretization,
                  std::initializer_list<Index> counts) {
    for (const Index n : counts) {
        const auto largest = [&](const auto& integrator) { return largest_stable_step(discretization, integrator, n); };
        table.row(name, n, largest(ExplicitEuler()), largest(Order(1)), largest(Order(2)), largest(Order(3)),
                  largest(Order(4)), largest(Order(5)), largest(Order(6)));
    }
}

constexpr double kTime = 0.02;

template <class Integrator>
double length_after(const Integrator& integrator, Index steps) {
    auto simulator = relaxation(series, integrator, start(24), fixed_step(kTime / static_cast<double>(steps), steps));
    simulator.run();
    return simulator.history().back().length;
}

/// Error of the length, or why there is none.
template <class Integrator>
std::string length_error(const Integrator& integrator, Index steps, double exact) {
    try {
        std::ostringstream text;
        text << std::abs(length_after(integrator, steps) - exact);
        return text.str();
    } catch (const SimulationFailure&) {
        return "unstable";
    }
}

struct Run {
    double length;
    std::size_t steps;
    double seconds;
};

/// With steps chosen from a tolerance.
Run relaxed(int order, double tolerance) {
    SimulationParams<double> params;
    params.tolerance = 1e-12;
    params.longest_time = 0.2;
    params.step_tolerance = tolerance;
    auto simulator = relaxation(series, Order(order), start(48), params);
    const auto begin = std::chrono::steady_clock::now();
    simulator.run();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    return {simulator.history().back().length, simulator.history().size(), elapsed.count()};
}

void study(const std::string& directory) {
    examples::Report limits(directory, "stable_step.csv", "discretisation,n," + columns);
    stable_steps(limits, "P1", elements, {16, 32, 64, 128});
    stable_steps(limits, "spectral", series, {12, 16, 24, 32});

    const double exact = length_after(Order(6), 128);
    examples::Report errors(directory, "time_error.csv", "steps,dt," + columns);
    for (const Index steps : {4, 8, 16, 32, 64, 128, 256}) {
        const auto error = [&](const auto& integrator) { return length_error(integrator, steps, exact); };
        errors.row(steps, kTime / static_cast<double>(steps), error(ExplicitEuler()), error(Order(1)), error(Order(2)),
                   error(Order(3)), error(Order(4)), error(Order(5)), error(Order(6)));
    }

    const double relaxed_exact = relaxed(6, 1e-11).length;
    examples::Report costs(directory, "time_cost.csv", "tolerance,order,steps,seconds,error");
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
        for (const int order : {2, 3, 4, 5, 6}) {
            const Run run = relaxed(order, tolerance);
            costs.row(tolerance, order, run.steps, run.seconds, std::abs(run.length - relaxed_exact));
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "time_step_study",
        "Largest stable step and error in time of the integrators, on a relaxing prolate vesicle (D = 0.6)"};
    std::string directory;
    app.text("--out", directory, "directory that receives stable_step.csv, time_error.csv and time_cost.csv");
    return app.run(argc, argv, [&] {
        study(directory);
        return 0;
    });
}
