// SPDX-License-Identifier: MIT
// A vesicle, heavier than the fluid, settles along its axis until it is stationary, in an unbounded fluid or in a tube.
#include "support/command_line.hpp"
#include "support/tube.hpp"
#include "support/vesicle_case.hpp"

int main(int argc, char** argv) {
    examples::CommandLine app{
        "settling_vesicle",
        "An axisymmetric vesicle settles under gravity (along -z), in an unbounded fluid or along a tube"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    examples::TubeOptions tube;
    double bond = 47;
    vesicle.add_to(app);
    app.number("--bond", bond, "Bond number B0 = (rho_in - rho_out) g R0^4 / kappa (< 0: rises)");
    tube.add_to(app, "the fluid is unbounded");
    run.add_to(app);

    return app.run(argc, argv, [&] {
        run.method.check();
        const auto initial = [&](axistokes::Index elements) {
            return tube.confinement ? tube.shape(vesicle, elements) : vesicle.shape(elements);
        };
        examples::VesicleCase c{
            run, initial, vesicle.excess_area, examples::Drive(axistokes::Gravity<double>(bond)), {}, 0, {}};
        c.parameters = {{"excess_area", vesicle.excess_area}, {"bond", bond}};
        if (tube.confinement) {
            c.surroundings.tube_radius = tube.radius();
            c.parameters["confinement"] = *tube.confinement;
        }
        return examples::run_vesicle(c);
    });
}
