// SPDX-License-Identifier: MIT
// What accuracy costs: the single layer against its quadrature tolerance, and a stationary vesicle against the number
// of elements (docs/validation.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/shapes.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace axistokes;

template <class Action>
double median_milliseconds(const Action& action) {
    std::vector<double> times;
    for (int i = 0; i < 15; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        action();
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::nth_element(times.begin(), times.begin() + 7, times.end());
    return times[7];
}

examples::AnyDiscretization elements_with(double tolerance) {
    return examples::AnyDiscretization::of(examples::DiscretizationKind::linear, tolerance);
}

/// A dumbbell with a thin neck: strands of the membrane face each other across the axis.
Meridian<double> dumbbell(Index elements) {
    Meridian<double> m{Vector<double>(elements + 1), Vector<double>(elements + 1)};
    for (Index i = 0; i <= elements; ++i) {
        const double t = detail::pi_value<double>() * static_cast<double>(i) / static_cast<double>(elements);
        m.r[i] = std::sin(t) * (0.03 + std::cos(t) * std::cos(t));
        m.z[i] = -1.5 * std::cos(t);
    }
    m.r[0] = m.r[elements] = 0;
    return m;
}

void quadrature_table(const std::string& directory) {
    examples::Report table(directory, "quadrature.csv", "shape,tolerance,largest_error,milliseconds");
    const FreeSpaceKernel<double> kernel;
    const auto sweep = [&](const std::string& name, const Meridian<double>& shape) {
        const Matrix<double> exact = elements_with(1e-15).single_layer(shape, kernel);
        for (int digits = 2; digits <= 13; ++digits) {
            const double tolerance = std::pow(10.0, -digits);
            const examples::AnyDiscretization elements = elements_with(tolerance);
            const double error = (elements.single_layer(shape, kernel) - exact).cwiseAbs().maxCoeff();
            const double time = median_milliseconds([&] { elements.single_layer(shape, kernel); });
            table.row(name, tolerance, error / exact.cwiseAbs().maxCoeff(), time);
        }
    };
    sweep("spheroid", spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 130));
    sweep("dumbbell", dumbbell(130));
}

struct Settled {
    double velocity;
    double length;
    double energy;
    double seconds;
    Index steps;
};

Settled settle(Index elements, double quadrature_tolerance) {
    SimulationParams<double> params;
    params.tolerance = 1e-8;
    auto simulator = examples::free_simulation(
        elements_with(quadrature_tolerance), examples::Vesicle(), examples::Drive(Gravity<double>(47.0)),
        spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, elements), params);
    const auto begin = std::chrono::steady_clock::now();
    simulator.run();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const StepRecord<double>& last = simulator.history().back();
    return {last.velocity, last.length, last.bending_energy, seconds, last.step};
}

void vesicle_table(const std::string& directory) {
    // Reference: N = 128 and 256, extrapolated at the second order that the table itself confirms.
    const Settled coarse = settle(128, 1e-10);
    const Settled fine = settle(256, 1e-10);
    const auto extrapolate = [](double a, double b) { return b + (b - a) / 3; };
    const double velocity = extrapolate(coarse.velocity, fine.velocity);
    const double length = extrapolate(coarse.length, fine.length);
    const double energy = extrapolate(coarse.energy, fine.energy);
    examples::Report table(
        directory, "vesicle.csv",
        "elements,quadrature_tolerance,velocity_error,length_error,energy_error,steps,seconds_to_stationarity");
    for (const double tolerance : {1e-3, 1e-6, 1e-8, 1e-10}) {
        for (const Index n : {16, 24, 32, 48, 64, 96, 128, 192}) {
            const Settled s = settle(n, tolerance);
            table.row(n, tolerance, std::abs(s.velocity / velocity - 1), std::abs(s.length / length - 1),
                      std::abs(s.energy / energy - 1), s.steps, s.seconds);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "accuracy_study",
        "Error and cost of the quadrature tolerance and of the number of elements (settling vesicle)"};
    std::string directory;
    app.text("--out", directory, "directory that receives quadrature.csv and vesicle.csv");
    return app.run(argc, argv, [&] {
        quadrature_table(directory);
        vesicle_table(directory);
        return 0;
    });
}
