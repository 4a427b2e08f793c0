// SPDX-License-Identifier: MIT
// Error and cost of vesicles on piecewise polynomials, series and P1 elements: stationary ones, with what the
// discretisation says of itself, and tethers and pearls on their way (docs/adaptive.md).
#include "support/command_line.hpp"
#include "support/neck.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/accuracy/resolution.hpp>
#include <axistokes/geometry/tube_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace axistokes;
using examples::AnyDiscretization;
using examples::DiscretizationKind;

struct Shape {
    std::string name;
    examples::Drive drive;
    Meridian<double> start;
    double excess_area;
    std::optional<double> tube_radius;
    std::vector<Index> adaptive;
    std::vector<Index> spectral;
    std::vector<Index> linear;
    Index reference;  // elements of the adaptive solution that the others are compared with
};

const std::map<DiscretizationKind, std::string> names{{DiscretizationKind::linear, "linear"},
                                                      {DiscretizationKind::spectral, "spectral"},
                                                      {DiscretizationKind::adaptive, "adaptive"}};

class Study {
  public:
    explicit Study(const Shape& vesicle)
        : vesicle_(vesicle), near_(marched()), exact_(state(made(DiscretizationKind::adaptive), vesicle.reference)) {}

    void write(examples::Report& table) {
        rows(table, DiscretizationKind::adaptive, vesicle_.adaptive);
        rows(table, DiscretizationKind::spectral, vesicle_.spectral);
        rows(table, DiscretizationKind::linear, vesicle_.linear);
    }

  private:
    struct State {
        double velocity;
        double length;
        double unresolved;
        double seconds;
    };

    static AnyDiscretization made(DiscretizationKind kind) {
        return AnyDiscretization::of(kind, kind == DiscretizationKind::linear ? 1e-6 : 1e-11);
    }

    examples::Scene scene(const AnyDiscretization& discretization) const {
        examples::Surroundings surroundings;
        surroundings.tube_radius = vesicle_.tube_radius;
        return {examples::kernel_for(surroundings, 1e-11),
                discretization,
                examples::Law(examples::Vesicle()),
                vesicle_.drive,
                examples::Solver(),
                examples::AnyWall()};
    }

    /// Close to the stationary state.
    Meridian<double> marched() const {
        const auto discretization = AnyDiscretization::of(DiscretizationKind::adaptive, 1e-6);
        Meridian<double> shape = vesicle_.start;
        for (int i = 0; i < 4; ++i) {
            shape = discretization.redistributed(shape, 80);
        }
        SimulationParams<double> params;
        params.tolerance = 1e-4;
        params.step_tolerance = 1e-3;
        examples::Simulation march(scene(discretization), ExtrapolatedEulerOfOrder(3), shape, params);
        march.run();
        return march.configuration().shape;
    }

    State state(const AnyDiscretization& discretization, Index n) const {
        Meridian<double> start = near_;
        for (int i = 0; i < 4; ++i) {
            start = discretization.redistributed(start, n);
        }
        StationaryParams<double> params;
        params.tolerance = discretization.kind() == DiscretizationKind::linear ? 1e-8 : 1e-9;
        examples::Newton newton(scene(discretization), params);
        const double pi = detail::pi_value<double>();
        const std::clock_t begin = std::clock();
        const auto found = newton.solve(start, 4 * pi + vesicle_.excess_area, 4 * pi / 3);
        const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        const auto& shape = found.configuration().shape;
        return {found.instant().velocity, shape.z[shape.elements()] - shape.z[0], discretization.unresolved(shape),
                seconds};
    }

    void rows(examples::Report& table, DiscretizationKind kind, const std::vector<Index>& elements) {
        const AnyDiscretization discretization = made(kind);
        for (const Index n : elements) {
            try {
                const State found = state(discretization, n);
                table.row(vesicle_.name, names.at(kind), n, std::abs(found.velocity / exact_.velocity - 1),
                          std::abs(found.length / exact_.length - 1), "", found.unresolved, found.seconds);
            } catch (const SimulationFailure& failure) {
                table.row(vesicle_.name, names.at(kind), n, '"' + std::string(failure.what()) + '"');
            }
        }
    }

    Shape vesicle_;
    Meridian<double> near_;
    State exact_;
};

/// A heavy vesicle that pulls a tether, until a given time.
struct Pull {
    std::string name;
    double excess_area;
    double bond;
    double time;
    std::vector<Index> adaptive;
    std::vector<Index> spectral;
    std::vector<Index> linear;
    Index reference;
    double step_tolerance;
    double finest_step_tolerance;
};

class PullStudy {
  public:
    explicit PullStudy(const Pull& pull)
        : pull_(pull), exact_(state(DiscretizationKind::adaptive, pull.reference, pull.finest_step_tolerance)) {
        std::cout << std::setprecision(9) << pull_.name << ", reference: velocity " << exact_.velocity << ", height "
                  << exact_.height << ", neck " << exact_.neck << ", " << exact_.steps << " steps, "
                  << std::setprecision(3) << exact_.seconds << " s\n";
    }

    void write(examples::Report& table) {
        rows(table, DiscretizationKind::adaptive, pull_.adaptive);
        rows(table, DiscretizationKind::spectral, pull_.spectral);
        rows(table, DiscretizationKind::linear, pull_.linear);
    }

  private:
    struct State {
        double velocity;
        double height;
        double neck;
        double unresolved;
        Index steps;
        double seconds;
    };

    State state(DiscretizationKind kind, Index n, double step_tolerance) const {
        const auto discretization = AnyDiscretization::of(kind, 1e-8);
        const auto spheroid = [&](Index elements) {
            return spheroid_of_excess_area<double>(pull_.excess_area, SpheroidKind::prolate, elements);
        };
        SimulationParams<double> params;
        params.longest_time = pull_.time;
        params.step_tolerance = step_tolerance;
        Meridian<double> start = nodes_of(discretization, spheroid, n);
        const double pi = detail::pi_value<double>();
        if (discretization.judges_itself()) {
            discretization.restore(start, 4 * pi + pull_.excess_area, 4 * pi / 3);
        }
        const std::clock_t begin = std::clock();
        examples::Simulation simulation = examples::free_simulation(
            discretization, examples::Law(examples::Vesicle()), examples::Drive(Gravity<double>(pull_.bond)), start,
            params, ExtrapolatedEulerOfOrder::for_tolerance(step_tolerance));
        try {
            simulation.run([&](const auto&) { return seconds_since(begin) < most_seconds; });
        } catch (const SimulationFailure& failure) {
            fail(simulation, failure.what());
        }
        if (!(simulation.history().back().time > pull_.time * (1 - 1e-9))) {
            fail(simulation, "more than " + detail::text(most_seconds) + " s");
        }
        const auto& last = simulation.history().back();
        const auto& shape = simulation.configuration().shape;
        const auto neck = examples::tube_neck(shape);
        if (!neck) {
            throw SimulationFailure("no tether");
        }
        return {simulation.moment().instants.front().velocity,
                last.length,
                least_radius(shape, *neck),
                discretization.unresolved(shape),
                last.step,
                seconds_since(begin)};
    }

    [[noreturn]] static void fail(const examples::Simulation& simulation, const std::string& cause) {
        const auto& history = simulation.history();
        std::ostringstream text;
        text << "at time " << (history.empty() ? 0 : history.back().time) << ": " << cause;
        throw SimulationFailure(text.str());
    }

    static double seconds_since(std::clock_t begin) {
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }

    /// Of the cubic through four nodes about the neck, as a function of z.
    static double least_radius(const Meridian<double>& shape, Index neck) {
        const Index first = shape.r[neck - 1] < shape.r[neck + 1] ? neck - 2 : neck - 1;
        const auto radius = [&](double z) {
            double sum = 0;
            for (Index i = first; i < first + 4; ++i) {
                double factor = shape.r[i];
                for (Index k = first; k < first + 4; ++k) {
                    factor *= k == i ? 1.0 : (z - shape.z[k]) / (shape.z[i] - shape.z[k]);
                }
                sum += factor;
            }
            return sum;
        };
        double low = shape.z[neck - 1];
        double high = shape.z[neck + 1];
        for (int k = 0; k < 60; ++k) {
            const double third = (high - low) / 3;
            if (radius(low + third) < radius(high - third)) {
                high -= third;
            } else {
                low += third;
            }
        }
        return radius((low + high) / 2);
    }

    void rows(examples::Report& table, DiscretizationKind kind, const std::vector<Index>& elements) {
        for (const Index n : elements) {
            try {
                const State found = state(kind, n, pull_.step_tolerance);
                table.row(pull_.name, names.at(kind), n, std::abs(found.velocity / exact_.velocity - 1),
                          std::abs(found.height / exact_.height - 1), std::abs(found.neck / exact_.neck - 1),
                          found.unresolved, found.seconds);
            } catch (const SimulationFailure& failure) {
                table.row(pull_.name, names.at(kind), n, '"' + std::string(failure.what()) + '"');
            }
        }
    }

    static constexpr double most_seconds = 60;  // of a run

    Pull pull_;
    State exact_;
};

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"adaptive_study", "Stationary vesicles on piecewise polynomials, series and P1 elements"};
    std::string directory;
    app.text("--out", directory, "directory that receives adaptive.csv");
    std::string only;
    app.text("--only", only, "the vesicles whose names contain this, e.g. \"Fig. 8\"; without it all");
    return app.run(argc, argv, [&] {
        std::cout.precision(3);
        examples::Report table(
            directory, "adaptive.csv",
            "vesicle,discretization,elements,velocity_error,length_error,neck_error,unresolved,seconds");
        const auto wanted = [&](const std::string& name) { return name.find(only) != std::string::npos; };
        const auto spheroid = [](double excess_area) {
            return spheroid_of_excess_area<double>(excess_area, SpheroidKind::prolate, 200);
        };
        const auto in_tube = [](double excess_area, double radius) {
            return shape_in_tube<double>(excess_area, radius, SpheroidKind::prolate, 200);
        };
        const std::vector<Index> smooth{24, 32, 40, 50, 70, 100};
        const std::vector<Index> modes{16, 24, 32, 48, 64, 96};
        const std::vector<Index> elements{64, 128, 256};
        for (const Shape& vesicle : {
                 Shape{"Fig. 5",
                       examples::Drive(Gravity<double>(47)),
                       spheroid(0.6),
                       0.6,
                       {},
                       smooth,
                       modes,
                       elements,
                       160},
                 Shape{"Fig. 7",
                       examples::Drive(UnboundedPoiseuille<double>(20)),
                       spheroid(1),
                       1,
                       {},
                       smooth,
                       modes,
                       elements,
                       160},
                 Shape{"Fig. 14", examples::Drive(Poiseuille<double>(100, 1 / 0.9)), in_tube(1.59, 1 / 0.9), 1.59,
                       1 / 0.9, smooth, modes, elements, 160},
                 Shape{"Fig. 15",
                       examples::Drive(Poiseuille<double>(100, 0.55)),
                       in_tube(4.8, 0.55),
                       4.8,
                       0.55,
                       {50, 70, 100, 140, 200},
                       {64, 96, 128, 160},
                       {},
                       300},
                 Shape{"Fig. 19",
                       examples::Drive(Gravity<double>(216)),
                       spheroid(0.93),
                       0.93,
                       5,
                       {32, 40, 50, 70, 100, 140},
                       {32, 48, 64, 96, 128, 160},
                       elements,
                       200},
                 Shape{"Fig. 8 with B0 = 200",
                       examples::Drive(Gravity<double>(200)),
                       spheroid(0.93),
                       0.93,
                       {},
                       {32, 40, 50, 70, 100, 140},
                       {32, 48, 64, 96, 128, 160},
                       elements,
                       200},
             }) {
            if (wanted(vesicle.name)) {
                Study(vesicle).write(table);
            }
        }
        for (const Pull& pull : {
                 Pull{"Fig. 8 at t = 0.3",
                      0.93,
                      392,
                      0.3,
                      {32, 40, 50, 70, 100, 140},
                      {48, 64, 96, 128, 160},
                      {64, 128, 256},
                      200,
                      1e-6,
                      1e-8},
                 Pull{"Fig. 9 at t = 0.004",
                      0.73,
                      9320,
                      0.004,
                      {40, 50, 70, 100, 140},
                      {64, 96, 128, 160},
                      {64, 128, 256},
                      300,
                      1e-6,
                      1e-7},
             }) {
            if (wanted(pull.name)) {
                PullStudy(pull).write(table);
            }
        }
        return 0;
    });
}
