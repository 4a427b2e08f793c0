// SPDX-License-Identifier: MIT
// The exact drag on a sphere that moves towards a plane wall against its limits far away and at contact, and higher
// precision.
#include "catch.hpp"
#include "sphere_at_plane_reference.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>

namespace {

using axistokes::test::sphere_at_plane_drag_factor;
using Multi = boost::multiprecision::cpp_bin_float_50;

}  // namespace

TEST_CASE("sphere at a plane: values", "[sphere_at_plane]") {
    CHECK(sphere_at_plane_drag_factor(1.1) == Approx(11.45915720341).epsilon(4e-13));
    CHECK(sphere_at_plane_drag_factor(1.5) == Approx(3.205390315353).epsilon(4e-13));
    CHECK(sphere_at_plane_drag_factor(2.0) == Approx(2.125535566760).epsilon(4e-13));
    CHECK(sphere_at_plane_drag_factor(5.0) == Approx(1.285086562862).epsilon(4e-13));
    CHECK(sphere_at_plane_drag_factor(10.0) == Approx(1.126193683615).epsilon(4e-13));
    // Brenner's table, at alpha = 0.5, 1, 2 and 3.
    CHECK(sphere_at_plane_drag_factor(std::cosh(0.5)) == Approx(9.2518).margin(1e-4));
    CHECK(sphere_at_plane_drag_factor(std::cosh(1.0)) == Approx(3.0361).margin(1e-4));
    CHECK(sphere_at_plane_drag_factor(std::cosh(2.0)) == Approx(1.4129).margin(1e-4));
    CHECK(sphere_at_plane_drag_factor(std::cosh(3.0)) == Approx(1.1252).margin(1e-4));
}

TEST_CASE("sphere at a plane: double agrees with 50 digits", "[sphere_at_plane]") {
    for (const double height : {1.0001, 1.01, 1.1, 1.5, 2.0, 5.0, 10.0, 1000.0}) {
        const Multi exact = sphere_at_plane_drag_factor(Multi(height));
        const Multi error = sphere_at_plane_drag_factor(height) / exact - 1;
        INFO("height " << height << " error " << error);
        CHECK(abs(error) < 1e-14);
    }
}

TEST_CASE("sphere at a plane: reflections far away", "[sphere_at_plane]") {
    // Velocity per force: 1 - 9/(8 h) + 1/(2 h^3) - 135/(256 h^4) + O(h^-5).
    for (const int height : {1000, 10000}) {
        const Multi h = height;
        const Multi fourth = (1 / sphere_at_plane_drag_factor(h) - 1 + 9 / (8 * h) - 1 / (2 * h * h * h)) * pow(h, 4);
        CHECK(static_cast<double>(fourth) == Approx(-135.0 / 256).epsilon(1.0 / height));
    }
}

TEST_CASE("sphere at a plane: lubrication at contact", "[sphere_at_plane]") {
    // 1/gap - log(gap)/5 + 0.97128 + O(gap log(gap)): Cox & Brenner, Chem. Eng. Sci. 22 (1967) 1753.
    for (const double exponent : {3.0, 4.0, 5.0}) {
        const Multi gap = pow(Multi(10), -exponent);
        const Multi rest = sphere_at_plane_drag_factor(Multi(1 + gap)) - 1 / gap + log(gap) / 5;
        CHECK(static_cast<double>(rest) == Approx(0.97128).margin(1e-5 + exponent / 4 * std::pow(10, -exponent)));
    }
}

TEST_CASE("sphere at a plane: one that touches is refused", "[sphere_at_plane]") {
    CHECK_THROWS_AS(sphere_at_plane_drag_factor(1.0), axistokes::InvalidArgument);
    CHECK_THROWS_AS(sphere_at_plane_drag_factor(std::nan("")), axistokes::InvalidArgument);
}
