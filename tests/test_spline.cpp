// SPDX-License-Identifier: MIT
// Cubic splines with poles: orders of convergence, measures of asymmetric shapes, the largest radius.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/geometry/meridian_spline.hpp>

#include <algorithm>
#include <cmath>

namespace {

using axistokes::CubicSpline;
using axistokes::Index;
using axistokes::Meridian;
using axistokes::MeridianSpline;
using axistokes::Parity;
using axistokes::Vector;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::Spheroid;

/// Smoothly uneven points of [0, pi].
Vector<double> uneven(Index elements) {
    Vector<double> t(elements + 1);
    for (Index i = 0; i <= elements; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(elements);
        t[i] = pi * x + 0.4 * std::sin(2 * pi * x);
    }
    return t;
}

struct SplineError {
    double value = 0;
    double first = 0;
    double second = 0;
    double integral = 0;
};

SplineError spline_error(Index elements, Parity parity) {
    const bool even = parity == Parity::even;
    const Vector<double> t = uneven(elements);
    const CubicSpline<double> spline(t, even ? Vector<double>(t.array().cos()) : Vector<double>(t.array().sin()),
                                     parity);
    SplineError worst;
    for (Index e = 0; e < elements; ++e) {
        for (const double x : {0.0, 0.3, 0.7, 1.0}) {
            const double s = t[e] + x * (t[e + 1] - t[e]);
            const double f = even ? std::cos(s) : std::sin(s);
            const double slope = even ? -std::sin(s) : std::cos(s);
            const double primitive = even ? std::sin(s) - std::sin(t[e]) : std::cos(t[e]) - std::cos(s);
            worst.value = std::max(worst.value, std::abs(spline.value(e, x) - f));
            worst.first = std::max(worst.first, std::abs(spline.first(e, x) - slope));
            worst.second = std::max(worst.second, std::abs(spline.second(e, x) + f));
            worst.integral = std::max(worst.integral, std::abs(spline.integral(e, x) - primitive));
        }
    }
    return worst;
}

/// r = sin t (1 + 0.3 cos t), z = -cos t (1 + 0.3 cos t): a pear.
Meridian<double> pear(Index elements) {
    Meridian<double> m{Vector<double>(elements + 1), Vector<double>(elements + 1)};
    for (Index i = 0; i <= elements; ++i) {
        const double t = pi * static_cast<double>(i) / static_cast<double>(elements);
        const double radius = 1 + 0.3 * std::cos(t);
        m.r[i] = i == 0 || i == elements ? 0 : radius * std::sin(t);
        m.z[i] = -radius * std::cos(t);
    }
    return m;
}

/// Area, volume and centroid of the pear, by Gauss-Legendre in t and by integrals of polynomials in u = cos t:
/// V = 2 pi/3 Int rho^3 du, z_c V = -pi/2 Int rho^4 u du, rho = 1 + k u.
struct ExactPear {
    static constexpr double k = 0.3;
    static double volume() { return 2 * pi / 3 * (2 + 2 * k * k); }
    static double centroid() { return -pi / 2 * (8 * k / 3 + 8 * k * k * k / 5) / volume(); }
    static double area() {
        return boost::math::quadrature::gauss<double, 60>::integrate(
            [](double t) {
                const double rho = 1 + k * std::cos(t);
                return 2 * pi * rho * std::sin(t) * std::hypot(rho, k * std::sin(t));
            },
            0.0, pi);
    }
};

}  // namespace

TEST_CASE("a cubic spline converges at fourth order, its derivatives at third and second", "[spline]") {
    for (const Parity parity : {Parity::even, Parity::odd}) {
        const SplineError coarse = spline_error(40, parity);
        const SplineError fine = spline_error(80, parity);
        CHECK(observed_order(coarse.value, fine.value) > 3.7);
        CHECK(observed_order(coarse.first, fine.first) > 2.7);
        CHECK(observed_order(coarse.second, fine.second) > 1.7);
        CHECK(observed_order(coarse.integral, fine.integral) > 4.6);
        CHECK(fine.value < 2e-6);
        CHECK(fine.second < 2e-3);
    }
}

TEST_CASE("a cubic spline is continuous up to its second derivative and keeps its parity", "[spline]") {
    const Vector<double> t = uneven(12);
    const Vector<double> f = (3 * t.array()).sin() + t.array();
    for (const Parity parity : {Parity::even, Parity::odd}) {
        const CubicSpline<double> spline(t, f, parity);
        for (Index e = 0; e + 1 < 12; ++e) {
            CHECK(spline.value(e, 1.0) == Approx(f[e + 1]));
            CHECK(spline.first(e, 1.0) == Approx(spline.first(e + 1, 0.0)).epsilon(1e-10));
            CHECK(spline.second(e, 1.0) == Approx(spline.second(e + 1, 0.0)).epsilon(1e-10));
        }
        for (const auto& [e, x] : {std::pair<Index, double>{0, 0.0}, {11, 1.0}}) {
            CHECK(std::abs(parity == Parity::even ? spline.first(e, x) : spline.second(e, x)) < 1e-12);
        }
    }
}

TEST_CASE("area, volume and centroid of a pear converge at fourth order", "[spline]") {
    const auto coarse = MeridianSpline<double>(pear(32)).measures();
    const auto fine = MeridianSpline<double>(pear(64)).measures();
    CHECK(observed_order(std::abs(coarse.area - ExactPear::area()), std::abs(fine.area - ExactPear::area())) > 3.7);
    CHECK(observed_order(std::abs(coarse.volume - ExactPear::volume()), std::abs(fine.volume - ExactPear::volume())) >
          3.7);
    CHECK(observed_order(std::abs(coarse.centroid - ExactPear::centroid()),
                         std::abs(fine.centroid - ExactPear::centroid())) > 3.7);
    CHECK(fine.area == Approx(ExactPear::area()).epsilon(1e-5));
    CHECK(fine.volume == Approx(ExactPear::volume()).epsilon(1e-5));
    CHECK(fine.centroid == Approx(ExactPear::centroid()).epsilon(1e-5));
}

TEST_CASE("measures move with the shape", "[spline]") {
    Meridian<double> m = pear(40);
    const auto before = MeridianSpline<double>(m).measures();
    m.z.array() += 12.5;
    const auto after = MeridianSpline<double>(m).measures();
    CHECK(after.area == Approx(before.area).epsilon(1e-13));
    CHECK(after.volume == Approx(before.volume).epsilon(1e-13));
    CHECK(after.centroid == Approx(before.centroid + 12.5).epsilon(1e-13));
}

TEST_CASE("normals and curvature of the spline", "[spline]") {
    const Spheroid exact{0.7, 1.6};
    double worst[2] = {0, 0};
    for (const int k : {0, 1}) {
        const auto m = exact.meridian(k == 0 ? 40 : 80, 0.3);
        const MeridianSpline<double> spline(m);
        for (Index i = 0; i < m.nodes(); ++i) {
            const double t = exact.parameter(m.r[i], m.z[i]);
            const auto p = spline.at_node(i);
            CHECK(p.normal().r == Approx(exact.normal(t).r).margin(1e-3));
            CHECK(p.normal().z == Approx(exact.normal(t).z).margin(1e-3));
            worst[k] = std::max(worst[k], std::abs(p.meridional_curvature() - exact.meridional(t)));
        }
    }
    CHECK(observed_order(worst[0], worst[1]) > 1.8);
    CHECK(worst[1] < 2e-2);
}

TEST_CASE("the largest radius is found wherever it is", "[spline]") {
    // Even numbers put a node on the equator, where r' is zero up to rounding.
    for (Index elements = 8; elements <= 120; ++elements) {
        INFO(elements << " elements");
        const double h = pi / static_cast<double>(elements);
        for (const double c : {0.3, 0.7, 1.0, 2.2}) {
            CHECK(MeridianSpline<double>(Spheroid{0.8, c}.meridian(elements)).max_radius() ==
                  Approx(0.8).epsilon(0.3 * h * h * h * h));
        }
    }
    // Two bulges: the larger one.
    for (const double tilt : {0.1, -0.1}) {
        Meridian<double> m = Spheroid{1.0, 2.0}.meridian(100);
        for (Index i = 1; i < 100; ++i) {
            m.r[i] *= 0.3 + m.z[i] * m.z[i] + tilt * m.z[i];
        }
        const double largest = m.r.maxCoeff();
        const double found = MeridianSpline<double>(m).max_radius();
        CHECK(found >= largest);
        CHECK(found < 1.002 * largest);
    }
}
