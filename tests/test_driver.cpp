// SPDX-License-Identifier: MIT
// Drivers: what they report as an error is one, and the stationary state is the one that marching leads to.
#include "catch.hpp"
#include "stationary_support.hpp"
#include <axistokes/accuracy/driver.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <cmath>

namespace {

using namespace axistokes;

template <class Discretization, class Law>
using Settling =
    Simulator<FreeSpaceKernel<double>, Discretization, Law, Gravity<double>, ExtrapolatedEulerOfOrder, DenseLU<double>>;

template <class Discretization, class Law = Vesicle<double>>
auto settling(double excess_area, double bond, double longest_time = 0) {
    return [=](Index elements) {
        SimulationParams<double> params;
        if (longest_time > 0) {
            params.longest_time = longest_time;
        }
        const Discretization discretization;
        const auto shape = [&](Index n) { return spheroid_of_excess_area(excess_area, SpheroidKind::prolate, n); };
        return Settling<Discretization, Law>(
            Scene(FreeSpaceKernel<double>(), discretization, Law(), Gravity<double>(bond), DenseLU<double>()),
            ExtrapolatedEulerOfOrder(), nodes_of(discretization, shape, elements), params);
    };
}

/// Of Fig. 5 of the paper, D = 0.6 and B0 = 47, by 96 modes and Newton's method.
constexpr double kVelocity = -10.5360600306;

}  // namespace

TEST_CASE("A stationary state by itself: as many modes as the accuracy takes, and an error within its estimate") {
    DriverParams<double> params;
    params.eps = 1e-6;
    params.unresolved = 2e-6;
    Driver<Settling<SpectralMeridian<double>, Vesicle<double>>> driver(settling<SpectralMeridian<double>>(0.6, 47.0),
                                                                       params);
    const auto& result = driver.run();
    CHECK(result.stationary);
    CHECK(result.error_met());
    CHECK(result.newton_iterations > 0);
    CHECK(result.growth_rate.value() < 0);
    CHECK(result.residual.value() < 1e-9);
    CHECK(std::abs(*result.velocity / kVelocity - 1) < result.error_estimate);
    // Near the shape that was marched to.
    CHECK(stationary::distance(result.configuration.shape, driver.simulator().configuration().shape) < 0.05);
}

TEST_CASE("P1 elements are held against half of them") {
    for (const WayToStationary way : {WayToStationary::automatic, WayToStationary::march}) {
        DriverParams<double> params;
        params.elements = 48;
        params.way = way;
        Driver<Settling<LinearElements<double>, Vesicle<double>>> driver(settling<LinearElements<double>>(0.6, 47.0),
                                                                         params);
        const auto& result = driver.run();
        const double error = std::abs(*result.velocity / kVelocity - 1);
        CHECK(result.stationary);
        CHECK(result.error_estimate > error / 2);
        CHECK(result.error_estimate < 20 * error);
        CHECK_FALSE(result.error_met());
    }
}

TEST_CASE("To a given time the first-order steps' error is part of the estimate") {
    DriverParams<double> params;
    params.transient = true;
    params.elements = 32;
    Driver<Settling<SpectralMeridian<double>, Vesicle<double>>> driver(
        settling<SpectralMeridian<double>>(0.6, 47.0, 0.05), params);
    const auto& result = driver.run();
    CHECK(driver.simulator().time() == 0.05);
    // The same with steps of fifth order.
    SimulationParams<double> exact;
    exact.longest_time = 0.05;
    exact.step_tolerance = 1e-8;
    Settling<SpectralMeridian<double>, Vesicle<double>> reference(
        driver.simulator().scene(), ExtrapolatedEulerOfOrder(5),
        settling<SpectralMeridian<double>>(0.6, 47.0)(32).shape(), exact);
    reference.run();
    const double error = std::abs(*result.velocity / reference.history().back().velocity - 1);
    CHECK(error > 1e-5);
    CHECK(result.error_estimate > error / 2);
}

TEST_CASE("A rigid body's error is that of fewer elements") {
    DriverParams<double> params;
    params.elements = 24;
    Driver<Settling<LinearElements<double>, RigidBody<double>>> driver(
        settling<LinearElements<double>, RigidBody<double>>(0.0, 4.5), params);
    const auto& result = driver.run();
    const double error = std::abs(*result.velocity + 1);
    CHECK(result.error_estimate > error / 3);
    CHECK(result.error_estimate < 10 * error);
    CHECK(result.stationary);
}

TEST_CASE("A shape that its modes cannot carry gets more of them") {
    // Prolate, reduced volume 0.6: with 16 modes no step succeeds.
    DriverParams<double> params;
    params.eps = 1e-3;
    params.unresolved = 2e-3;
    Driver<Settling<SpectralMeridian<double>, Vesicle<double>>> driver(settling<SpectralMeridian<double>>(5.1, 1.0),
                                                                       params);
    const auto& result = driver.run();
    CHECK(result.stationary);
    CHECK(result.error_met());
    CHECK(result.configuration.shape.elements() > 16);
}
