// SPDX-License-Identifier: MIT
// Drivers: what they report as an error is one, and the stationary state is the one that marching leads to.
#include "catch.hpp"
#include "stationary_support.hpp"
#include <axistokes/accuracy/driver.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

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

template <class Discretization>
std::vector<Meridian<double>> spheres(const Discretization& discretization, Index elements,
                                      const std::vector<double>& places) {
    const auto ball = nodes_of(
        discretization, [](Index n) { return sphere<double>(n); }, elements);
    std::vector<Meridian<double>> shapes;
    for (const double place : places) {
        shapes.push_back(detail::shifted(ball, place));
    }
    return shapes;
}

/// Rigid spheres that settle.
template <class Discretization>
using Settlers = Settling<Discretization, RigidBody<double>>;

template <class Discretization>
auto settlers(double bond, const std::vector<double>& places, double accuracy, double longest_time = 0) {
    return [=](Index elements) {
        SimulationParams<double> params;
        params.step_tolerance = accuracy / 4;
        if (longest_time > 0) {
            params.longest_time = longest_time;
        }
        const Discretization discretization;
        return Settlers<Discretization>(Scene(FreeSpaceKernel<double>(), discretization, RigidBody<double>(),
                                              Gravity<double>(bond), DenseLU<double>()),
                                        ExtrapolatedEulerOfOrder::for_tolerance(params.step_tolerance),
                                        spheres(discretization, elements, places), params);
    };
}

DriverParams<double> accuracy(double eps, bool transient) {
    DriverParams<double> params;
    params.eps = eps;
    params.unresolved = 2 * eps;
    params.transient = transient;
    return params;
}

/// Two spheres that approach each other at the speeds 1: error of the force, and what the driver says of it.
template <class Discretization>
void check_approach(double gap, double exact, std::optional<Index> elements, double eps) {
    using Approaching = Simulator<FreeSpaceKernel<double>, Discretization, RigidBody<double>, Quiescent<double>,
                                  ExtrapolatedEulerOfOrder, DenseLU<double>>;
    DriverParams<double> params = accuracy(eps, false);
    params.elements = elements;
    Driver<Approaching> driver(
        [&](Index n) {
            const Discretization discretization;
            const std::vector<RigidBody<double>> laws{{1.0}, {-1.0}};
            return Approaching(
                Scene(FreeSpaceKernel<double>(), discretization, laws, Quiescent<double>(), DenseLU<double>()),
                ExtrapolatedEulerOfOrder(), spheres(discretization, n, {0, 2 + gap}));
        },
        params);
    const auto& result = driver.run();
    const auto& instant = *result.instant();
    const double force =
        instant.surface.weight.dot(instant.solution.force.tail(instant.surface.size())) / (6 * std::acos(-1.0));
    const double error = std::abs(force / exact - 1);
    INFO("gap " << gap << ", elements " << result.configuration().shape.elements() << ", force " << force << ", error "
                << error << ", estimate " << result.error_estimate);
    CHECK(error <= result.error_estimate);
    if (!elements) {
        CHECK(result.error_met());
    }
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
    CHECK(stationary::distance(result.configuration().shape, driver.simulator().configuration().shape) < 0.05);
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
    CHECK(result.configuration().shape.elements() > 16);
}

TEST_CASE("Spheres that nearly touch: the error is within its estimate, whatever the number of elements") {
    // By 256 to 400 modes; H. Brenner, Chem. Engng Sci. 16, 1961, has 40.05 for 0.0136 and 504.45 for 0.001.
    using Spectral = SpectralMeridian<double>;
    // 32 modes have a pole near 0.0135.
    for (const Index n : {16, 24, 32, 40, 48, 64, 96}) {
        check_approach<Spectral>(0.0136, 40.0499868, n, 1e-4);
    }
    check_approach<Spectral>(0.1, 7.41329761, 16, 1e-4);
    check_approach<Spectral>(0.03, 19.6015945, 32, 1e-4);
    check_approach<Spectral>(0.003, 170.627561, 128, 1e-4);
    check_approach<Spectral>(0.001, 504.524955, 48, 1e-4);
    check_approach<Spectral>(0.001, 504.524955, 128, 1e-4);
    using Linear = LinearElements<double>;
    check_approach<Linear>(0.03, 19.6015945, 64, 1e-4);
    check_approach<Linear>(0.01, 53.4222937, 64, 1e-4);
    check_approach<Linear>(0.001, 504.524955, 256, 1e-4);
    // As many as it takes.
    check_approach<Spectral>(0.0136, 40.0499868, std::nullopt, 1e-4);
}

TEST_CASE("Spheres followed in time: more modes as they approach, and an error within its estimate") {
    for (const double eps : {1e-3, 1e-6}) {
        Driver<Settlers<SpectralMeridian<double>>> driver(settlers<SpectralMeridian<double>>(10, {-3, 0, 3}, eps, 20.0),
                                                          accuracy(eps, true));
        const auto& result = driver.run();
        CHECK(driver.simulator().time() == 20);
        const double velocities[] = {-3.6010151, -3.6019364};
        for (std::size_t b = 0; b < 2; ++b) {
            const double error = std::abs(driver.simulator().instant(b).velocity / velocities[b] - 1);
            INFO("accuracy " << eps << ", body " << b << ", velocity " << driver.simulator().instant(b).velocity
                             << ", error " << error << ", estimate " << result.error_estimate << ", modes "
                             << driver.simulator().configuration(b).shape.elements());
            CHECK(error <= result.error_estimate + 2e-8);
            CHECK(error < eps);
        }
        INFO("estimate " << result.error_estimate);
        CHECK(result.error_met());
    }
}

TEST_CASE("A given time is reached by bodies at rest relative to each other, and an instant takes no step") {
    Driver<Settlers<SpectralMeridian<double>>> driver(settlers<SpectralMeridian<double>>(10, {0, 2.0001}, 1e-4, 10.0),
                                                      accuracy(1e-4, true));
    const auto& result = driver.run();
    CHECK(result.stationary);
    CHECK(result.error_met());
    CHECK(driver.simulator().time() == 10);
    CHECK(driver.simulator().configuration().position == Approx(10 * *result.velocity).epsilon(1e-6));
    for (const auto& places : {std::vector<double>{0}, std::vector<double>{0, 3}}) {
        Driver<Settlers<SpectralMeridian<double>>> instant(settlers<SpectralMeridian<double>>(10, places, 1e-4),
                                                           accuracy(1e-4, false));
        CHECK(instant.run().stationary);
        CHECK(instant.simulator().history().empty());
    }
}

TEST_CASE("A sphere followed through a tube has the modes that its film takes") {
    using InTube = Simulator<TubeKernel<double>, SpectralMeridian<double>, RigidBody<double>, Gravity<double>,
                             ExtrapolatedEulerOfOrder, DenseLU<double>>;
    const double eps = 1e-6;
    Driver<InTube> driver(
        [&](Index n) {
            TubeKernel<double>::Params tube;
            tube.tolerance = 1e-9;
            SimulationParams<double> params;
            params.longest_time = 1;
            params.step_tolerance = eps / 4;
            const SpectralMeridian<double> discretization;
            return InTube(Scene(TubeKernel<double>(1.03, tube), discretization, RigidBody<double>(),
                                Gravity<double>(4.5), DenseLU<double>()),
                          ExtrapolatedEulerOfOrder(3), spheres(discretization, n, {0}), params);
        },
        accuracy(eps, true));
    const auto& result = driver.run();
    CHECK(driver.simulator().time() == 1);
    const double error = std::abs(*result.velocity / -8.99841764e-05 - 1);
    INFO("error " << error << ", estimate " << result.error_estimate);
    CHECK(error < result.error_estimate + 2e-9);
    CHECK(result.error_met());
    CHECK(driver.simulator().configuration().shape.elements() > 32);
}

TEST_CASE("A gap that the most modes do not resolve ends the run, with that as the cause") {
    using Vesicles = Settling<SpectralMeridian<double>, Vesicle<double>>;
    Driver<Vesicles> driver(
        [](Index n) {
            SimulationParams<double> params;
            params.longest_time = 0.1;
            const SpectralMeridian<double> discretization;
            const auto shape = [](Index k) { return spheroid_of_excess_area(0.6, SpheroidKind::prolate, k); };
            const auto nodes = nodes_of(discretization, shape, n);
            return Vesicles(Scene(FreeSpaceKernel<double>(), discretization, Vesicle<double>(), Gravity<double>(47),
                                  DenseLU<double>()),
                            ExtrapolatedEulerOfOrder(3), {nodes, detail::shifted(nodes, 2.87)}, params);
        },
        accuracy(1e-4, true));
    std::string cause;
    try {
        driver.run();
    } catch (const SimulationFailure& failure) {
        cause = failure.what();
    }
    CHECK(cause.find("the distance to the next body, 0.0022") == 0);
    CHECK(cause.find("is less than 160 elements can resolve") != std::string::npos);
    CHECK_FALSE(driver.result().error_met());
}

TEST_CASE("drivers: what the residual leaves of the slowest disturbance is part of the estimate") {
    // Close to a sphere in a strong flow a residual of 1e-5 of the flow is a large one of the shape's.
    using Flow = UnboundedPoiseuille<double>;
    using Driven = Simulator<FreeSpaceKernel<double>, SpectralMeridian<double>, Vesicle<double>, Flow,
                             ExtrapolatedEulerOfOrder, DenseLU<double>>;
    const auto length = [](double eps, double tolerance, double* estimate) {
        DriverParams<double> params = accuracy(eps, false);
        params.elements = 24;
        params.newton_tolerance = tolerance;
        Driver<Driven> driver(
            [&](Index elements) {
                SimulationParams<double> simulation;
                simulation.tolerance = tolerance;
                const SpectralMeridian<double> series;
                const auto shape = [](Index n) { return spheroid_of_excess_area(0.002, SpheroidKind::oblate, n); };
                return Driven(Scene(FreeSpaceKernel<double>(), series, Vesicle<double>(), Flow(150), DenseLU<double>()),
                              ExtrapolatedEulerOfOrder(), nodes_of(series, shape, elements), simulation);
            },
            params);
        const auto& result = driver.run();
        const auto& shape = result.configuration().shape;
        *estimate = result.error_estimate;
        return shape.z[shape.elements()] - shape.z[0];
    };
    double estimate = 0;
    const double exact = length(1e-9, 1e-13, &estimate);
    CHECK(estimate < 1e-5);
    for (const double eps : {1e-2, 1e-3, 1e-4}) {
        const double error = std::abs(length(eps, 1e-4, &estimate) / exact - 1);
        INFO("accuracy " << eps << ", error " << error << ", estimate " << estimate);
        CHECK(error < 5 * estimate);
        CHECK(error < 3 * eps);
    }
}

TEST_CASE("drivers: Newton's method stops when the observer says so") {
    DriverParams<double> params = accuracy(1e-6, false);
    params.way = WayToStationary::newton;
    using Simulation = Settling<SpectralMeridian<double>, Vesicle<double>>;
    std::size_t last = 0;
    int again = 0;
    Driver<Simulation> driver(settling<SpectralMeridian<double>>(0.6, 47), params, [&](const Simulation& s) {
        again = s.history().size() == last ? again + 1 : 0;
        last = s.history().size();
        return again < 2;
    });
    const auto& result = driver.run();
    CHECK(result.interrupted);
    CHECK(!result.stationary);
    CHECK(result.newton_failure.empty());
    CHECK(result.instant() != nullptr);
}

TEST_CASE("drivers: the estimate of a nearly spherical vesicle counts the area that its elements measure") {
    const auto length_of = [](auto& driver) {
        const auto& shape = driver.run().configuration().shape;
        return shape.z[shape.elements()] - shape.z[0];
    };
    DriverParams<double> params = accuracy(1e-8, false);
    for (const double excess_area : {1e-3, 1e-2}) {
        Driver<Settling<SpectralMeridian<double>, Vesicle<double>>> series(
            settling<SpectralMeridian<double>>(excess_area, 47.0), params);
        const double exact = length_of(series);
        params.elements = 24;
        Driver<Settling<LinearElements<double>, Vesicle<double>>> linear(
            settling<LinearElements<double>>(excess_area, 47.0), params);
        const double error = std::abs(length_of(linear) / exact - 1);
        const double estimate = linear.result().error_estimate;
        INFO("excess area " << excess_area << ", error " << error << ", estimate " << estimate);
        CHECK(error > 1e-5);
        CHECK(estimate > error / 2);
        CHECK(estimate < 50 * error);
        params.elements.reset();
    }
}

TEST_CASE("drivers: a vesicle that fills its tube is solved for after one step, and is what marching ends with") {
    using Tight = Simulator<TubeKernel<double>, SpectralMeridian<double>, Vesicle<double>, Poiseuille<double>,
                            ExtrapolatedEulerOfOrder, DenseLU<double>>;
    const double volume = 4 * detail::pi_value<double>() / 3;
    const double excess_area = 0.437145309298765;  // a reduced volume of 0.95
    const double radius = critical_tube_radius(3 * volume + excess_area, volume) / 0.95;
    const auto found = [&](WayToStationary way, std::size_t* steps) {
        DriverParams<double> params = accuracy(1e-4, false);
        params.way = way;
        Driver<Tight> driver(
            [&](Index elements) {
                SimulationParams<double> simulation;
                simulation.tolerance = 1e-5;
                const SpectralMeridian<double> series;
                const auto shape = [&](Index n) {
                    return shape_in_tube<double>(excess_area, radius, SpheroidKind::prolate, n);
                };
                return Tight(Scene(TubeKernel<double>(radius), series, Vesicle<double>(),
                                   Poiseuille<double>(100.0, radius), DenseLU<double>()),
                             ExtrapolatedEulerOfOrder(), nodes_of(series, shape, elements), simulation);
            },
            params);
        const auto& result = driver.run();
        CHECK(result.stationary);
        CHECK(result.error_met());
        *steps = driver.simulator().history().size();
        return *result.velocity;
    };
    std::size_t solved = 0;
    std::size_t marched = 0;
    const double velocity = found(WayToStationary::automatic, &solved);
    CHECK(solved == 1);
    CHECK(velocity == Approx(found(WayToStationary::march, &marched)).epsilon(1e-4));
    CHECK(marched > 20);
}
