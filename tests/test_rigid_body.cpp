// SPDX-License-Identifier: MIT
// Rigid spheres and spheroids in free space: drag in closed form, order of convergence, tractions.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/sum.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

#include <cmath>

namespace {

using namespace axistokes;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::Spheroid;

/// Translating along its axis, F = 6 pi a k U with a the equatorial semi-axis (Oberbeck 1876; Happel & Brenner, 5-11).
/// With t = c/a: prolate k = (8/3) / [-2t/(t^2-1) + (2t^2-1)/(t^2-1)^(3/2) log((t+s)/(t-s))], s = sqrt(t^2-1);
/// oblate k = (8/3) / [2t/(1-t^2) + 2(1-2t^2)/(1-t^2)^(3/2) arctan(sqrt(1-t^2)/t)].
double drag(const Spheroid& s) {
    const double t = s.c / s.a;
    if (t == 1) {
        return 6 * pi * s.a;
    }
    const double q = std::abs(t * t - 1);
    const double e = std::sqrt(q);
    const double k = t > 1 ? 8.0 / 3 / (-2 * t / q + (2 * t * t - 1) / (q * e) * std::log((t + e) / (t - e)))
                           : 8.0 / 3 / (2 * t / q + 2 * (1 - 2 * t * t) / (q * e) * std::atan(e / t));
    return 6 * pi * s.a * k;
}

template <class Flow>
auto scene(Flow flow) {
    return Scene(FreeSpaceKernel<double>{}, LinearElements<double>{}, RigidBody<double>{}, flow, DenseLU<double>{});
}

template <class Flow>
auto evaluate(const Meridian<double>& m, Flow flow) {
    auto s = scene(flow);
    return s.evaluate(Configuration<double>{m, 0.0, {}}, 0.0);
}

/// Error of the settling speed B0 V/drag, relative.
double speed_error(const Spheroid& s, Index elements) {
    const double bond = 7;
    return std::abs(evaluate(s.meridian(elements), Gravity<double>(bond)).velocity * drag(s) / (-bond * s.volume()) -
                    1);
}

}  // namespace

TEST_CASE("the closed forms of the drag meet at the sphere and at the disc", "[rigid]") {
    CHECK(drag({1.0, 1.001}) == Approx(6 * pi * (1 + 0.001 / 5)).epsilon(1e-6));
    CHECK(drag({1.0, 0.999}) == Approx(6 * pi * (1 - 0.001 / 5)).epsilon(1e-6));
    CHECK(drag({1.0, 1e-9}) == Approx(16.0).epsilon(1e-6));
}

TEST_CASE("a sphere settles at (2/9) B0", "[rigid]") {
    for (const double bond : {1.0, -4.5, 47.0}) {
        const auto instant = evaluate(Spheroid{1, 1}.meridian(128), Gravity<double>(bond));
        CHECK(instant.velocity == Approx(-2.0 / 9 * bond).epsilon(3e-4));
        CHECK(instant.deformation_rate < 1e-12 * std::abs(bond));
    }
}

TEST_CASE("spheroids have Oberbeck's drag, to second order", "[rigid]") {
    for (const double aspect : {1.0, 2.0, 5.0, 0.5, 0.2}) {
        INFO("aspect " << aspect);
        const double a = 1 / std::cbrt(aspect);
        const Spheroid s{a, aspect * a};
        const double coarse = speed_error(s, 64);
        const double fine = speed_error(s, 128);
        INFO("errors " << coarse << ' ' << fine);
        CHECK(observed_order(coarse, fine) > 1.85);
        CHECK(fine < 2e-3);
    }
}

TEST_CASE("the traction carries the weight and has no mean normal part", "[rigid]") {
    const auto m = Spheroid{0.7, 1.5}.meridian(80, 0.3);
    const double bond = 3;
    const auto instant = evaluate(m, Gravity<double>(bond));
    const auto& surface = instant.surface;
    const Index n = surface.size();
    const Vector<double>& f = instant.solution.force;
    CHECK(surface.weight.dot(f.tail(n)) == Approx(-bond * Spheroid{0.7, 1.5}.volume()).epsilon(2e-3));
    CHECK(std::abs(surface.flux(f)) < 1e-9);
    CHECK(f[0] == 0);
    // A translating ellipsoid's traction is (F/A) times the support function: f_z = F n.x / (4 pi a^2 c).
    for (Index i = 2; i + 2 < n; ++i) {
        const double support = surface.normal_r[i] * m.r[i] + surface.normal_z[i] * m.z[i];
        CHECK(f[n + i] == Approx(-bond * support / 3).epsilon(2e-2));
    }
}

TEST_CASE("a sphere in a parabolic flow lags by Faxen's law", "[rigid]") {
    // U = u_inf(0) + Lap u_inf/6 = u_0 - (2/3) Ca; under gravity both add up.
    const auto m = Spheroid{1, 1}.meridian(96);
    const UnboundedPoiseuille<double> flow(0.6, 2.0);
    CHECK(evaluate(m, flow).velocity == Approx(2.0 - 0.4).epsilon(3e-4));
    CHECK(evaluate(m, Sum(flow, Gravity<double>(9.0))).velocity == Approx(2.0 - 0.4 - 2.0).margin(1e-3));
}
