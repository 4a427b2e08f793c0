// SPDX-License-Identifier: MIT
// Error against time and against resolution, for a sphere in a tube, stationary vesicles and a transient: the paper's
// discretisation and step beside the spectral one with each integrator and Newton's method (docs/work_precision.md).
// Writes DIR/work_precision.csv, which plot_work_precision.py draws.

#include "../examples/support/simulation.hpp"
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/geometry/tube_shapes.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace work_precision {

namespace {

using namespace axistokes;
using examples::AnyDiscretization;

enum class Stepping { euler, order2, order3, adaptive, newton };
enum class Vesicle { settling, unbounded, tube };

/// What the errors are measured by, and the steps (or Newton's evaluations of the scene) that it took.
struct Outcome {
    double velocity = 0;  // drag factor for a sphere, position for a transient
    double length = 1;
    Index steps = 0;
};

/// How fine. The time step is fixed if `steps` is given, else automatic with `step_tolerance` where the integrator
/// estimates its error.
struct Setting {
    Index n = 0;
    Index steps = 0;
    double step_tolerance = 1e-4;
    double residual = 1e-6;
};

/// Errors that do not limit the discretisation.
double kernel_tolerance(const AnyDiscretization& discretization) {
    return discretization.judges_itself() ? 1e-12 : 1e-8;
}

const AnyDiscretization linear = AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt);
const AnyDiscretization spectral = AnyDiscretization::of(examples::DiscretizationKind::spectral, std::nullopt);

/// Of a time step; Newton's method is none.
ExtrapolatedEulerOfOrder integrator(Stepping stepping, double tolerance) {
    if (stepping == Stepping::adaptive) {
        return ExtrapolatedEulerOfOrder::for_tolerance(tolerance);
    }
    return ExtrapolatedEulerOfOrder(stepping == Stepping::order3 ? 3 : stepping == Stepping::order2 ? 2 : 1);
}

examples::Scene scene_of(const AnyDiscretization& discretization, const examples::Law& law,
                         const examples::Drive::Choice& flow, std::optional<double> tube_radius = {}) {
    examples::Surroundings surroundings;
    surroundings.tube_radius = tube_radius;
    return {examples::kernel_for(surroundings, kernel_tolerance(discretization)),
            discretization,
            law,
            examples::Drive(flow),
            examples::Solver(),
            examples::AnyWall()};
}

/// K of a sphere dragged along the axis of a tube.
Outcome drag(const AnyDiscretization& discretization, double confinement, Index n) {
    examples::Simulation simulation(
        scene_of(discretization, examples::RigidBody(), Gravity<double>(1.0), 1 / confinement),
        ExtrapolatedEulerOfOrder(1), sphere<double>(n));
    return {-2.0 / 9 / simulation.step().velocity, 1, 1};
}

/// Marches to a residual of 1e-2, then Newton.
Outcome newton(const examples::Scene& scene, const Meridian<double>& start, double residual) {
    SimulationParams<double> params;
    params.tolerance = 1e-2;
    examples::Simulation simulation(scene, ExtrapolatedEulerOfOrder(1), start, params);
    simulation.run();
    StationaryParams<double> newton_params;
    newton_params.tolerance = residual;
    examples::Newton solver(simulation.scene(), newton_params);
    const auto state =
        solver.solve(simulation.configuration().shape, simulation.initial_area(), simulation.initial_volume());
    const auto& z = state.configuration().shape.z;
    return {state.instant().velocity, z[z.size() - 1] - z[0],
            static_cast<Index>(simulation.history().size()) + state.evaluations};
}

/// Stationary velocity and length: D = 0.6, B0 = 47 (Fig. 5); D = 0.6, Ca_unb = 0.5 (Fig. 7); D = 1.59, Rc = 0.9,
/// Ca = 100 (Fig. 14). All from the prolate spheroid.
Outcome stationary(const AnyDiscretization& discretization, Vesicle vesicle, Stepping stepping,
                   const Setting& setting) {
    constexpr double kRadius = 0.9;
    const bool tube = vesicle == Vesicle::tube;
    const double excess_area = tube ? 1.59 : 0.6;
    const auto kind = SpheroidKind::prolate;
    const auto start = tube ? shape_in_tube<double>(excess_area, kRadius, kind, setting.n)
                            : spheroid_of_excess_area<double>(excess_area, kind, setting.n);
    const auto flow = tube                           ? examples::Drive::Choice(Poiseuille<double>(100.0, kRadius))
                      : vesicle == Vesicle::settling ? examples::Drive::Choice(Gravity<double>(47.0))
                                                     : examples::Drive::Choice(UnboundedPoiseuille<double>(0.5));
    const examples::Scene scene =
        scene_of(discretization, examples::Vesicle(), flow, tube ? std::optional(kRadius) : std::nullopt);
    if (stepping == Stepping::newton) {
        return newton(scene, start, setting.residual);
    }
    SimulationParams<double> params;
    params.tolerance = setting.residual;
    params.step_tolerance = setting.step_tolerance;
    examples::Simulation simulation(scene, integrator(stepping, setting.step_tolerance), start, params);
    simulation.run();
    const auto& last = simulation.history().back();
    return {last.velocity, last.length, last.step};
}

/// Position and length at time 0.1 of the settling vesicle.
Outcome transient(const AnyDiscretization& discretization, Stepping stepping, const Setting& setting) {
    constexpr double kTime = 0.1;
    SimulationParams<double> params;
    params.tolerance = 8 * std::numeric_limits<double>::epsilon();
    params.longest_time = kTime;
    params.step_tolerance = setting.step_tolerance;
    if (setting.steps > 0) {
        params.time_step = kTime / static_cast<double>(setting.steps);
        params.most_steps = setting.steps;
        params.longest_time = 2 * kTime;
    }
    const auto start = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, setting.n);
    examples::Simulation simulation(scene_of(discretization, examples::Vesicle(), Gravity<double>(47.0)),
                                    integrator(stepping, setting.step_tolerance), start, params);
    simulation.run();
    const auto& last = simulation.history().back();
    return {last.position, last.length, last.step};
}

class Table {
  public:
    explicit Table(const std::filesystem::path& directory) {
        std::filesystem::create_directories(directory);
        file_.open(directory / "work_precision.csv");
        if (!file_) {
            throw std::runtime_error((directory / "work_precision.csv").string() + ": cannot be written");
        }
        file_ << "scene,line,n,steps,seconds,error\n";
        std::cout << std::left << std::setw(12) << "scene" << std::setw(22) << "line" << std::right << std::setw(5)
                  << "n" << std::setw(8) << "steps" << std::setw(12) << "seconds" << std::setw(12) << "error" << '\n';
    }

    /// Runs `run`, several times if it is quick, and adds a row with the median time. A failure is a row without error.
    template <class Run>
    void add(const std::string& scene, const std::string& line, Index n, const Outcome& exact, const Run& run) {
        std::vector<double> seconds;
        Outcome outcome;
        double total = 0;
        try {
            while (seconds.size() < 5 && (seconds.empty() || total + seconds[0] < 1.5)) {
                const auto begin = std::chrono::steady_clock::now();
                outcome = run();
                seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
                total += seconds.back();
            }
        } catch (const axistokes::SimulationFailure& failure) {
            std::cout << scene << ", " << line << ", n = " << n << ": " << failure.what() << std::endl;
            return;
        }
        std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                         seconds.end());
        const double median = seconds[seconds.size() / 2];
        const double error =
            std::max(std::abs(outcome.velocity / exact.velocity - 1), std::abs(outcome.length / exact.length - 1));
        file_ << scene << ",\"" << line << "\"," << n << ',' << outcome.steps << ',' << std::setprecision(6) << median
              << ',' << error << std::endl;
        std::cout << std::left << std::setw(12) << scene << std::setw(22) << line << std::right << std::setw(5) << n
                  << std::setw(8) << outcome.steps << std::setw(12) << std::setprecision(3) << median << std::setw(12)
                  << std::setprecision(2) << std::scientific << error << std::defaultfloat << std::endl;
    }

  private:
    std::ofstream file_;
};

void print_exact(const std::string& scene, const Outcome& exact) {
    std::cout << std::setprecision(11) << scene << ", reference: " << exact.velocity << ", " << exact.length
              << std::endl;
}

void drags(Table& table) {
    // tests/sphere_in_tube_reference.hpp
    for (const auto& [name, confinement, exact] :
         {std::tuple("drag 0.5", 0.5, 5.947374246), std::tuple("drag 0.9", 0.9, 469.2243905)}) {
        const double l = confinement;
        for (const Index n : {16, 32, 64, 130, 260, 520}) {
            table.add(name, "P1", n, {exact, 1, 0}, [&] { return drag(linear, l, n); });
        }
        for (const Index n : {8, 12, 16, 20, 24, 32, 40, 48}) {
            table.add(name, "spectral", n, {exact, 1, 0}, [&] { return drag(spectral, l, n); });
        }
    }
}

void stationary_vesicles(Table& table) {
    for (const auto& [name, scene] : {std::pair("settling", Vesicle::settling),
                                      std::pair("unbounded", Vesicle::unbounded), std::pair("tube", Vesicle::tube)}) {
        const Vesicle s = scene;
        const Outcome exact = stationary(spectral, s, Stepping::euler, {96, 0, 1e-4, 1e-10});
        print_exact(name, exact);
        for (const Index n : {34, 65, 130, 260}) {
            table.add(name, "P1, Euler", n, exact, [&] {
                return stationary(linear, s, Stepping::euler, {n, 0, 1e-4, 1e-6});
            });
        }
        for (const Index n : {34, 65, 130}) {
            table.add(name, "P1, Newton", n, exact, [&] {
                return stationary(linear, s, Stepping::newton, {n, 0, 1e-4, 1e-6});
            });
        }
        for (const auto& [line, stepping] :
             {std::pair("spectral, Euler", Stepping::euler), std::pair("spectral, order 2", Stepping::order2),
              std::pair("spectral, order 3", Stepping::order3), std::pair("spectral, Newton", Stepping::newton)}) {
            const Stepping how = stepping;
            for (const Index n : {12, 16, 24, 32, 40, 48, 64}) {
                table.add(name, line, n, exact, [&] { return stationary(spectral, s, how, {n, 0, 1e-3, 1e-9}); });
            }
        }
    }
}

void transients(Table& table) {
    const Outcome exact = transient(spectral, Stepping::adaptive, {64, 0, 1e-11});
    print_exact("transient", exact);
    for (const Index n : {65, 130, 260}) {
        for (const Index steps : {16, 64, 256}) {
            table.add("transient", "P1, Euler, N = " + std::to_string(n), n, exact, [&] {
                return transient(linear, Stepping::euler, {n, steps});
            });
        }
    }
    constexpr Index kModes = 48;
    for (const auto& [line, stepping] :
         {std::pair("spectral, Euler", Stepping::euler), std::pair("spectral, order 2", Stepping::order2),
          std::pair("spectral, order 3", Stepping::order3)}) {
        const Stepping how = stepping;
        for (const Index steps : {4, 8, 16, 32, 64, 128, 256}) {
            table.add("transient", line, kModes, exact, [&] { return transient(spectral, how, {kModes, steps}); });
        }
    }
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
        table.add("transient", "spectral, adaptive", kModes, exact, [&] {
            return transient(spectral, Stepping::adaptive, {kModes, 0, tolerance});
        });
    }
}

}  // namespace
}  // namespace work_precision

int main(int argc, char** argv) {
    const std::string directory = argc > 1 ? argv[1] : "";
    if (argc != 2 || directory.substr(0, 1) == "-") {
        std::cerr << "usage: work_precision DIR\n";
        return directory == "--help" ? EXIT_SUCCESS : 2;
    }
    try {
        work_precision::Table table(directory);
        work_precision::drags(table);
        work_precision::stationary_vesicles(table);
        work_precision::transients(table);
    } catch (const std::exception& error) {
        std::cerr << "work_precision: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
