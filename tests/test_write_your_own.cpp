// SPDX-License-Identifier: MIT
// The policies of docs/write_your_own.md, each against an exact result; the plane wall has test_plane_wall.cpp.
#include "../examples/write_your_own/capsule.hpp"
#include "../examples/write_your_own/drop.hpp"
#include "../examples/write_your_own/explicit_midpoint.hpp"
#include "../examples/write_your_own/full_pivot_lu.hpp"
#include "../examples/write_your_own/sphere_above_vesicle.hpp"
#include "../examples/write_your_own/uniaxial_extension.hpp"
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/accuracy/resolution.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/flow/sum.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/extrapolated_euler.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace axistokes;
using axistokes::test::pi;
using axistokes::test::Spheroid;
using write_your_own::Capsule;
using write_your_own::Drop;
using write_your_own::ExplicitMidpoint;
using write_your_own::FullPivotLU;
using write_your_own::UniaxialExtension;

template <class Membrane, class Flow>
auto scene(Flow flow) {
    return Scene(FreeSpaceKernel<double>{}, SpectralMeridian<double>{}, Membrane{}, flow, FullPivotLU<double>{});
}

/// A vesicle, after `steps` midpoint steps to a fixed time in an extension that moves it too.
Configuration<double> after(Index steps) {
    auto stretched = scene<Vesicle<double>>(UniaxialExtension<double>(2.0));
    const double dt = 0.02 / static_cast<double>(steps);
    Configuration<double> now{Spheroid{0.9, 1 / (0.9 * 0.9)}.meridian(8), 0.5, {}};
    for (Index i = 0; i < steps; ++i) {
        now = ExplicitMidpoint{}.step(stretched, stretched.moment({now}), dt).bodies.front();
    }
    return now;
}

}  // namespace

TEST_CASE("your linear solver solves, and refuses a singular matrix", "[write_your_own]") {
    static_assert(LinearSolver<FullPivotLU<double>>);
    // Hilbert's matrix: the inverse is known, and a row of it has entries up to 1e5.
    Matrix<double> hilbert(5, 5);
    for (Index i = 0; i < 5; ++i) {
        for (Index j = 0; j < 5; ++j) {
            hilbert(i, j) = 1.0 / static_cast<double>(i + j + 1);
        }
    }
    FullPivotLU<double> solver;
    solver.factorize(hilbert);
    const Vector<double> x = solver.solve(Vector<double>::Unit(5, 0));
    const double exact[] = {25, -300, 1050, -1400, 630};
    for (Index i = 0; i < 5; ++i) {
        CHECK(x[i] == Approx(exact[i]).epsilon(1e-10));
    }
    CHECK(axistokes::test::failure([&] { solver.factorize(Matrix<double>::Ones(3, 3)); }).find("singular") !=
          std::string::npos);
    CHECK_THROWS_AS(solver.factorize(Matrix<double>::Constant(2, 2, std::nan(""))), SimulationFailure);
}

TEST_CASE("your linear solver gives a prolate spheroid Oberbeck's drag", "[write_your_own]") {
    // F = 16 pi eta c e^3 U/[(1 + e^2) log((1 + e)/(1 - e)) - 2 e], eccentricity e (Happel & Brenner, 5-11).
    const Spheroid s{std::cbrt(0.5), 2 * std::cbrt(0.5)};
    const double e = std::sqrt(0.75);
    const double drag = 16 * pi * s.c * e * e * e / ((1 + e * e) * std::log((1 + e) / (1 - e)) - 2 * e);
    const double bond = 3;
    const auto instant = scene<RigidBody<double>>(Gravity<double>(bond)).evaluate({s.meridian(32), 0.0, {}}, 0.0);
    CHECK(instant.velocity == Approx(-bond * s.volume() / drag).epsilon(1e-9));
}

TEST_CASE("your background: a sphere in extension has its stresslet", "[write_your_own]") {
    static_assert(Background<UniaxialExtension<double>>);
    const double rate = 1.7;
    const auto m = Spheroid{1, 1}.meridian(24);
    const auto instant = scene<RigidBody<double>>(UniaxialExtension<double>(rate)).evaluate({m, 0.0, {}}, 0.0);
    CHECK(std::abs(instant.velocity) < 1e-12);
    // The traction on a sphere held in a strain E is 5 eta E.n (Einstein 1906; Batchelor 1970): the moment is
    // (20/3) pi eta R^3 E. What the sphere does to the fluid is the opposite.
    const Index n = m.nodes();
    const Vector<double>& f = instant.solution.force;
    CHECK(instant.surface.weight.dot(f.tail(n).cwiseProduct(m.z)) == Approx(-20.0 / 3 * pi * rate).epsilon(1e-9));
    for (Index i = 0; i < n; ++i) {
        CHECK(f[n + i] == Approx(-5 * rate * m.z[i]).margin(1e-8));
        CHECK(f[i] == Approx(5 * rate / 2 * m.r[i]).margin(1e-8));
    }
}

TEST_CASE("your background: a sphere off the stagnation point moves with the flow there", "[write_your_own]") {
    // Faxen: the flow is linear.
    const auto m = Spheroid{1, 1}.meridian(24);
    const auto instant = scene<RigidBody<double>>(UniaxialExtension<double>(1.7)).evaluate({m, -3.0, {}}, 0.0);
    CHECK(instant.velocity == Approx(-5.1).epsilon(1e-10));
    auto settling = scene<RigidBody<double>>(Sum(UniaxialExtension<double>(1.7), Gravity<double>(9.0)));
    CHECK(settling.evaluate({m, -3.0, {}}, 0.0).velocity == Approx(-7.1).epsilon(1e-10));
}

TEST_CASE("your time integrator has its order", "[write_your_own]") {
    const Configuration<double> fine = after(256);
    const auto error = [&fine](Index steps) {
        const Configuration<double> now = after(steps);
        return std::hypot((now.shape.r - fine.shape.r).norm(), (now.shape.z - fine.shape.z).norm(),
                          now.position - fine.position);
    };
    const double coarse = error(16);
    const double half = error(32);
    INFO("errors " << coarse << ' ' << half);
    // Against a solution of finite step: (1 - 1/256)/(1/4 - 1/256) = 4.05 instead of 4.
    CHECK(axistokes::test::observed_order(coarse, half) == Approx(2.0).margin(0.1));
    CHECK(half < 1e-5);
}

TEST_CASE("your policies together make a simulator", "[write_your_own]") {
    using Stretched = Simulator<FreeSpaceKernel<double>, SpectralMeridian<double>, Vesicle<double>,
                                UniaxialExtension<double>, ExplicitMidpoint, FullPivotLU<double>>;
    SimulationParams<double> params;
    params.time_step = 1e-3;
    params.longest_time = 0.02;
    Stretched simulator(Spheroid{0.9, 1 / (0.9 * 0.9)}.meridian(8), UniaxialExtension<double>(2.0), params);
    simulator.run();
    const auto& last = simulator.history().back();
    CHECK(last.time == Approx(0.02));
    CHECK(std::abs(last.volume_drift) < 1e-12);
    CHECK(std::abs(last.area_drift) < 1e-12);
}

TEST_CASE("your scene of several bodies: far apart they drag each other along", "[write_your_own]") {
    const double bond = 20;
    const double distance = 50;
    auto together = write_your_own::sphere_above_vesicle(bond, distance, 24);
    auto far = write_your_own::sphere_above_vesicle(bond, 1e7, 24);
    REQUIRE(together.bodies() == 2);
    // Of a point force, the weight of a sphere; the bodies' own sizes come in with 1/d^3.
    const double drift = -bond / (3 * distance);
    for (const std::size_t body : {0u, 1u}) {
        const double alone = far.instant(body).velocity;
        INFO(body << ": " << together.instant(body).velocity - alone - drift);
        CHECK(std::abs(together.instant(body).velocity - alone - drift) < 3e-6 * bond);
    }
    CHECK(far.instant(1).velocity == Approx(-2.0 / 9 * bond).epsilon(1e-6));
    // Prolate, the vesicle below is the faster one.
    auto near = write_your_own::sphere_above_vesicle(bond, 3, 24);
    const double before = near.configuration(1).position - near.configuration(0).position;
    near.step();
    CHECK(near.configuration(1).position - near.configuration(0).position > before);
}

TEST_CASE("your law: a drop settles at 4/15 of its Bond number", "[write_your_own]") {
    static_assert(LawFor<Drop<double>, SpectralMeridian<double>::Surface>);
    static_assert(LawFor<Drop<double>, LinearElements<double>::Surface>);
    const auto settled = [](const auto& discretization, const Meridian<double>& shape) {
        Scene drop(FreeSpaceKernel<double>(), discretization, Drop<double>(), Gravity<double>(3), DenseLU<double>());
        return drop.evaluate(Configuration<double>{shape, 0.0, {}}, 0.0).velocity;
    };
    CHECK(settled(SpectralMeridian<double>(), Spheroid{1, 1}.meridian(24)) == Approx(-0.8).epsilon(1e-12));
    const double coarse = std::abs(settled(LinearElements<double>(), Spheroid{1, 1}.meridian(32)) + 0.8);
    const double fine = std::abs(settled(LinearElements<double>(), Spheroid{1, 1}.meridian(64)) + 0.8);
    CHECK(axistokes::test::observed_order(coarse, fine) > 1.8);
}

TEST_CASE("your law: a drop in an extension, by marching and by Newton's method", "[write_your_own]") {
    const auto deformation = [](const Meridian<double>& m, const auto& discretization) {
        const double length = m.z[m.elements()] - m.z[0];
        const double width = 2 * discretization.max_radius(m);
        return (length - width) / (length + width);
    };
    const SpectralMeridian<double> spectral;
    double growth = 0;  // summed
    const auto deformed = [&](double rate) {
        SimulationParams<double> params;
        params.tolerance = 1e-9;
        Simulator march(Scene(FreeSpaceKernel<double>(), spectral, Drop<double>(1), UniaxialExtension<double>(rate),
                              DenseLU<double>()),
                        SemiImplicitEuler(), Spheroid{1, 1}.meridian(16), params);
        CHECK(march.run());
        StationarySolver newton(march.scene());
        const auto state = newton.solve(Spheroid{1, 1}.meridian(16), march.initial_area(), march.initial_volume());
        growth += newton.growth_rates(state).front().real();
        const double found = deformation(state.configuration().shape, spectral);
        CHECK(found == Approx(deformation(march.configuration().shape, spectral)).epsilon(1e-6));
        // The area has grown, the volume has not.
        CHECK(march.history().back().area_drift > 0);
        CHECK(std::abs(march.history().back().volume_drift) < 1e-12);
        return found / rate;
    };
    // Taylor 1934, at equal viscosities D = (105/64) E/gamma to first order; half of the difference of extension and
    // compression has no second-order term.
    const auto odd = [&](double rate) { return (deformed(rate) + deformed(-rate)) / 2 - 105.0 / 64; };
    const double coarse = odd(8e-3);
    CHECK(growth / 2 == Approx(-16.0 / 35).epsilon(3e-3));
    const double fine = odd(4e-3);
    INFO("beyond first order " << coarse << ' ' << fine);
    CHECK(std::abs(fine) < 5e-4);
    CHECK(axistokes::test::observed_order(coarse, fine) == Approx(2).margin(0.2));
}

namespace {

/// A capsule marched to rest in an extension. G = 1, gamma = 1/2.
template <class Discretization>
auto capsule_at_rest(const Discretization& discretization, double rate, Index elements, double residual) {
    SimulationParams<double> params;
    params.tolerance = residual;
    params.largest_time_step = 0.1;
    const auto ball = nodes_of(
        discretization, [](Index n) { return sphere<double>(n); }, elements);
    Simulator march(Scene(FreeSpaceKernel<double>(), discretization, Capsule<double>(1, 0.5),
                          UniaxialExtension<double>(rate), DenseLU<double>()),
                    SecondOrder(), ball, params);
    march.run();
    return march;
}

/// A in r = 1 + A P2.
template <class March>
double amplitude(const March& march) {
    const auto& shape = march.configuration().shape;
    const double half_length = (shape.z[shape.elements()] - shape.z[0]) / 2;
    return (half_length - march.scene().discretization().max_radius(shape)) / 1.5;
}

}  // namespace

TEST_CASE("your law that remembers: a capsule's deformation in a weak extension", "[write_your_own]") {
    const double exact = 25.0 / 6 / (1 + 11 * 0.5 / 6);
    const auto mean_error = [&](const auto& discretization, Index elements) {
        const double rate = 1e-3;
        const auto stretched = capsule_at_rest(discretization, rate, elements, 1e-8);
        const auto flattened = capsule_at_rest(discretization, -rate, elements, 1e-8);
        REQUIRE(stretched.stationary());
        REQUIRE(flattened.stationary());
        // Terms of order E^2 have the same sign in both.
        return std::abs((amplitude(stretched) - amplitude(flattened)) / (2 * rate * exact) - 1);
    };
    CHECK(mean_error(SpectralMeridian<double>(), 16) < 3e-5);
    const double coarse = mean_error(LinearElements<double>(), 24);
    const double fine = mean_error(LinearElements<double>(), 48);
    CHECK(fine < 5e-3);
    CHECK(std::log2(coarse / fine) > 1.8);
}

TEST_CASE("your law that remembers: moved nodes take the material along", "[write_your_own]") {
    // In a strong flow; the nodes follow the material in one run, and are moved again and again in the other.
    const auto compare = [](auto params, Index elements, double tolerance) {
        using Discretization = typename decltype(params)::Discretization;
        params.given.meshing.largest_distortion = 100;
        const auto free = capsule_at_rest(Discretization(params.given), 0.1, elements, 1e-6);
        params.given.meshing.largest_distortion = params.tight;
        const auto moved = capsule_at_rest(Discretization(params.given), 0.1, elements, 1e-6);
        const auto count = [](const auto& march) {
            return std::count_if(march.history().begin(), march.history().end(),
                                 [](const auto& record) { return record.redistributed; });
        };
        REQUIRE(free.stationary());
        REQUIRE(moved.stationary());
        CHECK(count(free) == 0);
        CHECK(count(moved) >= 5);
        CHECK(amplitude(free) > 0.15);
        CHECK(amplitude(moved) == Approx(amplitude(free)).epsilon(tolerance));
    };
    struct Series {
        using Discretization = SpectralMeridian<double>;
        Discretization::Params given;
        double tight = 1.002;
    };
    struct Elements {
        using Discretization = LinearElements<double>;
        Discretization::Params given;
        double tight = 1.002;
    };
    compare(Series{}, 24, 1e-5);
    compare(Elements{}, 64, 2e-3);
}

TEST_CASE("your law that remembers: more elements keep the shape and the material", "[write_your_own]") {
    auto march = capsule_at_rest(SpectralMeridian<double>(), 0.1, 16, 1e-4);
    const double before = amplitude(march);
    march.refine(32);
    CHECK(march.configuration().reference.nodes() == 33);
    CHECK(amplitude(march) == Approx(before).epsilon(1e-6));
    // At rest still: the material lies where it lay.
    CHECK(march.scene().discretization().measures(march.configuration().reference).volume ==
          Approx(4 * pi / 3).epsilon(1e-9));
    CHECK(march.instant().deformation_rate < 2e-4);
}
