// SPDX-License-Identifier: MIT
// Area and volume are given back by the smallest normal displacement; impossible demands are reported.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/geometry/restore.hpp>
#include <axistokes/geometry/shapes.hpp>

#include <cmath>

namespace {

using axistokes::Index;
using axistokes::Measures;
using axistokes::Meridian;
using axistokes::MeridianSpline;
using axistokes::restore_area_and_volume;
using axistokes::test::Spheroid;

Measures<double> measures(const Meridian<double>& m) {
    return MeridianSpline<double>(m).measures();
}

}  // namespace

TEST_CASE("area and volume are restored to round-off", "[restore]") {
    const auto original = Spheroid{0.7, 1.5}.meridian(60, 0.2);
    const auto wanted = measures(original);
    Meridian<double> m = original;
    for (Index i = 1; i < 60; ++i) {
        m.r[i] *= 1 + 2e-3 * std::cos(3 * m.z[i]);
    }
    m.z *= 0.998;
    const Meridian<double> perturbed = m;
    REQUIRE(std::abs(measures(m).area / wanted.area - 1) > 1e-5);
    REQUIRE(std::abs(measures(m).volume / wanted.volume - 1) > 1e-4);
    REQUIRE(restore_area_and_volume<double>(m, wanted.area, wanted.volume, 1e-13));
    CHECK(std::abs(measures(m).area / wanted.area - 1) <= 1e-13);
    CHECK(std::abs(measures(m).volume / wanted.volume - 1) <= 1e-13);
    CHECK_NOTHROW(axistokes::validate(m));
    // The correction is of the size of the perturbation.
    CHECK((m.r - perturbed.r).cwiseAbs().maxCoeff() < 1e-2);
    CHECK((m.z - perturbed.z).cwiseAbs().maxCoeff() < 1e-2);
}

TEST_CASE("a shape that has the area and volume is left alone", "[restore]") {
    const auto original = Spheroid{1.2, 0.7}.meridian(40);
    const auto wanted = measures(original);
    Meridian<double> m = original;
    CHECK(restore_area_and_volume<double>(m, wanted.area, wanted.volume, 1e-13));
    CHECK(m.r == original.r);
    CHECK(m.z == original.z);
}

TEST_CASE("the displacement is the smallest: normal, and of the form a + b H", "[restore]") {
    const Spheroid exact{0.7, 1.5};
    Meridian<double> m = exact.meridian(200);
    const Meridian<double> original = m;
    const auto now = measures(m);
    const double da = 1e-6 * now.area;
    const double dv = -2e-6 * now.volume;
    REQUIRE(restore_area_and_volume<double>(m, now.area + da, now.volume + dv, 1e-12));
    // a and b from dA = Int 2 H (a + b H) dA, dV = Int (a + b H) dA by quadrature.
    const double h1 = exact.integral([&](double t) { return exact.mean(t); });
    const double h2 = exact.integral([&](double t) { return exact.mean(t) * exact.mean(t); });
    const double determinant = 2 * (h1 * h1 - h2 * exact.area());
    const double a = (da * h1 - 2 * h2 * dv) / determinant;
    const double b = (2 * h1 * dv - exact.area() * da) / determinant;
    for (Index i = 0; i < m.nodes(); ++i) {
        const double t = exact.parameter(original.r[i], original.z[i]);
        const auto n = exact.normal(t);
        const double shift = a + b * exact.mean(t);
        CHECK(m.r[i] - original.r[i] == Approx(shift * n.r).margin(2e-3 * std::abs(b)));
        CHECK(m.z[i] - original.z[i] == Approx(shift * n.z).margin(2e-3 * std::abs(b)));
    }
}

TEST_CASE("a sphere gets its radius back", "[restore]") {
    const auto wanted = measures(Spheroid{1.0, 1.0}.meridian(48));
    Meridian<double> m = Spheroid{1.0005, 1.0005}.meridian(48);
    REQUIRE(restore_area_and_volume<double>(m, wanted.area, wanted.volume, 1e-12));
    for (Index i = 0; i < m.nodes(); ++i) {
        CHECK(std::hypot(m.r[i], m.z[i]) == Approx(1.0).epsilon(1e-7));
    }
}

TEST_CASE("an area below the sphere's cannot be had", "[restore]") {
    Meridian<double> m = Spheroid{0.9, 1.2}.meridian(48);
    const auto now = measures(m);
    CHECK_FALSE(restore_area_and_volume<double>(m, 0.8 * now.area, now.volume, 1e-12));
}

TEST_CASE("excess areas of nearly spherical shapes are restored too", "[restore]") {
    // Series, whose measures are exact to round-off. A share of the excess area is lost, and 1e-5 of the volume.
    const axistokes::SpectralMeridian<double> series;
    const double pi = axistokes::test::pi;
    const double volume = 4 * pi / 3;
    for (const double excess_area : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        INFO("excess area " << excess_area);
        const double area = 4 * pi + excess_area;
        const auto spheroid = [](double excess) {
            return axistokes::spheroid_of_excess_area<double>(excess, axistokes::SpheroidKind::oblate, 32);
        };
        Meridian<double> m = spheroid(0.8 * excess_area);
        m.r *= 1 + 1e-5;
        m.z *= 1 + 1e-5;
        REQUIRE(series.restore(m, area, volume));
        CHECK(series.measures(m).area - 4 * pi == Approx(excess_area).epsilon(1e-12 * area / excess_area));
        CHECK(std::abs(series.measures(m).volume / volume - 1) < 1e-12);
        // It is the oblate spheroid, to second order.
        const Meridian<double> exact = spheroid(excess_area);
        const double deviation = std::abs(exact.z[32] - 1);
        CHECK(std::abs(m.z[32] - exact.z[32]) < 0.02 * deviation);
    }
}
