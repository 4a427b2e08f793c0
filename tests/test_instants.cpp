// SPDX-License-Identifier: MIT
// A row of the history is one instant, whatever the integrator and the wall; and the force of an instant is all of it.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/io/wall_stress.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>
#include <axistokes/wall/wall_mesh.hpp>

#include <cmath>

namespace {

using namespace axistokes;

constexpr double kRadius = 1.25;

SimulationParams<double> until(double time, double dt) {
    SimulationParams<double> params;
    params.time_step = dt;
    params.longest_time = time;
    return params;
}

template <class Kernel, class Wall>
auto passing(int order, double dt, const Kernel& kernel, const Wall& wall) {
    return Simulator<Kernel, LinearElements<double>, Vesicle<double>, Poiseuille<double>, ExtrapolatedEulerOfOrder,
                     DenseLU<double>, Wall>(Scene(kernel, LinearElements<double>(), Vesicle<double>(),
                                                  Poiseuille<double>(50, kRadius), DenseLU<double>(), wall),
                                            ExtrapolatedEulerOfOrder(order),
                                            shape_in_tube<double>(1.5, kRadius, SpheroidKind::prolate, 32),
                                            until(0.012, dt));
}

WallMesh<StraightTube<double>> mesh() {
    WallMeshParams<double> params;
    params.tolerance = 1e-4;
    return WallMesh<StraightTube<double>>(StraightTube<double>(kRadius), params);
}

}  // namespace

TEST_CASE("A row's velocity, residual and pressure drop are those of the shape it describes") {
    for (const int order : {1, 3}) {
        auto simulator = passing(order, 2e-3, FreeSpaceKernel<double>(), mesh());
        for (int k = 0; k < 3; ++k) {
            const auto record = simulator.step();
            auto scene = simulator.scene();
            const auto instant = scene.evaluate(simulator.configuration(), 0.0);
            CHECK(record.velocity == Approx(instant.velocity).epsilon(1e-12));
            CHECK(record.pressure_drop == Approx(instant.pressure_drop).epsilon(1e-10));
            CHECK(record.residual * 50 == Approx(instant.deformation_rate).epsilon(1e-8));
        }
    }
}

TEST_CASE("The history of the pressure drop does not depend on the order of the steps") {
    auto euler = passing(1, 1e-4, FreeSpaceKernel<double>(), mesh());
    euler.run();
    const double expected = euler.history().back().pressure_drop;
    for (int order = 2; order <= 6; ++order) {
        auto simulator = passing(order, 4e-3, FreeSpaceKernel<double>(), mesh());
        simulator.run();
        INFO("order " << order);
        CHECK(simulator.history().back().time == Approx(0.012));
        CHECK(simulator.history().back().pressure_drop == Approx(expected).epsilon(2e-3));
        // And the wall's is the tube kernel's.
        auto tube = passing(order, 4e-3, TubeKernel<double>(kRadius), NoWall());
        tube.run();
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(simulator.history()[k].pressure_drop == Approx(tube.history()[k].pressure_drop).epsilon(1e-3));
        }
    }
}

TEST_CASE("A vesicle without excess area adds the pressure drop of a rigid sphere") {
    const auto shape = SpectralMeridian<double>().redistributed(sphere<double>(64), 32);
    const auto drop = [&](const auto& law) {
        Scene scene(TubeKernel<double>(2), SpectralMeridian<double>(), law, Poiseuille<double>(10, 2),
                    DenseLU<double>());
        return scene.evaluate(Configuration<double>{shape, 0.0, {}}, 0.0).pressure_drop;
    };
    CHECK(drop(Vesicle<double>()) == Approx(drop(RigidBody<double>())).epsilon(1e-4));
    CHECK(drop(RigidBody<double>()) == Approx(1.3046).epsilon(1e-4));
}

TEST_CASE("Along the wall the pressure falls by what the flow and the particle ask for") {
    const double radius = 2;
    Scene scene(TubeKernel<double>(radius), SpectralMeridian<double>(), RigidBody<double>(),
                Poiseuille<double>(10, radius), DenseLU<double>());
    const Configuration<double> sphere_here{SpectralMeridian<double>().redistributed(sphere<double>(64), 32), 0.0, {}};
    const auto instant = scene.evaluate(sphere_here, 0.0);
    const auto wall = wall_stress(scene, sphere_here, instant, 4 * radius);
    const double undisturbed = 4 * 10 / (radius * radius);  // of the pressure's slope
    const double length = wall.z[wall.z.size() - 1] - wall.z[0];
    CHECK(wall.pressure[0] == Approx(undisturbed * length + instant.pressure_drop).epsilon(1e-5));
    // Far away the shear stress is the undisturbed one.
    CHECK(wall.shear[0] == Approx(undisturbed * radius / 2).epsilon(1e-4));
    // The whole force on the wall balances the pressure on the ends: a free particle carries none.
    double pull = 0;
    for (Index j = 0; j + 1 < wall.z.size(); ++j) {
        pull += (wall.shear[j] + wall.shear[j + 1]) / 2 * (wall.z[j + 1] - wall.z[j]);
    }
    CHECK(2 * pull / radius == Approx(wall.pressure[0]).epsilon(1e-4));
    CHECK(test::mentions(test::refusal([&] {
                             Scene open(FreeSpaceKernel<double>(), SpectralMeridian<double>(), RigidBody<double>(),
                                        Poiseuille<double>(10, radius), DenseLU<double>());
                             wall_stress(open, sphere_here, instant, 1.0);
                         }),
                         "tube radius", "inf", "finite"));
}

TEST_CASE("What happens deep inside a run is a failure of the simulation, not a bad argument") {
    // The curve between the nodes, too, must keep clear of the axis and of the wall.
    Scene scene(TubeKernel<double>(1.02), LinearElements<double>(), Vesicle<double>(), Poiseuille<double>(10, 1.02),
                DenseLU<double>());
    const Meridian<double> beyond = sphere<double>(24, 1.1);
    CHECK(test::failure([&] { scene.evaluate(Configuration<double>{beyond, 0.0, {}}, 0.0); }) != "nothing was thrown");
    CHECK(scene.fault({beyond, 0.0, {}}).find("crosses the wall") != std::string::npos);
}

TEST_CASE("The flow is that of the scene's tube, whose radius is given once") {
    const TubeKernel tube(kRadius);
    const Poiseuille flow(50.0, tube);
    CHECK(flow.velocity({kRadius, 0.0}).z == 0);
    CHECK(flow.velocity({kRadius / 2, 0.0}).z == Approx(37.5));
    CHECK(Poiseuille(50.0, mesh()).velocity({kRadius, 0.0}).z == 0);
    const auto shape = shape_in_tube(1.5, tube, SpheroidKind::prolate, 32);
    CHECK((shape.z - shape_in_tube(1.5, kRadius, SpheroidKind::prolate, 32).z).norm() == 0);
    const auto of_another = [](const auto& kernel, const auto& wall) {
        return axistokes::test::refusal([&] {
            Scene(kernel, LinearElements<double>(), Vesicle<double>(), Poiseuille<double>(50, 2 * kRadius),
                  DenseLU<double>(), wall);
        });
    };
    CHECK(axistokes::test::mentions(of_another(tube, NoWall()), "undisturbed velocity on the wall", "37.5", "0"));
    CHECK(axistokes::test::mentions(of_another(FreeSpaceKernel<double>(), mesh()), "undisturbed velocity on the wall",
                                    "37.5", "0"));
    // Without walls it is any flow.
    CHECK_NOTHROW(
        Scene(FreeSpaceKernel<double>(), LinearElements<double>(), Vesicle<double>(), flow, DenseLU<double>()));
}
