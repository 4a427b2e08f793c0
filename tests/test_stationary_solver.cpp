// SPDX-License-Identifier: MIT
// Stationary shapes found directly, against time marching.
#include "catch.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/sum.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/extrapolated_euler.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <cmath>

namespace {

using namespace axistokes;

constexpr Index kElements = 24;

/// One type for all cases: each takes long to compile.
using Flow = Sum<UnboundedPoiseuille<double>, Gravity<double>>;
using SceneType = Scene<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Flow, DenseLU<double>>;
using March = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Flow, SemiImplicitEuler,
                        DenseLU<double>>;

Flow flow(double capillary_number, double bond) {
    return {UnboundedPoiseuille<double>(capillary_number), Gravity<double>(bond)};
}

/// The discrete state depends on the nodes' spacing, by O(h^2): both methods must end with the same one.
LinearElements<double> tightly_spaced() {
    LinearElements<double>::Params params;
    params.meshing.largest_distortion = 1 + 1e-7;
    return LinearElements<double>(params);
}

March march(const Flow& background, SpheroidKind kind, double excess_area, double tolerance, Index steps) {
    SimulationParams<double> params;
    params.tolerance = tolerance;
    params.most_steps = steps;
    March simulator(spheroid_of_excess_area<double>(excess_area, kind, kElements), background, params, {},
                    tightly_spaced());
    simulator.run();
    return simulator;
}

void agrees_with_marching(const Flow& background, SpheroidKind kind, double excess_area) {
    const auto reference = march(background, kind, excess_area, 1e-8, 3000);
    REQUIRE(reference.stationary());
    const auto start = march(background, kind, excess_area, 1e-8, 10);
    StationarySolver<SceneType> solver(SceneType({}, tightly_spaced(), {}, background, {}));
    const auto state = solver.solve(start.configuration().shape, start.initial_area(), start.initial_volume());
    CHECK(state.residual < 1e-9);
    CHECK(state.evaluations < static_cast<Index>(reference.history().size()));
    const Meridian<double>& expected = reference.configuration().shape;
    const Meridian<double>& found = state.configuration().shape;
    CHECK((found.r - expected.r).cwiseAbs().maxCoeff() < 1e-6);
    CHECK((found.z - expected.z).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(state.instant().velocity == Approx(reference.history().back().velocity).epsilon(1e-6).margin(1e-6));
    const auto measures = solver.scene().discretization().measures(found);
    CHECK(measures.area == Approx(start.initial_area()).epsilon(1e-10));
    CHECK(measures.volume == Approx(start.initial_volume()).epsilon(1e-10));
    CHECK(solver.growth_rates(state).front().real() < 0);
}

TEST_CASE("Newton agrees with marching: relaxed prolate") {
    agrees_with_marching(flow(0, 0), SpheroidKind::prolate, 0.6);
}

TEST_CASE("Newton agrees with marching: relaxed oblate") {
    agrees_with_marching(flow(0, 0), SpheroidKind::oblate, 0.6);
}

TEST_CASE("Newton agrees with marching: Poiseuille flow") {
    agrees_with_marching(flow(0.5, 0), SpheroidKind::prolate, 0.6);
}

TEST_CASE("Newton agrees with marching: settling") {
    agrees_with_marching(flow(0, 47), SpheroidKind::prolate, 0.6);
}

TEST_CASE("To round-off: on below the tolerance, by a few evaluations more") {
    const auto start = march(flow(0, 47), SpheroidKind::prolate, 0.6, 1e-8, 10);
    const SceneType scene({}, tightly_spaced(), {}, flow(0, 47), {});
    const auto solved = [&](bool to_round_off) {
        StationaryParams<double> params;
        params.tolerance = 1e-5;
        params.to_round_off = to_round_off;
        return StationarySolver<SceneType>(scene, params)
            .solve(start.configuration().shape, start.initial_area(), start.initial_volume());
    };
    const auto near = solved(false);
    const auto exact = solved(true);
    CHECK(near.residual < 1e-5);
    CHECK(exact.residual < 1e-9);
    CHECK(exact.evaluations > near.evaluations);
    // A factor of 5 or more each, but for the last one.
    const double factors = std::log(near.residual / exact.residual) / std::log(5.0);
    CHECK(static_cast<double>(exact.evaluations - near.evaluations) <= factors + 1);
    CHECK(exact.coarse_evaluations == near.coarse_evaluations);
}

TEST_CASE("P1 elements: few evaluations from a spheroid, and the linearisation's growth rates") {
    StationarySolver<SceneType> solver(SceneType({}, LinearElements<double>(), {}, flow(0, 47), {}));
    const Meridian<double> shape = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 2 * kElements);
    const auto measures = solver.scene().discretization().measures(shape);
    const auto state = solver.solve(shape, measures.area, measures.volume);
    CHECK(state.residual < 1e-9);
    CHECK(state.evaluations + state.coarse_evaluations <= 20);
    const double rate = solver.growth_rates(state).front().real();
    CHECK(rate == Approx(solver.growth_rates(state, 1e-5).front().real()).epsilon(0.02));
    CHECK(state.growth == Approx(rate).epsilon(0.05));
}

TEST_CASE("The leading growth rate is the decay rate of a small disturbance") {
    const Flow quiescent = flow(0, 0);
    const auto start = march(quiescent, SpheroidKind::prolate, 0.6, 1e-8, 10);
    LinearElements<double>::Params free_nodes;
    free_nodes.meshing.largest_distortion = 1e9;
    StationarySolver<SceneType> solver(SceneType({}, LinearElements<double>(free_nodes), {}, quiescent, {}));
    const auto state = solver.solve(start.configuration().shape, start.initial_area(), start.initial_volume());
    const double rate = solver.growth_rates(state).front().real();
    REQUIRE(rate < 0);

    Meridian<double> disturbed = state.configuration().shape;
    disturbed.z.array() += 1e-3 * disturbed.z.array().square();
    SimulationParams<double> params;
    params.time_step = 0.02 / -rate;
    params.most_steps = 300;
    params.tolerance = 1e-13;
    Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Flow, ThirdOrder, DenseLU<double>>
        simulator(disturbed, quiescent, params, {}, LinearElements<double>(free_nodes));
    simulator.run();
    const auto& history = simulator.history();
    const double measured = std::log(history[299].residual / history[249].residual) / (50 * *params.time_step);
    CHECK(measured == Approx(rate).epsilon(0.02));
}

TEST_CASE("A shape that cannot have the area is reported") {
    StationarySolver<SceneType> solver(SceneType({}, tightly_spaced(), {}, flow(0, 0), {}));
    const Meridian<double> shape = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, kElements);
    CHECK_THROWS_AS(solver.solve(shape, 1.0, 4.0), SimulationFailure);
}

}  // namespace
