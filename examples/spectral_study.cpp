// SPDX-License-Identifier: MIT
// Convergence of the spectral discretisation: bending force, translating spheroid, sphere in a tube, and stationary
// vesicles against the number of modes (docs/spectral.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/shapes.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>

namespace {

using namespace axistokes;

/// Nodes at equal steps of the eccentric angle: the series then has two terms.
Meridian<double> ellipse(double a, double c, Index n) {
    Meridian<double> m{Vector<double>(n + 1), Vector<double>(n + 1)};
    for (Index i = 0; i <= n; ++i) {
        const double t = detail::pi_value<double>() * static_cast<double>(i) / static_cast<double>(n);
        m.r[i] = a * std::sin(t);
        m.z[i] = -c * std::cos(t);
    }
    m.r[0] = m.r[n] = 0;
    return m;
}

examples::AnyDiscretization series() {
    return examples::AnyDiscretization::of(examples::DiscretizationKind::spectral, std::nullopt);
}

Vector<double> bending_force(Index n) {
    return examples::Vesicle::force(series().surface(ellipse(1, 2, n)));
}

/// Against the same on 48 modes, where round-off and truncation are balanced.
double bending_error(Index n) {
    const Index fine = 48;
    const Vector<double> exact = bending_force(fine);
    const Vector<double> force = bending_force(n);
    double error = 0;
    for (Index i = 0; i <= n; ++i) {
        if (i * fine % n == 0) {
            const Index k = i * fine / n;
            error = std::max({error, std::abs(force[i] - exact[k]), std::abs(force[n + 1 + i] - exact[fine + 1 + k])});
        }
    }
    return error / exact.cwiseAbs().maxCoeff();
}

/// A force density proportional to n.x moves the prolate spheroid of aspect 2 like a rigid body.
double translation_error(Index n) {
    const Meridian<double> m = ellipse(1, 2, n);
    const examples::AnyDiscretization spectral = series();
    const auto surface = spectral.surface(m);
    Vector<double> force = Vector<double>::Zero(2 * (n + 1));
    force.tail(n + 1) = surface.normal_r.cwiseProduct(m.r) + surface.normal_z.cwiseProduct(m.z);
    const double e = std::sqrt(0.75);
    const double drag = 16 / 3.0 * e * e * e / ((1 + e * e) * std::log((1 + e) / (1 - e)) - 2 * e);
    Vector<double> expected = Vector<double>::Zero(2 * (n + 1));
    expected.tail(n + 1).setConstant(4 / (3 * drag));
    const Vector<double> u = spectral.single_layer(m, FreeSpaceKernel<double>()) * force;
    return (u - expected).cwiseAbs().maxCoeff() / expected.maxCoeff();
}

double tube_drag(double confinement, Index n) {
    examples::Surroundings tube;
    tube.tube_radius = 1 / confinement;
    examples::Simulation run(
        examples::Scene(examples::kernel_for(tube, 1e-11), series(), examples::Law(examples::RigidBody()),
                        examples::Drive(Gravity<double>(1.0)), examples::Solver(), examples::AnyWall()),
        ExtrapolatedEulerOfOrder(1), ellipse(1, 1, n));
    return -2.0 / 9 / run.step().velocity;
}

void stationary(examples::Report& table, const std::string& name, const examples::AnyDiscretization& discretization,
                const examples::Drive::Choice& flow, Index n) {
    SimulationParams<double> params;
    params.tolerance = 1e-8;
    auto run = examples::free_simulation(discretization, examples::Vesicle(), examples::Drive(flow),
                                         spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, n), params);
    const auto begin = std::chrono::steady_clock::now();
    run.run();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const StepRecord<double>& last = run.history().back();
    table.row(name, n, last.velocity, last.length, last.bending_energy, discretization.unresolved(run.shape()),
              last.step, seconds);
}

void study(const std::string& directory) {
    std::cout.precision(11);
    examples::Report spheroid(directory, "spheroid.csv", "modes,bending_force_error,translation_error");
    for (const Index n : {8, 12, 16, 24, 32, 48}) {
        spheroid.row(n, bending_error(n), translation_error(n));
    }
    examples::Report tube(directory, "tube.csv", "modes,drag_at_0.5,drag_at_0.9");
    for (const Index n : {8, 12, 16, 24, 32, 48, 64}) {
        tube.row(n, tube_drag(0.5, n), tube_drag(0.9, n));
    }
    examples::Report vesicles(directory, "stationary.csv",
                              "case,modes_or_elements,velocity,length,energy,unresolved,steps,seconds");
    const Gravity<double> gravity(47.0);
    const UnboundedPoiseuille<double> flow(0.5);
    for (const Index n : {8, 12, 16, 24, 32, 48, 64}) {
        stationary(vesicles, "settling", series(), gravity, n);
    }
    for (const Index n : {8, 12, 16, 24, 32, 48, 64}) {
        stationary(vesicles, "Poiseuille", series(), flow, n);
    }
    const auto elements = examples::AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt);
    for (const Index n : {64, 128}) {
        stationary(vesicles, "settling P1", elements, gravity, n);
        stationary(vesicles, "Poiseuille P1", elements, flow, n);
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"spectral_study", "Error of the spectral discretisation against the number of modes"};
    std::string directory;
    app.text("--out", directory, "directory that receives spheroid.csv, tube.csv and stationary.csv");
    return app.run(argc, argv, [&] {
        study(directory);
        return 0;
    });
}
