// SPDX-License-Identifier: MIT
// A vesicle on the axis of a Poiseuille flow: in a tube, or in the middle of one so wide that its walls do not matter.
#include "support/run.hpp"
#include "support/tube.hpp"
#include "support/wall.hpp"
#include <axistokes/axistokes.hpp>

int main(int argc, char** argv) {
    using namespace axistokes;
    using InTube = Simulator<TubeKernel<double>, LinearElements<double>, Vesicle<double>, Poiseuille<double>,
                             SemiImplicitEuler, DenseLU<double>>;
    using BetweenWalls = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Poiseuille<double>,
                                   SemiImplicitEuler, DenseLU<double>, WallMesh<StraightTube<double>>>;
    using Unbounded = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>,
                                UnboundedPoiseuille<double>, SemiImplicitEuler, DenseLU<double>>;

    CLI::App app{
        "An axisymmetric vesicle in Poiseuille flow: u_z = Ca (1 - (L r)^2) in a tube (--capillary-number,\n"
        "--confinement), or -Ca_unb r^2 without walls (--unbounded-capillary-number)"};
    examples::VesicleOptions vesicle;
    vesicle.excess_area = 1.59;
    examples::RunOptions run;
    examples::TubeOptions tube;
    examples::WallOptions wall;
    double wall_tolerance = 1e-5;
    double capillary_number = 100;
    double unbounded_capillary_number = 0.5;
    vesicle.add_to(app);
    CLI::Option* bounded = examples::add_number(app, "--capillary-number", capillary_number,
                                                "Ca = eta u_max R0^2 / kappa of the flow in the tube");
    tube.add_to(app, "1/0.9");
    CLI::Option* unbounded = examples::add_number(app, "--unbounded-capillary-number", unbounded_capillary_number,
                                                  "Ca_unb = eta c R0^4 / kappa of the flow -c r^2 without walls");
    wall.add_to(app);
    examples::add_number(app, "--wall-tolerance", wall_tolerance,
                         "with --method wall: relative error allowed of the wall");
    unbounded->excludes(bounded)->excludes("--confinement")->excludes("--method");
    run.add_to(app);

    return examples::run_program("poiseuille_vesicle", app, argc, argv, [&] {
        const auto params = run.params();
        if (unbounded->count() > 0) {
            Unbounded simulator(vesicle.shape(run.elements), UnboundedPoiseuille<double>(unbounded_capillary_number),
                                params);
            return examples::run_to_end(
                simulator, run,
                {{"excess_area", vesicle.excess_area}, {"unbounded_capillary_number", unbounded_capillary_number}});
        }
        tube.confinement = tube.confinement.value_or(1 / 0.9);
        const Poiseuille<double> flow(capillary_number, tube.radius());
        const auto run_in_tube = [&](auto simulator) {
            return examples::run_to_end(
                simulator, run,
                {{"excess_area", vesicle.excess_area}, {"capillary_number", capillary_number}, {"method", wall.method}},
                [&](const auto& s, const auto&) { return examples::tube_summary(s, flow.mean_velocity()); });
        };
        const auto shape = tube.shape(vesicle, run.elements);
        if (wall.meshed()) {
            return run_in_tube(BetweenWalls(shape, flow, params, {}, LinearElements<double>{}, {}, {}, {},
                                            WallMesh(StraightTube(tube.radius()), wall.params(wall_tolerance))));
        }
        return run_in_tube(InTube(shape, flow, params, TubeKernel<double>(tube.radius())));
    });
}
