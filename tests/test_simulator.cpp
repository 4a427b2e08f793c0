// SPDX-License-Identifier: MIT
// Simulations from end to end on small meshes: stationary states known in closed form or from the literature, drift,
// step control, and what a failing run leaves behind.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/flow/unbounded_poiseuille.hpp>
#include <axistokes/geometry/distance.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/explicit_euler.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace {

using axistokes::ExplicitEuler;
using axistokes::Gravity;
using axistokes::Index;
using axistokes::Meridian;
using axistokes::Quiescent;
using axistokes::SemiImplicitEuler;
using axistokes::sphere;
using axistokes::spheroid_of_excess_area;
using axistokes::SpheroidKind;
using axistokes::UnboundedPoiseuille;
using axistokes::test::failure;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::refusal;

template <class Flow, class Membrane = axistokes::Vesicle<double>, class Integrator = SemiImplicitEuler>
using Simulator = axistokes::Simulator<axistokes::FreeSpaceKernel<double>, axistokes::LinearElements<double>, Membrane,
                                       Flow, Integrator, axistokes::DenseLU<double>>;
using Params = axistokes::SimulationParams<double>;
using Record = axistokes::StepRecord<double>;

Params with_tolerance(double tolerance) {
    Params params;
    params.tolerance = tolerance;
    return params;
}

Params with_step(double dt, Index steps) {
    Params params;
    params.time_step = dt;
    params.most_steps = steps;
    return params;
}

/// Excess area of the reduced volume v: v = (1 + D/(4 pi))^(-3/2).
double excess_area(double v) {
    return 4 * pi * (std::pow(v, -2.0 / 3) - 1);
}

Meridian<double> prolate(double excess, Index elements) {
    return spheroid_of_excess_area(excess, SpheroidKind::prolate, elements);
}

double sphere_speed_error(Index elements) {
    Simulator<Gravity<double>> simulator(sphere<double>(elements), Gravity<double>(4.5), with_tolerance(1e-6));
    CHECK(simulator.run());
    return std::abs(simulator.history().back().velocity + 1);
}

bool equal(const Meridian<double>& a, const Meridian<double>& b) {
    return a.r == b.r && a.z == b.z;
}

}  // namespace

TEST_CASE("a vesicle without excess area settles like a rigid sphere, at (2/9) B0", "[simulator]") {
    const double coarse = sphere_speed_error(32);
    const double fine = sphere_speed_error(64);
    CHECK(fine < 1e-3);
    CHECK(observed_order(coarse, fine) > 1.8);
}

TEST_CASE("a rigid body is stationary at once", "[simulator]") {
    Simulator<Gravity<double>, axistokes::RigidBody<double>> simulator(sphere<double>(48), Gravity<double>(9.0));
    CHECK_FALSE(simulator.stationary());
    CHECK(simulator.run());
    REQUIRE(simulator.history().size() == 1);
    CHECK(simulator.stationary());
    CHECK(simulator.history().back().velocity == Approx(-2.0).epsilon(2e-3));
    CHECK(std::abs(simulator.history().back().area_drift) < 1e-14);
}

TEST_CASE("without flow the energy falls to the known minimum", "[simulator]") {
    // Seifert, Berndl, Lipowsky 1991: energies over 8 pi of the prolate and the oblate branch.
    struct Case {
        double reduced_volume;
        SpheroidKind kind;
        double energy;
    };
    for (const Case& c : {Case{0.95, SpheroidKind::prolate, 1.09557}, Case{0.95, SpheroidKind::oblate, 1.10612},
                          Case{0.9, SpheroidKind::prolate, 1.18964}}) {
        INFO("reduced volume " << c.reduced_volume << ", " << c.energy);
        double error[2];
        for (const int k : {0, 1}) {
            const Index elements = k == 0 ? 32 : 64;
            Simulator<Quiescent<double>> simulator(
                spheroid_of_excess_area(excess_area(c.reduced_volume), c.kind, elements), Quiescent<double>{},
                with_tolerance(1e-6));
            CHECK(simulator.run());
            const auto& history = simulator.history();
            const double minimum = history.back().bending_energy;
            error[k] = std::abs(minimum / (8 * pi * c.energy) - 1);
            // Near the minimum the discrete energy's own error, O(h^4), hides the decrease.
            const double hidden = 100 * std::pow(static_cast<double>(elements), -4);
            double previous = std::numeric_limits<double>::infinity();
            for (const Record& record : history) {
                CHECK(record.bending_energy < previous + (previous - minimum < hidden ? hidden : 0));
                previous = record.bending_energy;
            }
            CHECK(history.front().bending_energy > minimum);
        }
        INFO("errors " << error[0] << ' ' << error[1]);
        CHECK(error[1] < 2e-5);
    }
}

TEST_CASE("area and volume are kept in every step", "[simulator]") {
    Simulator<UnboundedPoiseuille<double>> simulator(prolate(0.6, 40), UnboundedPoiseuille<double>(5.0));
    Index steps = 0;
    Index kept = 0;
    simulator.run([&](const Record& record) {
        // Redistribution comes after the correction and moves the shape by O(h^4); the next step corrects that too.
        const double bound = record.redistributed ? 1e-5 : 1e-12;
        CHECK(std::abs(record.area_drift) < bound);
        CHECK(std::abs(record.volume_drift) < bound);
        kept += record.redistributed ? 0 : 1;
        CHECK(std::abs(record.area_error) < 1e-2);
        CHECK(record.area / simulator.initial_area() - 1 == Approx(record.area_drift).margin(1e-14));
        CHECK(record.volume / simulator.initial_volume() - 1 == Approx(record.volume_drift).margin(1e-14));
        return ++steps < 40;
    });
    CHECK(steps == 40);
    CHECK(kept > 20);
    CHECK(simulator.history().size() == 40);
}

TEST_CASE("the correction of a step is second order in its length", "[simulator]") {
    double error[2];
    for (const int k : {0, 1}) {
        Simulator<UnboundedPoiseuille<double>> simulator(prolate(0.6, 40), UnboundedPoiseuille<double>(5.0),
                                                         with_step(k == 0 ? 2e-3 : 1e-3, 1));
        simulator.run();
        error[k] = std::abs(simulator.history()[0].area_error);
    }
    CHECK(error[1] < error[0] / 1.8);
}

TEST_CASE("the semi-implicit scheme converges at first order in time", "[simulator]") {
    double length[3];
    for (const int k : {0, 1, 2}) {
        const Index steps = Index(8) << k;
        Simulator<Gravity<double>> simulator(prolate(0.6, 32), Gravity<double>(10.0),
                                             with_step(0.16 / static_cast<double>(steps), steps));
        simulator.run();
        CHECK(simulator.history().back().time == Approx(0.16));
        length[k] = simulator.history().back().length;
    }
    CHECK(observed_order(std::abs(length[0] - length[1]), std::abs(length[1] - length[2])) == Approx(1.0).margin(0.25));
}

TEST_CASE("the history integrates the centroid's velocity", "[simulator]") {
    Meridian<double> start = prolate(0.6, 32);
    start.z.array() += 3;
    Simulator<Gravity<double>> simulator(start, Gravity<double>(10.0), with_step(5e-3, 10));
    CHECK(simulator.configuration().position == Approx(3.0).margin(1e-12));
    simulator.run();
    double position = 3;
    double time = 0;
    for (const Record& record : simulator.history()) {
        position += record.dt * record.velocity;
        time += record.dt;
        CHECK(record.time == Approx(time));
        // The correction of area and volume moves the centroid a little.
        CHECK(record.position == Approx(position).margin(1e-3));
    }
    const auto measures = simulator.scene().discretization().measures(simulator.shape());
    CHECK(measures.centroid == Approx(simulator.history().back().position).margin(1e-10));
}

TEST_CASE("the explicit scheme blows up where the semi-implicit one does not", "[simulator]") {
    const auto start = prolate(0.6, 48);
    Simulator<Quiescent<double>> semi(start, Quiescent<double>{}, with_step(5e-3, 40));
    CHECK_NOTHROW(semi.run());
    CHECK(semi.history().size() == 40);

    Simulator<Quiescent<double>, axistokes::Vesicle<double>, ExplicitEuler> unstable(start, Quiescent<double>{},
                                                                                     with_step(5e-3, 40));
    CHECK(failure([&] { unstable.run(); }) != "nothing was thrown");
    CHECK(unstable.history().size() < 40);

    // With a small enough step both go the same way.
    Simulator<Quiescent<double>, axistokes::Vesicle<double>, ExplicitEuler> stable(start, Quiescent<double>{},
                                                                                   with_step(5e-6, 100));
    Simulator<Quiescent<double>> same(start, Quiescent<double>{}, with_step(5e-6, 100));
    stable.run();
    same.run();
    CHECK(stable.history().back().bending_energy < stable.history().front().bending_energy);
    CHECK(stable.history().back().bending_energy == Approx(same.history().back().bending_energy).epsilon(1e-5));
}

TEST_CASE("a failing step says why and leaves the last good state", "[simulator]") {
    SECTION("fixed step") {
        Simulator<Quiescent<double>, axistokes::Vesicle<double>, ExplicitEuler> simulator(
            prolate(0.6, 48), Quiescent<double>{}, with_step(1e-3, 1000));
        Meridian<double> good = simulator.configuration().shape;
        const std::string message =
            failure([&] { simulator.run([&](const Record&) { good = simulator.configuration().shape; }); });
        const auto steps = simulator.history().size();
        CHECK(mentions(message, "step " + std::to_string(steps + 1) + " at time", "0.001", "is too large: "));
        CHECK(equal(simulator.configuration().shape, good));
        CHECK_NOTHROW(axistokes::validate(simulator.shape()));
        for (const Record& record : simulator.history()) {
            CHECK(std::isfinite(record.bending_energy));
            CHECK(record.dt == 1e-3);
        }
        // And again.
        CHECK(failure([&] { simulator.step(); }) == message);
        CHECK(simulator.history().size() == steps);
    }
    SECTION("automatic step") {
        Params params;
        params.first_time_step = 0.5;
        params.smallest_time_step = 0.5;
        Simulator<UnboundedPoiseuille<double>> simulator(prolate(0.6, 32), UnboundedPoiseuille<double>(50.0), params);
        const Meridian<double> start = simulator.configuration().shape;
        const std::string message = failure([&] { simulator.run(); });
        CHECK(mentions(message, "step 1 at time 0", "fell below 0.5", "would move by"));
        CHECK(equal(simulator.configuration().shape, start));
        CHECK(simulator.history().empty());
    }
}

TEST_CASE("a step without bound is a failure, not a hang", "[simulator]") {
    Simulator<Quiescent<double>> simulator(prolate(0.6, 16), Quiescent<double>{}, with_step(1e300, 10));
    CHECK(mentions(failure([&] { simulator.step(); }), "time step 1e+300", "is too large", "singular or not finite"));
}

TEST_CASE("the smallest step is one of the scene's time scale", "[simulator]") {
    // 1e9 times faster than its membrane relaxes.
    Params params;
    params.most_steps = 3;
    Simulator<Gravity<double>> simulator(prolate(0.6, 16), Gravity<double>(1e11), params);
    CHECK_NOTHROW(simulator.run());
    CHECK(simulator.time() > 0);
    CHECK(simulator.time() < 1e-9);
}

namespace {

/// A long step first, then short ones.
class Creep {
  public:
    explicit Creep(const axistokes::StepControlParams<double>&) {}
    double step() const { return dt_; }
    bool fixed() const { return false; }
    void judge(const axistokes::StepReport<double>&) const {}
    bool shorten(double) { return false; }
    void accept(const axistokes::StepReport<double>&, double, bool) { dt_ = 1e-9; }

  private:
    double dt_ = 1e-3;
};

}  // namespace

TEST_CASE("steps that come to no end are a failure", "[simulator]") {
    using Creeping = axistokes::Simulator<axistokes::FreeSpaceKernel<double>, axistokes::LinearElements<double>,
                                          axistokes::Vesicle<double>, Gravity<double>, SemiImplicitEuler,
                                          axistokes::DenseLU<double>, axistokes::NoWall, Creep>;
    Creeping simulator(prolate(0.6, 16), Gravity<double>(1.0));
    CHECK(mentions(failure([&] { simulator.run(); }), "step 502 at time", "the last 500 steps began at time 0.001",
                   "there is no end"));
    CHECK(simulator.history().size() == 501);
    // More elements are another matter.
    simulator.refine(20);
    CHECK_NOTHROW(simulator.step());
}

TEST_CASE("an evaluation that is stopped leaves the state as it was", "[simulator]") {
    int left = 5;
    Params params;
    params.proceed = [&] { return left-- > 0; };
    Simulator<Gravity<double>> simulator(prolate(0.6, 16), Gravity<double>(1.0), params);
    CHECK_THROWS_AS(simulator.run(), axistokes::SimulationStopped);
    const auto steps = simulator.history().size();
    CHECK(steps > 0);
    const Meridian<double> shape = simulator.configuration().shape;
    CHECK_THROWS_AS(simulator.step(), axistokes::SimulationStopped);
    CHECK(simulator.history().size() == steps);
    CHECK(equal(simulator.configuration().shape, shape));
    left = 1000;
    CHECK_NOTHROW(simulator.step());
}

TEST_CASE("an automatic step is cut down until it works", "[simulator]") {
    Params params;
    params.first_time_step = 1;
    params.most_steps = 5;
    Simulator<UnboundedPoiseuille<double>> simulator(prolate(0.6, 32), UnboundedPoiseuille<double>(20.0), params);
    Meridian<double> before = simulator.configuration().shape;
    simulator.run([&](const Record&) {
        const Meridian<double>& now = simulator.configuration().shape;
        CHECK(axistokes::distance(now, before) <= 2 * params.largest_displacement);
        before = now;
    });
    REQUIRE(simulator.history().size() == 5);
    CHECK(simulator.history()[0].rejected > 0);
    CHECK(simulator.history()[0].dt == std::pow(0.5, simulator.history()[0].rejected));
}

TEST_CASE("runs end when stationary, after most_steps, at longest_time, or when the observer says so", "[simulator]") {
    const auto start = prolate(0.3, 32);
    Params params = with_tolerance(1e-4);
    Simulator<Quiescent<double>> simulator(start, Quiescent<double>{}, params);
    CHECK(simulator.run());
    CHECK(simulator.stationary());
    CHECK(simulator.history().back().residual < 1e-4);
    CHECK(simulator.history()[simulator.history().size() - 2].residual >= 1e-4);

    params.most_steps = 3;
    Simulator<Quiescent<double>> few(start, Quiescent<double>{}, params);
    CHECK_FALSE(few.run());
    CHECK_FALSE(few.stationary());
    CHECK(few.history().size() == 3);
    CHECK_FALSE(few.run());
    CHECK(few.history().size() == 6);

    params.most_steps = 1000;
    params.longest_time = 0.01;
    Simulator<Quiescent<double>> brief(start, Quiescent<double>{}, params);
    CHECK_FALSE(brief.run());
    CHECK(brief.history().back().time == 0.01);
    CHECK(brief.history()[brief.history().size() - 2].time < 0.01);

    Simulator<Quiescent<double>> watched(start, Quiescent<double>{}, with_tolerance(1e-4));
    CHECK_FALSE(watched.run([](const Record& record) { return record.step < 2; }));
    CHECK(watched.history().size() == 2);
}

TEST_CASE("bad shapes and parameters are refused before anything runs", "[simulator]") {
    const auto refuse = [](const Meridian<double>& shape, const Params& params) {
        return refusal([&] { Simulator<Quiescent<double>>(shape, Quiescent<double>{}, params); });
    };
    Meridian<double> shape = prolate(0.6, 16);
    shape.r[3] = -1;
    CHECK(mentions(refuse(shape, {}), "r of meridian node 3", "-1", "> 0"));
    shape = prolate(0.6, 16);
    const double undefined = std::numeric_limits<double>::quiet_NaN();
    for (const double tolerance : {0.0, 1e-300, 1e-16, 1.0, undefined}) {
        CHECK(mentions(refuse(shape, with_tolerance(tolerance)), "stationarity tolerance", "=", "in [8 eps, 1)"));
    }
    CHECK(mentions(refuse(shape, with_step(-0.5, 10)), "time step", "-0.5", "> 0"));
    CHECK(mentions(refuse(shape, with_step(undefined, 10)), "time step", "nan", "> 0"));
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(mentions(refuse(shape, with_step(infinity, 10)), "time step", "inf", "> 0 and finite"));
    for (double Params::*member : {&Params::largest_time_step, &Params::step_tolerance, &Params::largest_displacement,
                                   &Params::largest_strain, &Params::growth}) {
        Params unbounded;
        unbounded.*member = infinity;
        CHECK(mentions(refuse(shape, unbounded), "", "inf", "finite"));
    }
    CHECK(mentions(refuse(shape, with_step(0.5, 0)), "number of steps", "0", "at least 1"));
    Params params;
    params.growth = 1;
    CHECK(mentions(refuse(shape, params), "growth of the time step", "1", "> 1"));
    params = {};
    params.first_time_step = 0.25;
    params.smallest_time_step = 0.5;
    CHECK(mentions(refuse(shape, params), "first time step", "0.25", "at least the smallest time step"));
    params = {};
    params.largest_time_step = 1e-4;
    CHECK(mentions(refuse(shape, params), "largest time step", "0.0001", "at least the first time step"));
    params = {};
    params.longest_time = -2;
    CHECK(mentions(refuse(shape, params), "longest time", "-2", "> 0"));
    params = {};
    params.largest_displacement = 0;
    CHECK(mentions(refuse(shape, params), "largest displacement", "0", "> 0"));
}
