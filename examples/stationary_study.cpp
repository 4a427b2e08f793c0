// SPDX-License-Identifier: MIT
// Stationary states by Newton's method against time marching from the same start: agreement, evaluations and time, and
// growth rates from the linearisation against those by differences (docs/stationary.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <cmath>
#include <ctime>
#include <iostream>
#include <string>

namespace {

using namespace axistokes;
/// Processor time: other programs on the machine must not show.
class Stopwatch {
  public:
    double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

  private:
    std::clock_t begin_ = std::clock();
};

constexpr double kTolerance = 1e-8;

double length(const Meridian<double>& shape) {
    return shape.z[shape.elements()] - shape.z[0];
}

examples::Scene scene_of(const examples::AnyDiscretization& discretization, const examples::Drive& drive,
                         std::optional<double> tube_radius = {}) {
    examples::Surroundings surroundings;
    surroundings.tube_radius = tube_radius;
    return {examples::kernel_for(surroundings, std::nullopt),
            discretization,
            examples::Law(examples::Vesicle()),
            drive,
            examples::Solver(),
            examples::AnyWall()};
}

SimulationParams<double> march_params() {
    SimulationParams<double> params;
    params.tolerance = kTolerance;
    return params;
}

StationaryParams<double> newton_params() {
    StationaryParams<double> params;
    params.tolerance = kTolerance;
    return params;
}

const auto series = examples::AnyDiscretization::of(examples::DiscretizationKind::spectral, std::nullopt);
const auto elements = examples::AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt);

void compare(examples::Report& table, const std::string& name, const examples::Drive& drive,
             const Meridian<double>& start, std::optional<double> tube_radius = {}) {
    const examples::Scene scene = scene_of(series, drive, tube_radius);
    const Stopwatch marching;
    examples::Simulation march(scene, ExtrapolatedEulerOfOrder(1), start, march_params());
    march.run();
    const double march_seconds = marching.seconds();
    const auto& last = march.history().back();

    examples::Newton newton(scene, newton_params());
    const Stopwatch solving;
    const auto state = newton.solve(start, march.initial_area(), march.initial_volume());
    const double newton_seconds = solving.seconds();
    const Stopwatch examining;
    const double growth = newton.growth_rates(state).front().real();
    const double growth_seconds = examining.seconds();
    const double by_differences = newton.growth_rates(state, 1e-5).front().real();
    table.row(name, start.elements(), march.history().size(), march_seconds, state.evaluations, state.jacobians,
              state.coarse_evaluations, state.coarse_jacobians, newton_seconds, march_seconds / newton_seconds,
              last.residual, state.residual, state.instant().velocity,
              std::abs(state.instant().velocity / last.velocity - 1),
              std::abs(length(state.configuration().shape) - last.length), growth, growth_seconds, by_differences);
}

/// The velocity at equal accuracy: spectral Newton against P1 elements, marched and by Newton's method.
void equal_accuracy(examples::Report& table, const examples::Drive& drive) {
    const auto start = [](Index n) { return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, n); };
    examples::Newton newton(scene_of(series, drive), newton_params());
    const double area = 4 * detail::pi_value<double>() + 0.6;
    const double volume = 4 * detail::pi_value<double>() / 3;
    const double exact = newton.solve(start(64), area, volume).instant().velocity;
    for (const Index n : {12, 16, 24, 32, 48}) {
        const Stopwatch watch;
        const auto state = newton.solve(start(n), area, volume);
        table.row("spectral Newton", n, std::abs(state.instant().velocity / exact - 1), watch.seconds());
    }
    for (const Index n : {64, 128, 260}) {
        const Stopwatch watch;
        examples::Simulation march(scene_of(elements, drive), ExtrapolatedEulerOfOrder(1), start(n), march_params());
        march.run();
        table.row("P1 marched", n, std::abs(march.history().back().velocity / exact - 1), watch.seconds());
    }
    examples::Newton linear(scene_of(elements, drive), newton_params());
    for (const Index n : {64, 128, 260}) {
        const Stopwatch watch;
        const auto state = linear.solve(start(n), area, volume);
        table.row("P1 Newton", n, std::abs(state.instant().velocity / exact - 1), watch.seconds());
    }
}

void study(const std::string& directory, bool film) {
    std::cout.precision(6);
    examples::Report table(directory, "newton.csv",
                           "case,modes,steps,march_seconds,evaluations,jacobians,coarse_evaluations,coarse_jacobians,"
                           "newton_seconds,speed_up,march_residual,newton_residual,velocity,"
                           "velocity_difference,length_difference,growth,growth_seconds,growth_by_differences");
    const auto in_tube = [&](const std::string& name, double excess_area, double confinement, double ca,
                             SpheroidKind kind, Index n) {
        const double radius = 1 / confinement;
        compare(table, name, examples::Drive(Poiseuille<double>(ca, radius)),
                shape_in_tube<double>(excess_area, radius, kind, n), radius);
    };
    if (film) {
        in_tube("tube D=4.8 L=1/0.55 Ca=100", 4.8, 1 / 0.55, 100, SpheroidKind::prolate, 64);
        return;
    }
    const examples::Drive settling(Gravity<double>(47));
    const examples::Drive unbounded(UnboundedPoiseuille<double>(0.5));
    for (const Index n : {32, 48}) {
        const auto start = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, n);
        compare(table, "settling B0=47 D=0.6", settling, start);
        compare(table, "unbounded Poiseuille Ca=0.5 D=0.6", unbounded, start);
        in_tube("tube D=1.59 L=1/0.9 Ca=100", 1.59, 1 / 0.9, 100, SpheroidKind::prolate, n);
        in_tube("tube D=0.9 L=0.3 Ca=1", 0.9, 0.3, 1, SpheroidKind::prolate, n);
        in_tube("tube D=0.9 L=0.3 Ca=20 oblate start", 0.9, 0.3, 20, SpheroidKind::oblate, n);
        in_tube("tube D=0.9 L=0.3 Ca=40", 0.9, 0.3, 40, SpheroidKind::prolate, n);
    }
    examples::Report accuracy(directory, "equal_accuracy.csv", "method,modes_or_elements,velocity_error,seconds");
    equal_accuracy(accuracy, settling);
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"stationary_study", "Stationary states by Newton's method against time marching"};
    std::string directory;
    app.text("--out", directory, "directory that receives newton.csv and equal_accuracy.csv");
    bool film = false;
    app.flag("--film", film, "only the vesicle of the paper's Fig. 15, whose film is thin: takes minutes");
    return app.run(argc, argv, [&] {
        study(directory, film);
        return 0;
    });
}
