// SPDX-License-Identifier: MIT
// Stationary shapes on a spectral meridian in a tube: Newton and continuation against time marching, bullet and
// parachute, and the fold at the parachute's end.
#include "catch.hpp"
#include "stationary_support.hpp"
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_branch.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace {

using namespace axistokes;

using March = Simulator<TubeKernel<double>, SpectralMeridian<double>, Vesicle<double>, Poiseuille<double>,
                        SemiImplicitEuler, DenseLU<double>>;
using TubeScene = March::SceneType;
using Solver = StationarySolver<TubeScene>;
using Branch = StationaryBranch<TubeScene>;
using Path = Continuation<Branch>;

constexpr double kArea = 4 * 3.14159265358979324 + 0.9;
constexpr double kVolume = 4 * 3.14159265358979324 / 3;
constexpr double kConfinement = 0.3;

TubeScene scene(double confinement, double capillary_number) {
    return {TubeKernel<double>(1 / confinement),
            SpectralMeridian<double>(),
            {},
            Poiseuille<double>(capillary_number, 1 / confinement),
            {}};
}

March marched(double excess_area, double confinement, double capillary_number, SpheroidKind kind, Index elements) {
    SimulationParams<double> params;
    params.tolerance = 1e-8;
    const double radius = 1 / confinement;
    March march(shape_in_tube<double>(excess_area, radius, kind, elements),
                Poiseuille<double>(capillary_number, radius), params, TubeKernel<double>(radius));
    march.run();
    REQUIRE(march.stationary());
    return march;
}

void agrees_with_marching(double excess_area, double confinement, double capillary_number, Index elements) {
    const March march = marched(excess_area, confinement, capillary_number, SpheroidKind::prolate, elements);
    Solver newton(scene(confinement, capillary_number));
    const auto state =
        newton.solve(shape_in_tube<double>(excess_area, 1 / confinement, SpheroidKind::prolate, elements),
                     march.initial_area(), march.initial_volume());
    CHECK(state.residual < 1e-9);
    CHECK(10 * state.evaluations < static_cast<Index>(march.history().size()));
    CHECK(state.instant().velocity == Approx(march.history().back().velocity).epsilon(1e-6));
    CHECK(state.instant().pressure_drop == Approx(march.history().back().pressure_drop).epsilon(1e-5));
    CHECK(stationary::distance(state.configuration().shape, march.configuration().shape) < 1e-6);
    CHECK(newton.growth_rates(state).front().real() < 0);
}

TEST_CASE("Spectral Newton agrees with marching in a tube narrower than the vesicle") {
    agrees_with_marching(1.59, 1 / 0.9, 100, 48);
}

TEST_CASE("Spectral Newton agrees with marching in a wide tube") {
    agrees_with_marching(0.9, kConfinement, 1, 32);
}

TEST_CASE("Spectral Newton in a thin film, from the first shape, and its oscillating decay") {
    // As many as it takes for the two to have the same derivative: one of the equations, the other of the sums.
    constexpr Index kThin = 80;
    const double confinement = 1 / 0.62;
    const double area = 4 * detail::pi_value<double>() + 3.6;
    auto narrow = scene(confinement, 100);
    Solver newton(narrow);
    const auto state = newton.solve(shape_in_tube<double>(3.6, 0.62, SpheroidKind::prolate, kThin), area, kVolume);
    CHECK(state.residual < 1e-9);
    CHECK(narrow.film_thickness(state.configuration()).min < 0.05);
    const auto rate = newton.growth_rates(state).front();
    const auto by_differences = newton.growth_rates(state, 1e-5).front();
    CHECK(std::abs(rate.imag()) > 1);
    CHECK(rate.real() == Approx(by_differences.real()).epsilon(0.02));
    CHECK(std::abs(rate.imag()) == Approx(std::abs(by_differences.imag())).epsilon(0.01));
}

/// The state at Ca = 1 that a start leads to, and the branch through it in log Ca up to `last`.
struct Traced {
    double velocity = 0;
    double rear_curvature = 0;
    double parameter = 0;
    double fold = 0;
    double growth_at_fold = 1;
    double largest_residual = 0;
    double largest_growth_before = -1e300;
    double growth_after = 0;
    int folds = 0;
    Meridian<double> shape;
};

Traced trace(SpheroidKind kind, double last, bool print = false, Index elements = 24) {
    Solver newton(scene(kConfinement, 1));
    const auto start = newton.solve(shape_in_tube<double>(0.9, 1 / kConfinement, kind, elements), kArea, kVolume);
    Branch branch([](double log_ca) { return scene(kConfinement, std::exp(log_ca)); }, [](double) { return kArea; },
                  [](double) { return kVolume; });
    ContinuationParams<double> params;
    params.least_parameter = std::log(0.5);
    params.largest_parameter = std::log(last);
    params.parameter_scale = 2;
    Path path(branch, params);
    Traced traced;
    int after = 0;
    path.follow(branch.at(0, start.configuration().shape), 1, [&](const Path::Record& record) {
        const auto& state = record.point.state;
        const double rear = record.point.scene->discretization().pole_curvatures(state.configuration().shape).first;
        if (print) {
            std::printf("%9.5f  %.7f  %9.5f  %8.5f  %8.4f  %.1e  %.1e%s\n", std::exp(record.parameter),
                        state.instant().velocity / std::exp(record.parameter), record.growth, record.slope, rear,
                        record.residual, record.point.scene->discretization().unresolved(state.configuration().shape),
                        record.event == BranchEvent::fold ? "  fold" : "");
        }
        traced.largest_residual = std::max(traced.largest_residual, record.residual);
        if (record.event == BranchEvent::fold) {
            ++traced.folds;
            traced.fold = std::exp(record.parameter);
            traced.growth_at_fold = record.growth;
            return true;
        }
        if (traced.folds == 0) {
            traced.largest_growth_before = std::max(traced.largest_growth_before, record.growth);
        } else {
            traced.growth_after = record.growth;
            ++after;
        }
        traced.parameter = record.parameter;
        traced.velocity = state.instant().velocity;
        traced.shape = state.configuration().shape;
        traced.rear_curvature = rear;
        return after < 3;
    });
    return traced;
}

TEST_CASE("Continuation arrives where time marching does, on both branches") {
    for (const SpheroidKind kind : {SpheroidKind::prolate, SpheroidKind::oblate}) {
        const Traced traced = trace(kind, 10);
        CHECK(traced.parameter == Approx(std::log(10.0)).epsilon(1e-12));
        CHECK(traced.largest_residual < 1e-9);
        CHECK(traced.folds == 0);
        CHECK(traced.largest_growth_before < 0);
        CHECK((traced.rear_curvature > 0) == (kind == SpheroidKind::prolate));
        const March march = marched(0.9, kConfinement, 10, kind, 24);
        CHECK(traced.velocity == Approx(march.history().back().velocity).epsilon(1e-6));
        CHECK(stationary::distance(traced.shape, march.configuration().shape) < 1e-5);
    }
}

TEST_CASE("The bullet's rear turns concave without a fold") {
    const Traced traced = trace(SpheroidKind::prolate, 60);
    CHECK(traced.folds == 0);
    CHECK(traced.largest_growth_before < 0);
    CHECK(traced.rear_curvature < -0.5);
    const March march = marched(0.9, kConfinement, 60, SpheroidKind::prolate, 24);
    CHECK(traced.velocity == Approx(march.history().back().velocity).epsilon(1e-5));
}

TEST_CASE("The parachute ends in a fold") {
    const Traced traced = trace(SpheroidKind::oblate, 40);
    REQUIRE(traced.folds == 1);
    CHECK(traced.largest_growth_before < 0);
    CHECK(std::abs(traced.growth_at_fold) < 0.01);
    CHECK(traced.growth_after > 0);
    // Below the fold the parachute stays, above it the vesicle ends as a bullet.
    const auto rear_curvature_at = [&](double capillary_number) {
        const March march = marched(0.9, kConfinement, capillary_number, SpheroidKind::oblate, 24);
        return march.scene().discretization().pole_curvatures(march.configuration().shape).first;
    };
    CHECK(rear_curvature_at(0.98 * traced.fold) < -0.5);
    CHECK(rear_curvature_at(1.02 * traced.fold) > 0.5);

    // The last state is one of the unstable branch: Newton finds it, but does not stay there unless it may.
    const auto found = [&](bool only_stable) {
        StationaryParams<double> params;
        params.only_stable = only_stable;
        Solver newton(scene(kConfinement, std::exp(traced.parameter)), params);
        auto state = newton.solve(traced.shape, kArea, kVolume);
        const double growth = newton.growth_rates(state).front().real();
        return std::pair(state.instant().velocity, growth);
    };
    const auto [unstable_velocity, unstable_growth] = found(false);
    CHECK(unstable_velocity == Approx(traced.velocity).epsilon(1e-7));
    CHECK(unstable_growth == Approx(traced.growth_after).epsilon(0.02));
    const auto [stable_velocity, stable_growth] = found(true);
    CHECK(std::abs(stable_velocity / traced.velocity - 1) > 1e-4);
    CHECK(stable_growth < 0);
}

TEST_CASE("Both branches, printed", "[.report]") {
    std::printf("Ca  U/Ca  growth  slope  rear curvature  residual  unresolved\n");
    CHECK(trace(SpheroidKind::prolate, 200, true, 32).folds == 0);
    CHECK(trace(SpheroidKind::oblate, 200, true, 32).folds == 1);
}

}  // namespace
