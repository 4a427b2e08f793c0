// SPDX-License-Identifier: MIT
// Largest stable step of the time integrators against the number of elements, and their error against the step, on a
// relaxing vesicle (docs/validation.md).
#include "support/report.hpp"
#include <axistokes/axistokes.hpp>

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using namespace axistokes;

template <class Integrator>
using Relaxation = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Quiescent<double>,
                             Integrator, DenseLU<double>>;

SimulationParams<double> fixed_step(double dt, Index steps) {
    SimulationParams<double> params;
    params.time_step = dt;
    params.most_steps = steps;
    params.tolerance = 1e-12;
    return params;
}

Meridian<double> start(Index elements) {
    return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, elements);
}

/// Stable: many steps without a failure and without a rise of the bending energy above its first value.
template <class Integrator>
bool stable(Index elements, double dt) {
    constexpr Index kSteps = 200;
    Relaxation<Integrator> simulator(start(elements), {}, fixed_step(dt, kSteps));
    const double first = bending_energy(simulator.configuration().shape);
    try {
        simulator.run();
    } catch (const SimulationFailure&) {
        return false;
    }
    for (const StepRecord<double>& record : simulator.history()) {
        if (!(record.bending_energy <= first)) {
            return false;
        }
    }
    return true;
}

/// By bisection of the exponent, to 5 %; `largest` if that is stable.
template <class Integrator>
double largest_stable_step(Index elements, double largest) {
    if (stable<Integrator>(elements, largest)) {
        return largest;
    }
    double low = 1e-8;
    double high = largest;
    while (high / low > 1.05) {
        const double middle = std::sqrt(low * high);
        (stable<Integrator>(elements, middle) ? low : high) = middle;
    }
    return low;
}

template <class Integrator>
double length_after(Index elements, double time, Index steps) {
    Relaxation<Integrator> simulator(start(elements), {}, fixed_step(time / static_cast<double>(steps), steps));
    simulator.run();
    return simulator.history().back().length;
}

void study(const std::string& directory) {
    examples::Report limits(directory, "stable_step.csv",
                            "elements,explicit_euler,explicit_euler_over_h3,semi_implicit_euler");
    for (const Index n : {16, 32, 64, 128}) {
        const double h = linear_surface(start(n)).element_length.minCoeff();
        const double step = largest_stable_step<ExplicitEuler>(n, 1.0);
        limits.row(n, step, step / (h * h * h), largest_stable_step<SemiImplicitEuler>(n, 1.0));
    }

    constexpr double kTime = 0.02;
    constexpr Index kElements = 32;
    const double exact = 2 * length_after<SemiImplicitEuler>(kElements, kTime, 8192) -
                         length_after<SemiImplicitEuler>(kElements, kTime, 4096);
    examples::Report errors(directory, "time_error.csv", "steps,dt,semi_implicit_euler,explicit_euler");
    for (const Index steps : {8, 16, 32, 64, 128, 256, 512}) {
        std::string explicit_error = "unstable";
        try {
            const double length = length_after<ExplicitEuler>(kElements, kTime, steps);
            std::ostringstream text;
            text << std::abs(length - exact);
            explicit_error = text.str();
        } catch (const SimulationFailure&) {
        }
        errors.row(steps, kTime / static_cast<double>(steps),
                   std::abs(length_after<SemiImplicitEuler>(kElements, kTime, steps) - exact), explicit_error);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Largest stable step and error in time of the integrators, on a relaxing prolate vesicle (D = 0.6)"};
    std::string directory;
    app.add_option("--out", directory, "directory that receives stable_step.csv and time_error.csv");
    CLI11_PARSE(app, argc, argv);
    try {
        study(directory);
    } catch (const std::exception& error) {
        std::cerr << "time_step_study: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
