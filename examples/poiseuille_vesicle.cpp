// SPDX-License-Identifier: MIT
// A vesicle on the axis of a Poiseuille flow: in a tube, or in the middle of one so wide that its walls do not matter.
#include "support/command_line.hpp"
#include "support/tube.hpp"
#include "support/vesicle_case.hpp"
#include "support/wall.hpp"

int main(int argc, char** argv) {
    examples::CommandLine app{
        "poiseuille_vesicle",
        "An axisymmetric vesicle in Poiseuille flow: u_z = Ca (1 - (L r)^2) in a tube (--capillary-number,\n"
        "--confinement), or -Ca_unb r^2 without walls (--unbounded-capillary-number)"};
    examples::VesicleOptions vesicle;
    vesicle.excess_area = 1.59;
    examples::RunOptions run;
    examples::TubeOptions tube;
    examples::WallOptions wall;
    std::optional<double> wall_tolerance;
    double capillary_number = 100;
    double unbounded_capillary_number = 0.5;
    vesicle.add_to(app);
    examples::Option bounded =
        app.number("--capillary-number", capillary_number, "Ca = eta u_max R0^2 / kappa of the flow in the tube");
    tube.add_to(app, "1/0.9");
    examples::Option unbounded = app.number("--unbounded-capillary-number", unbounded_capillary_number,
                                            "Ca_unb = eta c R0^4 / kappa of the flow -c r^2 without walls");
    wall.add_to(app);
    app.number("--wall-tolerance", wall_tolerance,
               "with --method wall: relative error allowed of the wall (default: 1e-5)");
    unbounded.excludes(bounded).excludes("--confinement").excludes("--method");
    run.add_to(app);

    return app.run(argc, argv, [&] {
        run.method.check();
        if (unbounded.given()) {
            const auto initial = [&](axistokes::Index elements) { return vesicle.shape(elements); };
            const axistokes::UnboundedPoiseuille<double> flow(unbounded_capillary_number);
            examples::VesicleCase c{run, initial, vesicle.excess_area, examples::Drive(flow), {}, 0, {}};
            c.parameters = {{"excess_area", vesicle.excess_area},
                            {"unbounded_capillary_number", unbounded_capillary_number}};
            return examples::run_vesicle(c);
        }
        tube.confinement = tube.confinement.value_or(1 / 0.9);
        const axistokes::Poiseuille<double> flow(capillary_number, tube.radius());
        const auto initial = [&](axistokes::Index elements) { return tube.shape(vesicle, elements); };
        examples::VesicleCase c{run, initial, vesicle.excess_area, examples::Drive(flow), {}, flow.mean_velocity(), {}};
        c.parameters = {{"excess_area", vesicle.excess_area},
                        {"capillary_number", capillary_number},
                        {"confinement", *tube.confinement},
                        {"method", wall.method}};
        c.surroundings.tube_radius = tube.radius();
        if (wall.meshed()) {
            const auto accuracy = run.method.accuracy();
            c.surroundings.wall = wall.params(wall_tolerance.value_or(accuracy ? accuracy->wall : 1e-5));
        }
        return examples::run_vesicle(c);
    });
}
