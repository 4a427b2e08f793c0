// SPDX-License-Identifier: MIT
// One accuracy for all policies, orders chosen at run time, and a simulator that continues with more elements.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/accuracy.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

namespace {

using namespace axistokes;
using test::refusal;

using Settling = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                           ExtrapolatedEulerOfOrder, DenseLU<double>>;

Settling settling(int order, const SimulationParams<double>& params) {
    return Settling(spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 24), Gravity<double>(47.0), params, {},
                    LinearElements<double>(), {}, ExtrapolatedEulerOfOrder(order));
}

TEST_CASE("A tighter accuracy tightens every tolerance, down to what the type resolves") {
    const auto fast = Accuracy<double>::preset("fast");
    const auto balanced = Accuracy<double>::preset("balanced");
    const auto reference = Accuracy<double>::preset("reference");
    CHECK(fast.eps == 1e-3);
    CHECK(balanced.eps == 1e-6);
    CHECK(reference.eps == 1e-10);
    for (const auto member : {&Accuracy<double>::quadrature, &Accuracy<double>::kernel, &Accuracy<double>::wall,
                              &Accuracy<double>::step, &Accuracy<double>::residual, &Accuracy<double>::unresolved}) {
        CHECK(fast.*member > balanced.*member);
        CHECK(balanced.*member > reference.*member);
        CHECK(reference.*member > 0);
    }
    CHECK(Accuracy<float>::preset("reference").quadrature >= 16 * std::numeric_limits<float>::epsilon());
    CHECK(refusal([] { Accuracy<double>::preset("exact"); }) ==
          "accuracy preset = exact: must be fast, balanced or reference");
    CHECK(refusal([] { Accuracy<double>(0.5); }) == "accuracy = 0.5: must be in [1e-12, 0.1]");
}

TEST_CASE("An order chosen at run time gives the step of the order chosen at compile time") {
    auto scene = settling(1, {}).scene();
    const auto start = scene.moment(settling(1, {}).state());
    const auto same = [&](const auto& fixed, int order) {
        const auto a = fixed.step(scene, start, 0.01);
        const auto b = ExtrapolatedEulerOfOrder(order).step(scene, start, 0.01);
        return a.bodies[0].shape.r == b.bodies[0].shape.r && a.bodies[0].shape.z == b.bodies[0].shape.z &&
               a.bodies[0].position == b.bodies[0].position;
    };
    CHECK(same(SemiImplicitEuler(), 1));
    CHECK(same(SecondOrder(), 2));
    CHECK(same(ThirdOrder(), 3));
    CHECK_FALSE(same(ThirdOrder(), 2));
    CHECK_FALSE(ExtrapolatedEulerOfOrder(1).estimates_error());
    CHECK(refusal([] { ExtrapolatedEulerOfOrder(7); }) == "order of the time step = 7: must be in [1, 6]");
    CHECK(ExtrapolatedEulerOfOrder::for_tolerance(1e-3).order == 3);
    CHECK(ExtrapolatedEulerOfOrder::for_tolerance(1e-12).order == 6);
}

TEST_CASE("Automatic steps end exactly at the longest time") {
    for (const int order : {1, 3}) {
        SimulationParams<double> params;
        params.longest_time = 0.0123;
        auto simulator = settling(order, params);
        CHECK_FALSE(simulator.run());
        CHECK(simulator.history().back().time == Approx(0.0123).epsilon(1e-14));
        CHECK(simulator.finished());
    }
}

TEST_CASE("Automatic steps end exactly at the landing times, and go on as they were") {
    for (const int order : {1, 3}) {
        SimulationParams<double> params;
        params.longest_time = 0.05;
        params.landing_times = {0.03, 0.0123, 0, 0.1};
        auto simulator = settling(order, params);
        simulator.run();
        std::vector<double> met;
        for (const auto& record : simulator.history()) {
            if (record.time == 0.03 || record.time == 0.0123) {
                met.push_back(record.time);
            }
        }
        CHECK(met == std::vector<double>{0.0123, 0.03});
        params.landing_times.clear();
        auto free = settling(order, params);
        free.run();
        CHECK(simulator.history().size() <= free.history().size() + 2);
    }
    SimulationParams<double> params;
    params.landing_times = {-1};
    CHECK(refusal([&] { settling(1, params); }) == "landing time = -1: must be >= 0 and finite");
}

TEST_CASE("A refined simulation goes on from the same shape") {
    SimulationParams<double> params;
    params.longest_time = 0.01;
    auto simulator = settling(1, params);
    simulator.run();
    const auto before = simulator.scene().discretization().measures(simulator.configuration().shape);
    const double length = simulator.history().back().length;
    simulator.refine(40);
    const Meridian<double>& shape = simulator.configuration().shape;
    const auto after = simulator.scene().discretization().measures(shape);
    CHECK(shape.elements() == 40);
    CHECK(after.area == Approx(before.area).epsilon(1e-12));
    CHECK(after.volume == Approx(before.volume).epsilon(1e-12));
    CHECK(shape.z[40] - shape.z[0] == Approx(length).epsilon(1e-4));
    const auto steps = static_cast<Index>(simulator.history().size());
    CHECK(simulator.step().step == steps + 1);
    CHECK_THROWS_AS(simulator.refine(4), InvalidArgument);
    CHECK(simulator.configuration().shape.elements() == 40);
}

}  // namespace
