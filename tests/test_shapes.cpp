// SPDX-License-Identifier: MIT
// Spheres and spheroids: areas against quadrature, excess areas there and back, nodes on the ellipse, bad input.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/geometry/shapes.hpp>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::MeridianSpline;
using axistokes::NodeSpacing;
using axistokes::SpheroidKind;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::refusal;
using axistokes::test::Spheroid;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

/// A = 4 pi a Int_0^1 sqrt(a^2 u^2 + c^2 (1 - u^2)) du, u = cos t; the second argument is the distance from the end.
long double area_by_quadrature(long double a, long double c) {
    boost::math::quadrature::tanh_sinh<long double> rule;
    const auto integrand = [=](long double u, long double rest) {
        const long double v = rest > 0 && u > 0.5L ? rest : 1 - u;
        return std::sqrt(a * a * u * u + c * c * v * (1 + u));
    };
    return 4 * std::acos(-1.0L) * a * rule.integrate(integrand, 0.0L, 1.0L, 1e-18L);
}

}  // namespace

TEST_CASE("spheroid_area agrees with quadrature", "[shapes]") {
    for (const double aspect : {1e-4, 1e-2, 0.5, 0.9, 0.9798, 0.9801, 0.9999, 1 - 1e-9, 1.0, 1 + 1e-9, 1.0001, 1.0002,
                                1.0003, 1.5, 30.0, 1e4}) {
        INFO("aspect " << aspect);
        const double exact = static_cast<double>(area_by_quadrature(1.0L, aspect));
        CHECK(axistokes::spheroid_area(1.0, aspect) == Approx(exact).epsilon(4e-15));
        CHECK(axistokes::spheroid_area(3.0, 3 * aspect) == Approx(9 * exact).epsilon(4e-15));
        const long double precise = area_by_quadrature(1.0L, static_cast<long double>(aspect));
        CHECK(std::abs(axistokes::spheroid_area(1.0L, static_cast<long double>(aspect)) / precise - 1) < 1e-17L);
    }
    CHECK(axistokes::spheroid_area(1.0, 1.0) == Approx(4 * axistokes::test::pi).epsilon(1e-15));
}

TEST_CASE("excess areas there and back", "[shapes]") {
    for (const double excess : {0.0, 1e-10, 1e-6, 1e-3, 0.6, 5.0, 40.0, 100.0}) {
        for (const SpheroidKind kind : {SpheroidKind::prolate, SpheroidKind::oblate}) {
            INFO("excess area " << excess);
            const double aspect = axistokes::spheroid_aspect_of_excess_area(excess, kind);
            CHECK((excess == 0 ? aspect == 1 : kind == SpheroidKind::prolate ? aspect > 1 : aspect < 1));
            const double a = 1 / std::cbrt(aspect);
            CHECK(std::abs(axistokes::spheroid_area(a, aspect * a) - 4 * axistokes::test::pi - excess) <
                  1e-14 * (12.6 + excess));
        }
    }
}

TEST_CASE("nodes of a spheroid lie on the ellipse, from the lower pole to the upper", "[shapes]") {
    const Spheroid exact{0.6, 1.7};
    for (const double weight : {0.0, 0.5, 2.0}) {
        const auto m = axistokes::spheroid(exact.a, exact.c, 50, NodeSpacing<double>{weight, 0.03});
        CHECK_NOTHROW(axistokes::validate(m));
        REQUIRE(m.elements() == 50);
        CHECK(m.z[0] == -exact.c);
        CHECK(m.z[50] == exact.c);
        for (Index i = 0; i < m.nodes(); ++i) {
            CHECK(std::abs(exact.distance(m.r[i], m.z[i])) < 1e-14);
            CHECK(m.r[i] == Approx(m.r[50 - i]).margin(1e-13));
        }
        // The spacing is that of the smooth limit; distortion measured on 50 nodes differs by O(h^2).
        CHECK(axistokes::spacing_distortion(m, NodeSpacing<double>{weight, 0.03}) < 1.02);
    }
}

TEST_CASE("curvature draws nodes to the tips", "[shapes]") {
    const auto even = axistokes::spheroid(0.5, 2.0, 40, NodeSpacing<double>{0.0, 0.03});
    const auto graded = axistokes::spheroid(0.5, 2.0, 40, NodeSpacing<double>{1.0, 0.03});
    CHECK(graded.r[1] < 0.5 * even.r[1]);
}

TEST_CASE("shapes of an excess area have it, and the volume 4 pi/3, to fourth order", "[shapes]") {
    for (const SpheroidKind kind : {SpheroidKind::prolate, SpheroidKind::oblate}) {
        double area_error[2];
        double volume_error[2];
        for (const int k : {0, 1}) {
            const auto m = axistokes::spheroid_of_excess_area(2.0, kind, k == 0 ? 64 : 128);
            const auto measures = MeridianSpline<double>(m).measures();
            area_error[k] = std::abs(measures.area - 4 * axistokes::test::pi - 2);
            volume_error[k] = std::abs(measures.volume - 4 * axistokes::test::pi / 3);
            CHECK(measures.excess_area() == Approx(2.0).margin(1e-4));
            CHECK(measures.reduced_volume() == Approx(std::pow(1 + 2 / (4 * axistokes::test::pi), -1.5)).margin(1e-5));
            CHECK(std::abs(measures.centroid) < 1e-12);
        }
        CHECK(observed_order(area_error[0], area_error[1]) > 3.6);
        CHECK(observed_order(volume_error[0], volume_error[1]) > 3.6);
        CHECK(area_error[1] < 1e-6);
        CHECK(volume_error[1] < 1e-6);
    }
}

TEST_CASE("spheres", "[shapes]") {
    const auto m = axistokes::sphere<double>(33, 2.5);
    for (Index i = 0; i < m.nodes(); ++i) {
        CHECK(std::hypot(m.r[i], m.z[i]) == Approx(2.5).epsilon(1e-15));
        // Constant curvature: equal angles.
        CHECK(std::atan2(m.r[i], -m.z[i]) == Approx(axistokes::test::pi * static_cast<double>(i) / 33).margin(1e-9));
    }
}

TEST_CASE("shapes in other scalars", "[shapes]") {
    const auto single = axistokes::spheroid_of_excess_area<float>(0.6F, SpheroidKind::prolate, 32);
    const auto precise = axistokes::spheroid_of_excess_area<long double>(0.6L, SpheroidKind::prolate, 32);
    const auto usual = axistokes::spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 32);
    for (Index i = 0; i < usual.nodes(); ++i) {
        CHECK(static_cast<double>(single.r[i]) == Approx(usual.r[i]).margin(2e-5));
        CHECK(static_cast<double>(precise.r[i]) == Approx(usual.r[i]).margin(1e-13));
    }
}

TEST_CASE("shapes refuse bad input by name, value and range", "[shapes]") {
    using axistokes::sphere;
    using axistokes::spheroid;
    CHECK(mentions(refusal([] { sphere<double>(32, -1.0); }), "sphere radius", "-1", "> 0"));
    CHECK(mentions(refusal([] { sphere<double>(32, not_a_number); }), "sphere radius", "nan", "> 0"));
    CHECK(mentions(refusal([] { spheroid(-0.5, 1.0, 32); }), "equatorial semi-axis", "-0.5", "> 0 and finite"));
    CHECK(mentions(refusal([] { spheroid(1.0, infinity, 32); }), "polar semi-axis", "inf", "> 0 and finite"));
    CHECK(mentions(refusal([] { spheroid(1.0, 1e-200, 32); }), "polar semi-axis", "e-201",
                   "from 2.93874e-39 to 3.40282e+38"));
    CHECK(mentions(refusal([] { sphere<double>(32, 1e200); }), "equatorial semi-axis", "e+199", "from 2.93874e-39"));
    CHECK(mentions(refusal([] { spheroid(1.0, 1.0, 2); }), "number of elements", "2", "at least 8"));
    CHECK(mentions(refusal([] { axistokes::spheroid_area(0.0, 1.0); }), "equatorial semi-axis", "0", "> 0"));
    CHECK(mentions(refusal([] { axistokes::spheroid_area(1.0, not_a_number); }), "polar semi-axis", "nan", "> 0"));
    CHECK(mentions(refusal([] { axistokes::spheroid_of_aspect(0.0, 32); }), "aspect ratio", "0", "> 0 and finite"));
    for (const double excess : {-0.25, not_a_number, 100.5}) {
        CHECK(mentions(refusal([=] { axistokes::spheroid_of_excess_area(excess, SpheroidKind::oblate, 32); }),
                       "excess area",
                       std::isnan(excess) ? "nan"
                       : excess < 0       ? "-0.25"
                                          : "100.5",
                       "in [0, 100]"));
    }
    CHECK(mentions(refusal([] { axistokes::spheroid_of_excess_area(0.5, SpheroidKind::oblate, 7); }),
                   "number of elements", "7", "at least 8"));
}

TEST_CASE("smooth_spheroid places nodes on the spheroid, evenly in the smoother angle", "[shapes]") {
    for (const double aspect : {0.01, 0.5, 1.0, 7.0, 100.0}) {
        INFO("aspect " << aspect);
        const Index n = 40;
        const Meridian<double> m = axistokes::smooth_spheroid(aspect, n);
        const double a = 1 / std::cbrt(aspect);
        for (Index i = 0; i <= n; ++i) {
            CHECK(std::hypot(m.r[i] / a, m.z[i] / (aspect * a)) == Approx(1).epsilon(1e-14));
            const double angle = std::atan2(m.r[i] / a, -m.z[i] / (aspect * a));
            const double s = std::atan2(std::sqrt(aspect) * std::sin(angle), std::cos(angle));
            CHECK(s == Approx(axistokes::test::pi * static_cast<double>(i) / n).margin(1e-12));
        }
        CHECK(m.r[0] == 0);
        CHECK(m.r[n] == 0);
        CHECK(m.z[0] == -m.z[n]);
    }
    CHECK(mentions(refusal([] { axistokes::smooth_spheroid(infinity, 32); }), "aspect ratio", "inf", "> 0 and finite"));
    CHECK(mentions(refusal([] { axistokes::smooth_spheroid(2.0, 1); }), "number of elements", "1", "at least"));
}
