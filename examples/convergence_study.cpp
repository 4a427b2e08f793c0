// SPDX-License-Identifier: MIT
// Stationary shapes against the number of elements, with the observed order and the cost, and minimal bending energies
// (docs/validation.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/shapes.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace axistokes;

examples::Simulation vesicle_in(const examples::Drive::Choice& flow, const Meridian<double>& shape) {
    SimulationParams<double> params;
    params.tolerance = 1e-7;
    return examples::free_simulation(
        examples::AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt), examples::Vesicle(),
        examples::Drive(flow), shape, params);
}

/// p of q(N) = q + c N^-p through three values, N increasing; NaN if they are not monotonic.
double observed_order(const std::array<Index, 3>& n, const std::array<double, 3>& q) {
    const double wanted = (q[0] - q[1]) / (q[1] - q[2]);
    const auto ratio = [&](double p) {
        const auto power = [&](std::size_t i) { return std::pow(static_cast<double>(n[i]), -p); };
        return (power(0) - power(1)) / (power(1) - power(2));
    };
    double low = 0.1;
    double high = 12;
    if (!(ratio(low) < wanted && wanted < ratio(high))) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (ratio(middle) < wanted ? low : high) = middle;
    }
    return low;
}

void convergence_table(const std::string& directory, const std::string& name, const examples::Drive::Choice& flow) {
    constexpr std::array<Index, 4> kElements{32, 64, 130, 260};
    struct Row {
        std::array<double, 3> quantities;
        Index steps;
        double seconds;
    };
    std::vector<Row> rows;
    for (const Index n : kElements) {
        auto simulator = vesicle_in(flow, spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, n));
        const auto begin = std::chrono::steady_clock::now();
        if (!simulator.run()) {
            throw SimulationFailure(name + ": not stationary with " + std::to_string(n) + " elements");
        }
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const StepRecord<double>& last = simulator.history().back();
        rows.push_back({{last.velocity, last.length, last.bending_energy}, last.step, seconds});
    }
    examples::Report table(directory, name + ".csv",
                           "elements,velocity,length,bending_energy,steps,wall_seconds,cost_ratio");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [velocity, length, energy] = rows[i].quantities;
        table.row(kElements[i], velocity, length, energy, rows[i].steps, rows[i].seconds,
                  rows[i].seconds / rows.back().seconds);
    }
    examples::Report orders(directory, name + "_order.csv", "elements,velocity,length,bending_energy");
    for (std::size_t i = 2; i < rows.size(); ++i) {
        const auto order = [&](std::size_t q) {
            return observed_order({kElements[i - 2], kElements[i - 1], kElements[i]},
                                  {rows[i - 2].quantities[q], rows[i - 1].quantities[q], rows[i].quantities[q]});
        };
        orders.row(std::to_string(kElements[i - 2]) + " to " + std::to_string(kElements[i]), order(0), order(1),
                   order(2));
    }
}

/// Energies over 8 pi; largest_rise is the largest increase in a step, relative to the energy.
void relaxation_table(const std::string& directory) {
    struct Minimum {
        double reduced_volume;
        SpheroidKind kind;
        double energy;  // of the minimal shape, over 8 pi, from the axisymmetric shape equations
    };
    constexpr std::array<Minimum, 8> kMinima{{{0.95, SpheroidKind::prolate, 1.09557},
                                              {0.95, SpheroidKind::oblate, 1.10612},
                                              {0.9, SpheroidKind::prolate, 1.18964},
                                              {0.9, SpheroidKind::oblate, 1.21786},
                                              {0.8, SpheroidKind::prolate, 1.38744},
                                              {0.8, SpheroidKind::oblate, 1.45254},
                                              {0.65, SpheroidKind::prolate, 1.82793},
                                              {0.65, SpheroidKind::oblate, 1.82623}}};
    examples::Report table(directory, "relaxation.csv",
                           "reduced_volume,initial,elements,energy,reference,difference,steps,largest_rise");
    for (const auto& [reduced_volume, kind, reference] : kMinima) {
        for (const Index n : {64, 130}) {
            const double excess_area = 4 * std::numbers::pi * (std::pow(reduced_volume, -2.0 / 3) - 1);
            auto simulator = vesicle_in(Quiescent<double>(), spheroid_of_excess_area<double>(excess_area, kind, n));
            simulator.run();
            const auto& history = simulator.history();
            double rise = 0;
            for (std::size_t i = 1; i < history.size(); ++i) {
                rise = std::max(rise, history[i].bending_energy / history[i - 1].bending_energy - 1);
            }
            const double energy = history.back().bending_energy / (8 * std::numbers::pi);
            table.row(reduced_volume, kind == SpheroidKind::prolate ? "prolate" : "oblate", n, energy, reference,
                      energy - reference, history.back().step, rise);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "convergence_study",
        "Convergence of stationary vesicles (settling, Poiseuille flow, relaxation) in the number of elements"};
    std::string directory;
    app.text("--out", directory, "directory that receives the tables as CSV files");
    return app.run(argc, argv, [&] {
        std::cout << std::setprecision(8);
        convergence_table(directory, "settling", Gravity<double>(47));
        convergence_table(directory, "poiseuille", UnboundedPoiseuille<double>(0.5));
        relaxation_table(directory);
        return examples::success;
    });
}
