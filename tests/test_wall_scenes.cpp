// SPDX-License-Identifier: MIT
// A meshed wall in scenes as they are used: flow fields on a grid longer than the mesh, and a spectral particle.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/axistokes.hpp>
#include <axistokes/io/flow_field.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace axistokes;
using Tube = WallMesh<StraightTube<double>>;

WallMeshParams<double> to_tolerance(double tolerance) {
    WallMeshParams<double> params;
    params.tolerance = tolerance;
    return params;
}

TubeKernel<double> tube_kernel(double radius, double tolerance) {
    TubeKernel<double>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<double>(radius, params);
}

template <class SceneType>
FlowField<double> field_of(SceneType scene, const Meridian<double>& shape, const FlowGrid<double>& grid) {
    const Configuration<double> configuration{shape, 0.4, {}};
    return flow_field(scene, configuration, scene.evaluate(configuration, 0), grid);
}

template <class Kernel, class Wall>
double drag_factor(const Kernel& kernel, const Wall& wall, Index n) {
    Meridian<double> body{Vector<double>(n + 1), Vector<double>(n + 1)};
    for (Index i = 0; i <= n; ++i) {
        const double t = test::pi * static_cast<double>(i) / static_cast<double>(n);
        body.r[i] = i == 0 || i == n ? 0.0 : std::sin(t);
        body.z[i] = -std::cos(t);
    }
    Scene<Kernel, SpectralMeridian<double>, RigidBody<double>, Gravity<double>, DenseLU<double>, Wall> scene(
        kernel, SpectralMeridian<double>(), {}, Gravity<double>(4.5), {}, wall);
    return -1 / scene.evaluate({body, 0.0, {}}, 0).velocity;
}

}  // namespace

TEST_CASE("The flow around a sphere in a meshed tube is that of the tube kernel on the whole grid") {
    const double radius = 1.25;
    const double tolerance = 1e-4;
    const Meridian<double> body = sphere<double>(30);
    const LinearElements<double> elements;
    const Gravity<double> gravity(4.5);
    FlowGrid<double> grid;
    grid.radius = radius;
    grid.half_length = 4;
    grid.columns = 6;
    grid.rows = 17;
    // The wall brings the flow: beyond the ends of its mesh there would be none.
    WallMeshParams<double> params = to_tolerance(tolerance);
    params.flow_rate = test::pi * radius * radius / 2;
    const FlowField<double> meshed = field_of(
        Scene<FreeSpaceKernel<double>, LinearElements<double>, RigidBody<double>, Gravity<double>, DenseLU<double>,
              Tube>({}, elements, {}, gravity, {}, Tube(StraightTube<double>(radius), params)),
        body, grid);
    const Sum flow(Poiseuille<double>(1.0, radius), gravity);
    const FlowField<double> exact = field_of(
        Scene<TubeKernel<double>, LinearElements<double>, RigidBody<double>, Sum<Poiseuille<double>, Gravity<double>>,
              DenseLU<double>>(tube_kernel(radius, 1e-8), elements, {}, flow, {}),
        body, grid);
    REQUIRE(meshed.velocity_z.size() == exact.velocity_z.size());
    const double scale = exact.velocity_z.cwiseAbs().maxCoeff();
    CHECK((meshed.velocity_z - exact.velocity_z).cwiseAbs().maxCoeff() < 2 * tolerance * scale);
    CHECK((meshed.velocity_r - exact.velocity_r).cwiseAbs().maxCoeff() < 2 * tolerance * scale);
    CHECK(meshed.velocity_z[0] == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("A mesh of its own for flow fields reaches as far as asked, whatever mesh the scene has") {
    WallMeshParams<double> params = to_tolerance(1e-3);
    params.grading = WallGrading::uniform;
    params.panels = 6;
    params.length = 1.0;
    Tube wall = Tube(StraightTube<double>(1.5), params).reaching(5.0);
    const Meridian<double> body = sphere<double>(20);
    wall.field(LinearElements<double>(), FreeSpaceKernel<double>(), body, Vector<double>::Zero(2 * body.nodes()));
    CHECK(wall.mesh()->upper() > 6.0);
    CHECK(wall.mesh()->lower() < -6.0);
}

TEST_CASE("A spectral sphere in a meshed tube has the exact drag") {
    // Haberman & Sayre's series, for a radius ratio of 0.5; nine digits.
    constexpr double kExact = 5.947374246;
    for (const double tolerance : {1e-4, 1e-7}) {
        const double by_wall =
            drag_factor(FreeSpaceKernel<double>(), Tube(StraightTube<double>(2.0), to_tolerance(tolerance)), 20);
        INFO("tolerance " << tolerance);
        CHECK(by_wall == Approx(kExact).epsilon(tolerance));
    }
    CHECK(drag_factor(tube_kernel(2.0, 1e-9), NoWall{}, 20) == Approx(kExact).epsilon(1e-7));
}
