// SPDX-License-Identifier: MIT
// Backgrounds: what they evaluate to, what they claim to have, and sums of them.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/concepts.hpp>
#include <axistokes/flow/background.hpp>

#include <limits>

namespace {

using axistokes::Background;
using axistokes::Gravity;
using axistokes::Point;
using axistokes::Poiseuille;
using axistokes::Quiescent;
using axistokes::Sum;
using axistokes::UnboundedPoiseuille;
using axistokes::test::mentions;
using axistokes::test::refusal;

static_assert(Background<Quiescent<double>> && Background<Gravity<float>>);
static_assert(Background<UnboundedPoiseuille<long double>> && Background<Poiseuille<double>>);
static_assert(Background<Sum<Gravity<double>, Sum<Quiescent<double>, UnboundedPoiseuille<double>>>>);
static_assert(!Quiescent<double>::has_flow && !Quiescent<double>::has_load);
static_assert(!Gravity<double>::has_flow && Gravity<double>::has_load);
static_assert(UnboundedPoiseuille<double>::has_flow && !UnboundedPoiseuille<double>::has_load);

const Point<double> somewhere{0.5, -2.0};

}  // namespace

TEST_CASE("nothing", "[background]") {
    const Quiescent<double> background;
    CHECK(background.velocity(somewhere).r == 0);
    CHECK(background.velocity(somewhere).z == 0);
    CHECK(background.normal_load(somewhere) == 0);
    CHECK(background.velocity_scale() == 0);
}

TEST_CASE("gravity loads the membrane with the pressure jump -B0 z", "[background]") {
    const Gravity<double> heavy(3.0);
    CHECK(heavy.normal_load(somewhere) == 6.0);
    CHECK(heavy.normal_load({0.5, 1.0}) == -3.0);
    CHECK(heavy.velocity(somewhere).z == 0);
    CHECK(heavy.velocity_scale() == Approx(2.0 / 3));
    // Lighter than its surroundings.
    CHECK(Gravity<double>(-3.0).normal_load(somewhere) == -6.0);
    CHECK(Gravity<double>(-3.0).velocity_scale() == Approx(2.0 / 3));
}

TEST_CASE("unbounded Poiseuille flow", "[background]") {
    const UnboundedPoiseuille<double> flow(0.8, 3.0);
    CHECK(flow.velocity(somewhere).r == 0);
    CHECK(flow.velocity(somewhere).z == Approx(3.0 - 0.8 * 0.25));
    CHECK(flow.velocity({0.0, 7.0}).z == 3.0);
    CHECK(flow.normal_load(somewhere) == 0);
    CHECK(flow.velocity_scale() == 0.8);
    CHECK(UnboundedPoiseuille<double>(-0.8).velocity_scale() == 0.8);
    CHECK(UnboundedPoiseuille<double>(-0.8).velocity({1.0, 0.0}).z == 0.8);
}

TEST_CASE("Poiseuille flow vanishes on the tube", "[background]") {
    const Poiseuille<double> flow(5.0, 2.0);
    CHECK(flow.velocity({0.0, 3.0}).z == 5.0);
    CHECK(flow.velocity({1.0, 3.0}).z == Approx(3.75));
    CHECK(flow.velocity({2.0, 3.0}).z == 0.0);
    CHECK(flow.velocity({1.0, 3.0}).r == 0.0);
    CHECK(flow.mean_velocity() == 2.5);
    CHECK(flow.velocity_scale() == 5.0);
    for (const double radius : {0.0, -1.0}) {
        CHECK(mentions(refusal([=] { Poiseuille<double>(1.0, radius); }), "tube radius", "=", "> 0 and finite"));
    }
}

TEST_CASE("sums add flows and loads and have what either has", "[background]") {
    const Sum<Gravity<double>, UnboundedPoiseuille<double>> both(Gravity<double>(9.0),
                                                                 UnboundedPoiseuille<double>(0.5));
    static_assert(both.has_flow && both.has_load);
    CHECK(both.velocity({2.0, 0.0}).z == -2.0);
    CHECK(both.normal_load({0.0, 1.0}) == -9.0);
    CHECK(both.velocity_scale() == Approx(2.0));
    using Flows = Sum<UnboundedPoiseuille<double>, UnboundedPoiseuille<double>>;
    static_assert(Flows::has_flow && !Flows::has_load);
    CHECK(Flows(UnboundedPoiseuille<double>(0.5), UnboundedPoiseuille<double>(1.0)).velocity({2.0, 0.0}).z == -6.0);
}

TEST_CASE("numbers that are not finite are refused", "[background]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double undefined = std::numeric_limits<double>::quiet_NaN();
    CHECK(mentions(refusal([=] { Gravity<double>{undefined}; }), "Bond number", "nan", "finite"));
    CHECK(mentions(refusal([=] { UnboundedPoiseuille<double>{infinity}; }), "unbounded capillary number", "inf",
                   "finite"));
    CHECK(mentions(refusal([=] { UnboundedPoiseuille<double>(1.0, -infinity); }), "centreline velocity", "-inf",
                   "finite"));
}
