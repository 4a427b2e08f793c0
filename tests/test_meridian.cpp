// SPDX-License-Identifier: MIT
// What validate() refuses, and how it says so; self_intersection.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/geometry/meridian.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::self_intersection;
using axistokes::Vector;
using axistokes::test::mentions;
using axistokes::test::refusal;
using axistokes::test::Spheroid;

Meridian<double> valid(Index elements = 16) {
    return Spheroid{1.0, 1.0}.meridian(elements);
}

std::string refusal_of(const Meridian<double>& m) {
    return refusal([&] { axistokes::validate(m); });
}

/// A sphere whose lower half reaches through its upper half.
Meridian<double> crossing() {
    Meridian<double> m = valid();
    m.r[5] = 0.2;
    m.z[5] = 0.5;
    m.r[6] = 0.2;
    m.z[6] = 1.5;
    return m;
}

}  // namespace

TEST_CASE("a valid meridian passes", "[meridian]") {
    CHECK_NOTHROW(axistokes::validate(valid(8)));
    CHECK_NOTHROW(axistokes::validate(valid(300)));
    CHECK_NOTHROW(axistokes::validate(Spheroid{0.01, 5.0}.meridian(64)));
}

TEST_CASE("coordinates that are not finite are refused", "[meridian]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    Meridian<double> m = valid();
    m.r[3] = nan;
    CHECK(mentions(refusal_of(m), "r of meridian node 3", "nan", "finite"));
    m = valid();
    m.z[0] = -infinity;
    CHECK(mentions(refusal_of(m), "z of meridian node 0", "-inf", "finite"));
    m = valid();
    m.z[16] = nan;
    CHECK(mentions(refusal_of(m), "z of meridian node 16", "nan", "finite"));
}

TEST_CASE("radii of the wrong sign are refused", "[meridian]") {
    Meridian<double> m = valid();
    m.r[7] = -0.125;
    CHECK(mentions(refusal_of(m), "r of meridian node 7", "-0.125", "> 0 between the poles"));
    m = valid();
    m.r[2] = 0;
    CHECK(mentions(refusal_of(m), "r of meridian node 2", "0", "> 0 between the poles"));
    for (const Index pole : {0, 16}) {
        m = valid();
        m.r[pole] = 0.25;
        CHECK(mentions(refusal_of(m), "r of meridian node " + std::to_string(pole), "0.25", "0 at a pole"));
    }
}

TEST_CASE("too few elements, or columns of different length, are refused", "[meridian]") {
    CHECK(mentions(refusal_of(valid(2)), "number of elements", "2", "at least 8"));
    CHECK(mentions(refusal_of(valid(7)), "number of elements", "7", "at least 8"));
    CHECK(mentions(refusal_of(Meridian<double>{}), "number of elements", "-1", "at least 8"));
    Meridian<double> m = valid();
    m.z.conservativeResize(12);
    CHECK(mentions(refusal_of(m), "17 values of r", "12 of z", "equally many"));
}

TEST_CASE("coincident nodes are refused", "[meridian]") {
    Meridian<double> m = valid();
    m.r[9] = m.r[8];
    m.z[9] = m.z[8];
    CHECK(mentions(refusal_of(m), "nodes 8 and 9", "coincide", "distinct"));
}

TEST_CASE("a curve that starts at the upper pole is refused", "[meridian]") {
    Meridian<double> m = valid();
    m.z = -m.z;
    CHECK(mentions(refusal_of(m), "signed area", "= -1.5", "the lower pole comes first"));
}

TEST_CASE("a curve that crosses itself is refused, by its nodes", "[meridian]") {
    const auto pair = self_intersection(crossing());
    REQUIRE(pair);
    CHECK(pair->first < pair->second);
    CHECK(mentions(refusal_of(crossing()), "nodes " + std::to_string(pair->first),
                   "and " + std::to_string(pair->second), "must not intersect itself"));
}

TEST_CASE("self_intersection finds crossings and nothing else", "[meridian]") {
    CHECK_FALSE(self_intersection(valid()));
    CHECK_FALSE(self_intersection(Spheroid{0.001, 5.0}.meridian(200)));
    // A dimple whose pole comes close to the other one does not cross; once through, it does.
    for (const double depth : {0.99, 1.01}) {
        Meridian<double> m = valid(40);
        for (Index i = 0; i < 20; ++i) {
            m.z[i] += 2 * depth * std::exp(-8 * m.r[i] * m.r[i]);
        }
        CHECK(self_intersection(m).has_value() == (depth > 1));
    }
    // The first pair, by its lower node.
    Meridian<double> m = valid(40);
    std::swap(m.z[10], m.z[12]);
    std::swap(m.r[10], m.r[12]);
    const auto pair = self_intersection(m);
    REQUIRE(pair);
    CHECK(pair->first == 9);
    CHECK(pair->second == 12);
}
