// SPDX-License-Identifier: MIT
// Error and cost of stationary vesicles on piecewise polynomials, series and P1 elements, and how the error compares
// with what the discretisation says of itself (docs/adaptive.md).
#include "support/command_line.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
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
                          std::abs(found.length / exact_.length - 1), found.unresolved, found.seconds);
            } catch (const SimulationFailure& failure) {
                table.row(vesicle_.name, names.at(kind), n, failure.what());
            }
        }
    }

    Shape vesicle_;
    Meridian<double> near_;
    State exact_;
};

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"adaptive_study", "Stationary vesicles on piecewise polynomials, series and P1 elements"};
    std::string directory;
    app.text("--out", directory, "directory that receives adaptive.csv");
    return app.run(argc, argv, [&] {
        std::cout.precision(3);
        examples::Report table(directory, "adaptive.csv",
                               "vesicle,discretization,elements,velocity_error,length_error,unresolved,seconds");
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
             }) {
            Study(vesicle).write(table);
        }
        return 0;
    });
}
