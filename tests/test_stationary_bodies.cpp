// SPDX-License-Identifier: MIT
// Stationary states of several bodies, found directly.
#include "catch.hpp"
#include "stationary_support.hpp"
#include <axistokes/accuracy/resolution.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;

/// The potential flow with u_z = b z - a z^3 on the axis: bodies come to rest near z = -sqrt(b/a), 0 and sqrt(b/a), of
/// which the outer places are stable.
class Trap {
  public:
    using Scalar = double;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;

    Trap(double b, double a) : b_(b), a_(a) {}

    Point<double> velocity(const Point<double>& x) const {
        return {-b_ * x.r / 2 + a_ * (1.5 * x.z * x.z * x.r - 0.375 * x.r * x.r * x.r),
                b_ * x.z - a_ * (x.z * x.z * x.z - 1.5 * x.z * x.r * x.r)};
    }
    double normal_load(const Point<double>&) const { return 0; }
    double velocity_scale() const { return b_; }

  private:
    double b_, a_;
};

using Law = OneOf<Vesicle<double>, RigidBody<double>>;
using Discretization = SpectralMeridian<double>;
using SceneType = Scene<FreeSpaceKernel<double>, Discretization, Law, Trap, DenseLU<double>>;
using Point_ = detail::StationaryPoint<SceneType>;

const Discretization discretization;

Meridian<double> centred(SpheroidKind kind, double excess_area, Index elements) {
    auto shape = nodes_of(
        discretization, [&](Index n) { return spheroid_of_excess_area<double>(excess_area, kind, n); }, elements);
    shape.z.array() -= discretization.measures(shape).centroid;
    return shape;
}
Meridian<double> ball(Index elements) {
    return nodes_of(
        discretization, [](Index n) { return sphere<double>(n); }, elements);
}

SceneType scene_of(std::vector<Law> laws) {
    return SceneType(FreeSpaceKernel<double>(), discretization, std::move(laws), Trap(2, 0.5), DenseLU<double>());
}

TEST_CASE("The Jacobian of vesicles and a sphere is that of differences") {
    SceneType scene = scene_of({Vesicle<double>(), RigidBody<double>(), Vesicle<double>()});
    constexpr Index elements = 40;
    Point_ point;
    point.bodies = {{centred(SpheroidKind::prolate, 0.6, elements), -2.7, {}},
                    {ball(elements), 0.1, {}},
                    {centred(SpheroidKind::oblate, 0.4, elements), 2.2, {}}};
    detail::evaluate(scene, point);
    const Matrix<double> jacobian = detail::VelocityJacobian<SceneType>(scene, point, true)();
    const detail::StationaryLayout layout(scene, point.bodies);
    const auto velocity = [&](const Vector<double>& displacement) {
        Point_ moved;
        moved.bodies = detail::displaced(scene, point, displacement);
        detail::evaluate(scene, moved);
        return moved.velocity;
    };
    // The derivative of the mobility is that of the integral equation, the differences those of its discretization:
    // they agree on displacements that the nodes resolve.
    std::vector<Vector<double>> displacements;
    std::vector<std::size_t> owners;
    for (std::size_t b = 0; b < 3; ++b) {
        if (scene.deforms(b)) {
            for (Index k = 0; k <= elements / 4; ++k) {
                Vector<double> mode = Vector<double>::Zero(layout.all());
                for (Index i = 0; i <= elements; ++i) {
                    mode[layout.unknowns[b] + i] =
                        std::cos(detail::pi_value<double>() * double(k * i) / double(elements));
                }
                displacements.push_back(mode);
                owners.push_back(b);
            }
        }
        if (const auto along = detail::translation(scene, point, b); along.exists()) {
            displacements.push_back(Vector<double>::Zero(layout.all()));
            displacements.back().segment(layout.unknowns[b], along.unknowns.size()) = along.unknowns;
            owners.push_back(b);
        }
    }
    constexpr double step = 1e-5;
    for (std::size_t k = 0; k < displacements.size(); ++k) {
        const Vector<double>& along = displacements[k];
        const Vector<double> expected = (velocity(step * along) - velocity(-step * along)) / (2 * step);
        const Vector<double> wrong = jacobian * along - expected;
        for (std::size_t b = 0; b < 3; ++b) {
            // How bodies push each other along is small among what else their neighbours' membranes do.
            INFO("body " << b << " by displacement " << k << " of body " << owners[k]);
            const auto part = [&](const Vector<double>& v) {
                return v.segment(layout.unknowns[b], layout.unknowns[b + 1] - layout.unknowns[b]).norm();
            };
            CHECK(part(wrong) < 3e-4 * part(expected) + 1e-9 * expected.norm());
        }
    }
}

TEST_CASE("A vesicle and a sphere at rest in a trap: Newton's method finds what marching ends with") {
    constexpr Index elements = 28;  // the same state, wherever its nodes are
    SimulationParams<double> params;
    params.tolerance = 1e-9;
    Simulator march(scene_of({RigidBody<double>(), Vesicle<double>()}), SemiImplicitEuler(),
                    std::vector<Meridian<double>>{detail::shifted(ball(elements), -2.0),
                                                  detail::shifted(centred(SpheroidKind::prolate, 0.6, elements), 2.0)},
                    params);
    march.run();
    REQUIRE(march.stationary());
    CHECK(std::abs(march.history(0).back().velocity) < 1e-6);  // both have come to rest, not only to each other
    const auto measures = [&](std::size_t b) {
        return Measures<double>{march.initial_area(b), march.initial_volume(b), 0};
    };

    StationarySolver newton(march.scene());
    auto start = march.state();
    start[1].position += 0.3;
    start[1].shape = centred(SpheroidKind::oblate, 0.3, elements);
    const auto state = newton.solve(start, {measures(0), measures(1)});
    CHECK(state.residual < 1e-9);
    CHECK(state.configuration(0).position == Approx(start[0].position).epsilon(1e-12));
    CHECK(state.configuration(1).position == Approx(march.configuration(1).position).epsilon(1e-6));
    CHECK(stationary::distance(state.configuration(1).shape, march.configuration(1).shape) < 1e-6);
    CHECK(state.instant(1).velocity == Approx(state.instant(0).velocity).margin(1e-8));
    CHECK(state.evaluations < static_cast<Index>(march.history().size()));

    // The slowest disturbance moves the bodies apart.
    const double rate = newton.growth_rates(state).front().real();
    CHECK(rate < 0);
    CHECK(rate == Approx(newton.growth_rates(state, 1e-5).front().real()).epsilon(1e-3));
}

TEST_CASE("As many measures as bodies, which must not meet") {
    StationarySolver newton(scene_of({Vesicle<double>()}));
    const auto shape = centred(SpheroidKind::prolate, 0.6, 20);
    const auto measures = discretization.measures(shape);
    CHECK_THROWS_AS(newton.solve({{shape, -2, {}}, {shape, 2, {}}}, {measures}), InvalidArgument);
    CHECK_THROWS_AS(newton.solve({}, {}), InvalidArgument);
    CHECK_THROWS_AS(newton.solve({{shape, 0, {}}, {shape, 0.5, {}}}, {measures, measures}), SimulationFailure);
}

}  // namespace
