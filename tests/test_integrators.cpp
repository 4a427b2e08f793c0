// SPDX-License-Identifier: MIT
// Orders and step control of the time integrators, on a settling vesicle (D = 0.6, B0 = 47).
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <cmath>

namespace {

using namespace axistokes;

constexpr Index kElements = 24;

template <class Integrator>
using Settling = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                           Integrator, DenseLU<double>>;

/// Nodes that stay where the motion takes them: a redistribution is an event that no power of dt describes.
LinearElements<double> without_redistribution() {
    LinearElements<double>::Params params;
    params.meshing.largest_distortion = 1e9;
    return LinearElements<double>(params);
}

template <class Integrator>
Settling<Integrator> settling(const SimulationParams<double>& params) {
    return Settling<Integrator>(spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, kElements),
                                Gravity<double>(47.0), params, {}, without_redistribution());
}

template <class Integrator>
Vector<double> nodes_after(double time, Index steps) {
    SimulationParams<double> params;
    params.time_step = time / static_cast<double>(steps);
    params.most_steps = steps;
    params.tolerance = 1e-13;
    auto simulator = settling<Integrator>(params);
    simulator.run();
    const Meridian<double> shape = simulator.shape();
    Vector<double> result(2 * shape.nodes());
    result << shape.r, shape.z;
    return result;
}

/// From the differences of three solutions.
template <class Integrator>
double observed_order(double time, Index steps) {
    const Vector<double> coarse = nodes_after<Integrator>(time, steps);
    const Vector<double> middle = nodes_after<Integrator>(time, 2 * steps);
    const Vector<double> fine = nodes_after<Integrator>(time, 4 * steps);
    return std::log2((coarse - middle).norm() / (middle - fine).norm());
}

TEST_CASE("Integrators converge with their order, area and volume corrected after every step") {
    CHECK(observed_order<SemiImplicitEuler>(0.1, 64) == Approx(1).margin(0.1));
    CHECK(observed_order<SecondOrder>(0.1, 64) == Approx(2).margin(0.15));
    CHECK(observed_order<ThirdOrder>(0.1, 64) == Approx(3).margin(0.25));
    CHECK(observed_order<ExtrapolatedEuler<4>>(0.02, 32) == Approx(4).margin(0.25));
}

TEST_CASE("Where round-off hides the orders above, each gains a digit") {
    const Vector<double> exact = nodes_after<ExtrapolatedEuler<6>>(0.02, 32);
    const auto error = [&](const Vector<double>& nodes) { return (nodes - exact).norm(); };
    const double fourth = error(nodes_after<ExtrapolatedEuler<4>>(0.02, 8));
    const double fifth = error(nodes_after<ExtrapolatedEuler<5>>(0.02, 8));
    const double sixth = error(nodes_after<ExtrapolatedEuler<6>>(0.02, 8));
    CHECK(fifth < fourth / 10);
    CHECK(sixth < fifth / 10);
    CHECK(error(nodes_after<ExtrapolatedEuler<5>>(0.02, 16)) < fifth / 12);
}

TEST_CASE("Integrators of different orders converge to the same motion") {
    const Vector<double> third = nodes_after<ThirdOrder>(0.1, 64);
    CHECK((nodes_after<SecondOrder>(0.1, 128) - third).cwiseAbs().maxCoeff() < 1e-5);
    const Vector<double> first =
        2 * nodes_after<SemiImplicitEuler>(0.1, 512) - nodes_after<SemiImplicitEuler>(0.1, 256);
    CHECK((first - third).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("The automatic step keeps the estimated error below the tolerance and retries what misses it") {
    SimulationParams<double> params;
    params.first_time_step = 0.5;
    params.largest_time_step = 100;
    params.step_tolerance = 1e-4;
    params.tolerance = 1e-6;
    auto simulator = settling<ThirdOrder>(params);
    REQUIRE(simulator.run());
    CHECK(simulator.history().front().rejected > 0);
    double largest = 0;
    for (const auto& record : simulator.history()) {
        CHECK(record.step_error <= params.step_tolerance);
        largest = std::max(largest, record.dt);
    }
    // Explicit steps must stay below 1e-3 here.
    CHECK(largest > 0.1);
    CHECK(simulator.history().size() < 100);
}

TEST_CASE("The estimate follows the error of the order below") {
    const auto first_error = [](double dt) {
        SimulationParams<double> params;
        params.time_step = dt;
        auto simulator = settling<SecondOrder>(params);
        return simulator.step().step_error;
    };
    CHECK(std::log2(first_error(1e-4) / first_error(5e-5)) == Approx(2).margin(0.2));
}

TEST_CASE("A tolerance that is not positive is refused") {
    SimulationParams<double> params;
    params.step_tolerance = 0;
    CHECK_THROWS_AS(settling<SecondOrder>(params), InvalidArgument);
}

}  // namespace
