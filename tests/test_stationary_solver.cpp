// SPDX-License-Identifier: MIT
// Stationary shapes found directly, against time marching.
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <cmath>

namespace {

using namespace axistokes;

constexpr Index kElements = 24;

template <class Flow>
using SceneOf = Scene<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Flow, DenseLU<double>>;
template <class Flow>
using MarchOf = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Flow, SemiImplicitEuler,
                          DenseLU<double>>;

/// The discrete state depends on the nodes' spacing, by O(h^2): both methods must end with the same one.
LinearElements<double> tightly_spaced() {
    LinearElements<double>::Params params;
    params.meshing.largest_distortion = 1 + 1e-7;
    return LinearElements<double>(params);
}

template <class Flow>
MarchOf<Flow> march(const Flow& flow, SpheroidKind kind, double excess_area, double tolerance, Index steps) {
    SimulationParams<double> params;
    params.tolerance = tolerance;
    params.most_steps = steps;
    MarchOf<Flow> simulator(spheroid_of_excess_area<double>(excess_area, kind, kElements), flow, params, {},
                            tightly_spaced());
    simulator.run();
    return simulator;
}

template <class Flow>
void agrees_with_marching(const Flow& flow, SpheroidKind kind, double excess_area) {
    const auto reference = march(flow, kind, excess_area, 1e-8, 3000);
    REQUIRE(reference.stationary());
    const auto start = march(flow, kind, excess_area, 1e-8, 10);
    StationarySolver<SceneOf<Flow>> solver(SceneOf<Flow>({}, tightly_spaced(), {}, flow, {}));
    const auto state = solver.solve(start.configuration().shape, start.initial_area(), start.initial_volume());
    CHECK(state.residual < 1e-9);
    CHECK(state.evaluations < static_cast<Index>(reference.history().size()));
    const Meridian<double>& expected = reference.configuration().shape;
    const Meridian<double>& found = state.configuration.shape;
    CHECK((found.r - expected.r).cwiseAbs().maxCoeff() < 1e-6);
    CHECK((found.z - expected.z).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(state.instant.velocity == Approx(reference.history().back().velocity).epsilon(1e-6).margin(1e-6));
    const auto measures = solver.scene().discretization().measures(found);
    CHECK(measures.area == Approx(start.initial_area()).epsilon(1e-10));
    CHECK(measures.volume == Approx(start.initial_volume()).epsilon(1e-10));
    CHECK(solver.growth_rates(state).front().real() < 0);
}

TEST_CASE("Newton agrees with marching: relaxed prolate") {
    agrees_with_marching(Quiescent<double>{}, SpheroidKind::prolate, 0.6);
}

TEST_CASE("Newton agrees with marching: relaxed oblate") {
    agrees_with_marching(Quiescent<double>{}, SpheroidKind::oblate, 0.6);
}

TEST_CASE("Newton agrees with marching: Poiseuille flow") {
    agrees_with_marching(UnboundedPoiseuille<double>(0.5), SpheroidKind::prolate, 0.6);
}

TEST_CASE("Newton agrees with marching: settling") {
    agrees_with_marching(Gravity<double>(47.0), SpheroidKind::prolate, 0.6);
}

TEST_CASE("The leading growth rate is the decay rate of a small disturbance") {
    const Quiescent<double> flow;
    const auto start = march(flow, SpheroidKind::prolate, 0.6, 1e-8, 10);
    LinearElements<double>::Params free_nodes;
    free_nodes.meshing.largest_distortion = 1e9;
    StationarySolver<SceneOf<Quiescent<double>>> solver(
        SceneOf<Quiescent<double>>({}, LinearElements<double>(free_nodes), {}, flow, {}));
    const auto state = solver.solve(start.configuration().shape, start.initial_area(), start.initial_volume());
    const double rate = solver.growth_rates(state).front().real();
    REQUIRE(rate < 0);

    Meridian<double> disturbed = state.configuration.shape;
    disturbed.z.array() += 1e-3 * disturbed.z.array().square();
    SimulationParams<double> params;
    params.time_step = 0.02 / -rate;
    params.most_steps = 300;
    params.tolerance = 1e-13;
    Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Quiescent<double>, ThirdOrder,
              DenseLU<double>>
        simulator(disturbed, flow, params, {}, LinearElements<double>(free_nodes));
    simulator.run();
    const auto& history = simulator.history();
    const double measured = std::log(history[299].residual / history[249].residual) / (50 * *params.time_step);
    CHECK(measured == Approx(rate).epsilon(0.02));
}

TEST_CASE("A shape that cannot have the area is reported") {
    StationarySolver<SceneOf<Quiescent<double>>> solver(
        SceneOf<Quiescent<double>>({}, tightly_spaced(), {}, Quiescent<double>{}, {}));
    const Meridian<double> shape = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, kElements);
    CHECK_THROWS_AS(solver.solve(shape, 1.0, 4.0), SimulationFailure);
}

}  // namespace
