// SPDX-License-Identifier: MIT
// Stationary shapes on a spectral meridian without walls, found directly, against time marching.
#include "catch.hpp"
#include "stationary_support.hpp"
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/sum.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

namespace {

using namespace axistokes;

using Flow = Sum<UnboundedPoiseuille<double>, Gravity<double>>;
using March = Simulator<FreeSpaceKernel<double>, SpectralMeridian<double>, Vesicle<double>, Flow, SemiImplicitEuler,
                        DenseLU<double>>;
using Solver = StationarySolver<March::SceneType>;

Flow flow(double capillary_number, double bond) {
    return {UnboundedPoiseuille<double>(capillary_number), Gravity<double>(bond)};
}

/// From the same spheroid; the coarse integrals and derivatives must not show in the result.
void agrees_with_marching(const Flow& f, Index elements, Index most_evaluations) {
    SimulationParams<double> params;
    params.tolerance = 1e-8;
    const auto start = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, elements);
    March march(start, f, params);
    march.run();
    REQUIRE(march.stationary());
    Solver newton(March::SceneType({}, SpectralMeridian<double>(), {}, f, {}));
    const auto state = newton.solve(start, march.initial_area(), march.initial_volume());
    CHECK(state.residual < 1e-9);
    CHECK(state.evaluations <= most_evaluations);
    CHECK(state.instant().velocity == Approx(march.history().back().velocity).epsilon(1e-6));
    CHECK(stationary::distance(state.configuration().shape, march.configuration().shape) < 1e-6);
    const auto measures = newton.scene().discretization().measures(state.configuration().shape);
    CHECK(measures.area == Approx(march.initial_area()).epsilon(1e-10));
    CHECK(measures.volume == Approx(march.initial_volume()).epsilon(1e-10));

    const auto rates = newton.growth_rates(state);
    const auto by_differences = newton.growth_rates(state, 1e-5);
    CHECK(rates[0].real() == Approx(by_differences[0].real()).epsilon(0.005));
    CHECK(rates[1].real() == Approx(by_differences[1].real()).epsilon(0.005));
    CHECK(rates[0].real() < 0);
}

TEST_CASE("Spectral Newton agrees with marching: settling") {
    agrees_with_marching(flow(0, 47), 48, 8);
}

TEST_CASE("Spectral Newton agrees with marching: Poiseuille flow") {
    agrees_with_marching(flow(0.5, 0), 32, 6);
}

}  // namespace
