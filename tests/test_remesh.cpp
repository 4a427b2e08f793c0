// SPDX-License-Identifier: MIT
// Redistribution of nodes: the curve stays, the spacing is the one asked for, and a second pass changes nothing.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/geometry/remesh.hpp>

#include <boost/math/special_functions/ellint_2.hpp>

#include <algorithm>
#include <cmath>

namespace {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::MeridianSpline;
using axistokes::NodeSpacing;
using axistokes::redistribute;
using axistokes::spacing_distortion;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::refusal;
using axistokes::test::Spheroid;

const Spheroid exact{0.6, 1.7};

double largest_distance(const Meridian<double>& m) {
    double worst = 0;
    for (Index i = 0; i < m.nodes(); ++i) {
        worst = std::max(worst, std::abs(exact.distance(m.r[i], m.z[i])));
    }
    return worst;
}

double largest_move(const Meridian<double>& a, const Meridian<double>& b) {
    return std::max((a.r - b.r).cwiseAbs().maxCoeff(), (a.z - b.z).cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("redistribution keeps the shape to fourth order and the poles exactly", "[remesh]") {
    for (const double weight : {0.0, 0.5, 2.0}) {
        INFO("curvature weight " << weight);
        const NodeSpacing<double> spacing{weight, 0.03};
        double distance[2];
        double area[2];
        for (const int k : {0, 1}) {
            const auto start = exact.meridian(k == 0 ? 48 : 96, 0.6);
            const auto moved = redistribute(start, spacing, start.elements());
            CHECK_NOTHROW(axistokes::validate(moved));
            CHECK(moved.z[0] == start.z[0]);
            CHECK(moved.z[start.elements()] == start.z[start.elements()]);
            CHECK(largest_move(start, moved) > 0.01);
            distance[k] = largest_distance(moved);
            area[k] = std::abs(MeridianSpline<double>(moved).measures().area - exact.area());
        }
        CHECK(observed_order(distance[0], distance[1]) > 3.6);
        CHECK(observed_order(area[0], area[1]) > 3.5);
        CHECK(distance[1] < 1e-5);
    }
}

TEST_CASE("the spacing is the one asked for", "[remesh]") {
    for (const double weight : {0.0, 0.5, 2.0}) {
        const NodeSpacing<double> spacing{weight, 0.03};
        const auto start = exact.meridian(80, 0.8);
        CHECK(spacing_distortion(start, spacing) > 1.5);
        for (const Index elements : {40, 80, 160}) {
            const auto moved = redistribute(start, spacing, elements);
            REQUIRE(moved.elements() == elements);
            // Measured with the curvature of the new nodes, which differs by O(h^2).
            CHECK(spacing_distortion(moved, spacing) < 1.02);
        }
    }
}

TEST_CASE("without curvature weight the arc lengths are equal", "[remesh]") {
    const auto moved = redistribute(exact.meridian(120, 0.6), NodeSpacing<double>{0.0, 0.03}, 60);
    // Arc length from the lower pole, r = a sin t, z = -c cos t: c E(t | 1 - a^2/c^2) counted from the equator.
    const double k = std::sqrt(1 - exact.a * exact.a / (exact.c * exact.c));
    const double quarter = exact.c * boost::math::ellint_2(k);
    for (Index i = 0; i <= 60; ++i) {
        const double t = exact.parameter(moved.r[i], moved.z[i]);
        const double s = quarter + exact.c * boost::math::ellint_2(k, t - axistokes::test::pi / 2);
        CHECK(s == Approx(2 * quarter * static_cast<double>(i) / 60).margin(1e-4));
    }
}

TEST_CASE("redistributing twice changes nothing more", "[remesh]") {
    const NodeSpacing<double> spacing;
    double move[2];
    for (const int k : {0, 1}) {
        const Index elements = k == 0 ? 64 : 128;
        const auto once = redistribute(exact.meridian(elements, 0.6), spacing, elements);
        move[k] = largest_move(once, redistribute(once, spacing, elements));
    }
    CHECK(move[1] < 2e-4);
    CHECK(observed_order(move[0], move[1]) > 1.8);
}

TEST_CASE("a symmetric shape stays symmetric", "[remesh]") {
    const auto moved = redistribute(exact.meridian(64, 0.6), NodeSpacing<double>{}, 50);
    for (Index i = 0; i <= 50; ++i) {
        CHECK(std::abs(moved.r[i] - moved.r[50 - i]) < 1e-12);
        CHECK(std::abs(moved.z[i] + moved.z[50 - i]) < 1e-12);
    }
}

TEST_CASE("too few elements are refused", "[remesh]") {
    CHECK(mentions(refusal([] { redistribute(exact.meridian(32), NodeSpacing<double>{}, 5); }), "number of elements",
                   "5", "at least 8"));
}
