// SPDX-License-Identifier: MIT
// Largest stable step of the time integrators against the number of elements or modes, and their error against the
// step, on a relaxing vesicle (docs/validation.md).
#include "support/report.hpp"
#include <axistokes/axistokes.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using namespace axistokes;

using Linear = LinearElements<double>;
using Spectral = SpectralMeridian<double>;

template <class Discretization, class Integrator>
using Relaxation =
    Simulator<FreeSpaceKernel<double>, Discretization, Vesicle<double>, Quiescent<double>, Integrator, DenseLU<double>>;

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
template <class Discretization, class Integrator>
bool stable(Index elements, double dt) {
    constexpr Index kSteps = 200;
    Relaxation<Discretization, Integrator> simulator(start(elements), {}, fixed_step(dt, kSteps));
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
template <class Discretization, class Integrator>
double largest_stable_step(Index elements) {
    constexpr double kLargest = 1;
    if (stable<Discretization, Integrator>(elements, kLargest)) {
        return kLargest;
    }
    double low = 1e-8;
    double high = kLargest;
    while (high / low > 1.05) {
        const double middle = std::sqrt(low * high);
        (stable<Discretization, Integrator>(elements, middle) ? low : high) = middle;
    }
    return low;
}

template <class Discretization>
void stable_steps(examples::Report& table, const std::string& name, std::initializer_list<Index> counts) {
    for (const Index n : counts) {
        table.row(name, n, largest_stable_step<Discretization, ExplicitEuler>(n),
                  largest_stable_step<Discretization, SemiImplicitEuler>(n),
                  largest_stable_step<Discretization, SecondOrder>(n),
                  largest_stable_step<Discretization, ThirdOrder>(n));
    }
}

constexpr double kTime = 0.02;

template <class Integrator>
double length_after(Index steps) {
    Relaxation<Spectral, Integrator> simulator(start(24), {}, fixed_step(kTime / static_cast<double>(steps), steps));
    simulator.run();
    return simulator.history().back().length;
}

/// Error of the length, or why there is none.
template <class Integrator>
std::string length_error(Index steps, double exact) {
    try {
        std::ostringstream text;
        text << std::abs(length_after<Integrator>(steps) - exact);
        return text.str();
    } catch (const SimulationFailure&) {
        return "unstable";
    }
}

void study(const std::string& directory) {
    examples::Report limits(directory, "stable_step.csv",
                            "discretisation,n,explicit_euler,semi_implicit_euler,order_2,order_3");
    stable_steps<Linear>(limits, "P1", {16, 32, 64, 128});
    stable_steps<Spectral>(limits, "spectral", {12, 16, 24, 32});

    const double exact = length_after<ThirdOrder>(1024);
    examples::Report errors(directory, "time_error.csv", "steps,dt,explicit_euler,semi_implicit_euler,order_2,order_3");
    for (const Index steps : {4, 8, 16, 32, 64, 128, 256}) {
        errors.row(steps, kTime / static_cast<double>(steps), length_error<ExplicitEuler>(steps, exact),
                   length_error<SemiImplicitEuler>(steps, exact), length_error<SecondOrder>(steps, exact),
                   length_error<ThirdOrder>(steps, exact));
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
