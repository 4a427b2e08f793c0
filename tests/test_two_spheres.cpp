// SPDX-License-Identifier: MIT
// Several bodies in one scene: two spheres in line against the exact series, bodies of different kinds, a chain that
// settles.
#include "catch.hpp"
#include "support.hpp"
#include "two_spheres_reference.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/explicit_euler.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace axistokes;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::refusal;
using axistokes::test::Spheroid;
using axistokes::test::two_spheres_drag_factor;

using Precise = boost::multiprecision::cpp_bin_float_50;
using State = std::vector<Configuration<double>>;

Meridian<double> spectral_sphere(Index degree) {
    return SpectralMeridian<double>{}.redistributed(sphere<double>(2 * degree), degree);
}

/// Drag factors of both spheres at the distance d of their centres.
template <class Discretization>
std::vector<double> drag_factors(Discretization discretization, const Meridian<double>& shape, double d) {
    Scene scene(FreeSpaceKernel<double>{}, discretization, RigidBody<double>{1.0}, Quiescent<double>{},
                DenseLU<double>{});
    std::vector<double> factors;
    for (const auto& instant : scene.evaluate(State{{shape, 0, {}}, {shape, d, {}}}, 0.0)) {
        const Index n = instant.surface.size();
        factors.push_back(instant.surface.weight.dot(instant.solution.force.tail(n)) / (6 * pi));
    }
    return factors;
}

double spectral_error(Index degree, double d) {
    const auto factors = drag_factors(SpectralMeridian<double>{}, spectral_sphere(degree), d);
    const double exact = two_spheres_drag_factor(d);
    return std::max(std::abs(factors[0] / exact - 1), std::abs(factors[1] / exact - 1));
}

double linear_error(Index elements, double d) {
    const auto factors = drag_factors(LinearElements<double>{}, Spheroid{1, 1}.meridian(elements), d);
    return std::abs(factors[0] / two_spheres_drag_factor(d) - 1);
}

Meridian<double> lifted(Meridian<double> shape, double by) {
    shape.z.array() += by;
    return shape;
}

}  // namespace

TEST_CASE("the series of Stimson and Jeffery, close to contact too", "[two spheres]") {
    for (const double d : {2.001, 2.01, 2.1, 2.5, 3.0, 5.0, 10.0, 100.0}) {
        const Precise precise = two_spheres_drag_factor(Precise(d));
        INFO("distance " << d);
        CHECK(static_cast<double>(abs(two_spheres_drag_factor(d) / precise - 1)) < 1e-14);
    }
    // Their own table, whose entries are cosh(alpha) = d/2 and the factor.
    CHECK(two_spheres_drag_factor(2 * 1.5431) == Approx(0.702).margin(5e-4));
    CHECK(two_spheres_drag_factor(2 * 10.068) == Approx(0.931).margin(5e-4));
}

TEST_CASE("far apart the series is that of reflections", "[two spheres]") {
    // Mobilities along the line of centres (G. K. Batchelor, J. Fluid Mech. 74, 1976; D. J. Jeffrey, Y. Onishi, J.
    // Fluid Mech. 139, 1984): 1 - 15/4 d^-4 + 11/2 d^-6 of the sphere itself, 3/2 d^-1 - d^-3 + 75/4 d^-7 of the other
    // one.
    const auto rest = [](int d) {
        const Precise x = Precise(1) / d;
        const Precise reflections =
            1 - 15 * pow(x, 4) / 4 + 11 * pow(x, 6) / 2 + 3 * x / 2 - pow(x, 3) + 75 * pow(x, 7) / 4;
        return static_cast<double>(1 / two_spheres_drag_factor(Precise(d)) - reflections);
    };
    CHECK(std::abs(rest(100)) < 1e-13);
    CHECK(observed_order(rest(100), rest(200)) == Approx(8).margin(0.1));
}

TEST_CASE("two spheres in line: the spectral discretisation has the exact drag", "[two spheres]") {
    for (const double d : {2.1, 2.5, 3.0, 5.0, 10.0}) {
        const double error = spectral_error(48, d);
        INFO("distance " << d << ", error " << error);
        CHECK(error < 1e-12);
    }
    const double coarse = spectral_error(32, 2.01);
    const double fine = spectral_error(64, 2.01);
    INFO("distance 2.01, errors " << coarse << ' ' << fine);
    CHECK(fine < 1e-12);
}

TEST_CASE("two spheres in line: P1 elements are of second order", "[two spheres]") {
    for (const double d : {2.1, 3.0}) {
        const double coarse = linear_error(40, d);
        const double fine = linear_error(80, d);
        INFO("distance " << d << ", errors " << coarse << ' ' << fine);
        CHECK(observed_order(coarse, fine) > 1.9);
        CHECK(fine < 5e-5);
    }
}

TEST_CASE("two equal spheres settle together, as mirror images", "[two spheres]") {
    const double bond = 5;
    const double d = 2.5;
    const auto shape = spectral_sphere(32);
    Scene scene(FreeSpaceKernel<double>{}, SpectralMeridian<double>{}, RigidBody<double>{}, Gravity<double>(bond),
                DenseLU<double>{});
    const auto instants = scene.evaluate(State{{shape, 0, {}}, {shape, d, {}}}, 0.0);
    for (const auto& instant : instants) {
        CHECK(std::abs(instant.velocity * two_spheres_drag_factor(d) / (-2.0 / 9 * bond) - 1) < 1e-10);
    }
    const Index n = shape.nodes();
    const Vector<double>& below = instants[0].solution.force;
    const Vector<double>& above = instants[1].solution.force;
    CHECK((below.tail(n) - above.tail(n).reverse()).cwiseAbs().maxCoeff() < 1e-8);
    CHECK((below.head(n) + above.head(n).reverse()).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("a sphere and a vesicle: far apart each moves as if alone", "[two spheres]") {
    using Body = OneOf<Vesicle<double>, RigidBody<double>>;
    const SpectralMeridian<double> discretization;
    const auto vesicle =
        discretization.redistributed(spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 48), 24);
    const auto ball = spectral_sphere(20);
    const Gravity<double> gravity(5);
    const auto alone = [&](auto law, const Meridian<double>& shape) {
        Scene scene(FreeSpaceKernel<double>{}, discretization, law, gravity, DenseLU<double>{});
        return scene.evaluate(Configuration<double>{shape, 0, {}}, 0.0);
    };
    const auto lone_vesicle = alone(Vesicle<double>{}, vesicle);
    const auto lone_ball = alone(RigidBody<double>{}, ball);
    Scene scene(FreeSpaceKernel<double>{}, discretization, std::vector<Body>{Vesicle<double>{}, RigidBody<double>{}},
                gravity, DenseLU<double>{});
    // Either carries the other one along by the Stokeslet of its weight, (4 pi/3) B0/(4 pi d), and strains it by that
    // of its derivative.
    const Index n = vesicle.nodes();
    std::vector<double> strained;
    for (const double d : {1e2, 1e3}) {
        const auto both = scene.evaluate(State{{vesicle, 0, {}}, {ball, d, {}}}, 0.0);
        const double carried = -5 / (3 * d);
        CHECK(both[0].velocity - lone_vesicle.velocity == Approx(carried).epsilon(2 / (d * d)));
        CHECK(both[1].velocity - lone_ball.velocity == Approx(carried).epsilon(2 / (d * d)));
        Vector<double> change = both[0].solution.velocity - lone_vesicle.solution.velocity;
        change.tail(n).array() -= carried;
        CHECK(change.cwiseAbs().maxCoeff() < 2 * std::abs(carried) / d);
        strained.push_back((both[0].solution.tension - lone_vesicle.solution.tension).cwiseAbs().maxCoeff());
    }
    CHECK(std::log10(strained[0] / strained[1]) == Approx(2).margin(0.02));
}

TEST_CASE("a gap has one width, that of the curves, and nodes enough or not", "[two spheres]") {
    const auto check = [](const auto& discretization, const Meridian<double>& lower, const Meridian<double>& upper) {
        Scene scene(FreeSpaceKernel<double>{}, discretization, RigidBody<double>{}, Gravity<double>(1),
                    DenseLU<double>{});
        for (const double gap : {1e-4, 0.01, 0.3}) {
            const State state{{lower, 0, {}}, {upper, 2 + gap, {}}};
            const auto here = scene.gap_above(state, 0);
            CHECK(here.width == Approx(gap).epsilon(1e-9));
            CHECK(scene.films(state).bodies[0].to_neighbour == here.width);
            CHECK(scene.films(state).bodies[1].to_neighbour == here.width);
            // h'' = 2, and N elements along the length pi.
            CHECK(here.slenderness == Approx(std::sqrt(gap)).epsilon(0.01));
            const double nodes = std::sqrt(gap) * static_cast<double>(lower.elements());
            CHECK(here.lower_nodes == Approx(nodes).epsilon(0.01));
            CHECK(here.upper_nodes ==
                  Approx(nodes * static_cast<double>(upper.elements()) / static_cast<double>(lower.elements()))
                      .epsilon(0.01));
        }
    };
    check(SpectralMeridian<double>{}, spectral_sphere(32), spectral_sphere(20));
    check(LinearElements<double>{}, Spheroid{1, 1}.meridian(64), Spheroid{1, 1}.meridian(40));
    // Off the axis, between nodes.
    const auto circle = [](double z, double turned) {
        Meridian<double> m{Vector<double>(41), Vector<double>(41)};
        for (Index i = 0; i <= 40; ++i) {
            const double t = turned + 2 * pi * static_cast<double>(i) / 40;
            m.r[i] = 2 + std::cos(t);
            m.z[i] = z + std::sin(t);
        }
        return m;
    };
    const auto closest = closest_approach(circle(0, 0.3), circle(2.05, 0.37));
    CHECK(closest.distance == Approx(0.05).epsilon(1e-3));
    CHECK(closest.length == Approx(std::sqrt(0.05)).epsilon(0.01));
    const auto other = closest_approach(circle(2.05, 0.37), circle(0, 0.3));
    CHECK(other.distance == Approx(closest.distance).epsilon(1e-12));
}

TEST_CASE("bodies that meet or lie in the wrong order are refused", "[two spheres]") {
    const auto ball = spectral_sphere(16);
    const auto simulate = [](const std::vector<Meridian<double>>& shapes) {
        Simulator(Scene(FreeSpaceKernel<double>{}, SpectralMeridian<double>{}, RigidBody<double>{}, Gravity<double>(1),
                        DenseLU<double>{}),
                  ExplicitEuler{}, shapes);
    };
    CHECK_NOTHROW(simulate({ball, lifted(ball, 2.01)}));
    for (const double d : {1.5, 2.0, 0.0}) {
        INFO("distance " << d);
        CHECK(mentions(refusal([&] { simulate({ball, lifted(ball, d)}); }), "body", "=", "do not meet"));
    }
    CHECK(mentions(refusal([&] { simulate({lifted(ball, 3), ball}); }), "body", "-5", "in the order"));
    CHECK(mentions(refusal([&] { simulate({ball, lifted(ball, 6), lifted(ball, 3)}); }), "body", "-5", "in the order"));
    CHECK(mentions(refusal([&] { simulate({}); }), "number of bodies", "0", "at least 1"));
}

TEST_CASE("a chain of heavy spheres with unequal gaps settles without contact", "[two spheres]") {
    const auto ball = spectral_sphere(24);
    const double bond = 5;
    SimulationParams<double> params;
    params.time_step = 0.05;
    params.longest_time = 3;
    Simulator simulator(Scene(FreeSpaceKernel<double>{}, SpectralMeridian<double>{}, RigidBody<double>{},
                              Gravity<double>(bond), DenseLU<double>{}),
                        ExplicitEuler{}, {ball, lifted(ball, 2.2), lifted(ball, 5)}, params);
    double between = 0.2;
    while (!simulator.finished()) {
        simulator.step();
        const auto& lowest = simulator.history(0).back();
        const auto& middle = simulator.history(1).back();
        const auto& highest = simulator.history(2).back();
        // Neighbours make it fall faster: the lower two, closer to each other, leave the third behind, and the middle
        // one, which has two, approaches the lowest, ever more slowly.
        REQUIRE(highest.velocity > lowest.velocity);
        REQUIRE(lowest.velocity > middle.velocity);
        REQUIRE(middle.neighbour_distance == Approx(middle.position - lowest.position - 2).epsilon(1e-3));
        REQUIRE(middle.neighbour_distance > between * (1 - 0.05 * 0.6));
        REQUIRE(middle.neighbour_distance < between);
        REQUIRE(highest.neighbour_distance > 0.8);
        between = middle.neighbour_distance;
    }
    CHECK(between > 0.05);
}
