// SPDX-License-Identifier: MIT
// A vesicle is carried through a channel that narrows to less than its rest radius.
#include "support/command_line.hpp"
#include "support/passage_case.hpp"

void examples::PassageOptions::add_to(CLI::App& app) {
    app.add_option("--profile", profile, "constriction (smooth) or pore (a straight throat)")->capture_default_str();
    add_number(app, "--throat", throat, "radius of the throat, in R0");
    add_number(app, "--wide", wide, "radius of the channel on either side");
    add_number(app, "--length", length, "length of a pore's throat");
    add_number(app, "--transition", transition, "length of the narrowing, and of the widening behind");
    add_number(app, "--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2");
    add_number(app, "--flow-rate", flow_rate, "flow rate, in R0 kappa/eta, > 0");
    add_number(app, "--tolerance", wall_tolerance, "relative error allowed of the wall (default: by the preset, 1e-3)");
    add_number(app, "--displacement", displacement,
               "largest normal displacement in a time step, in R0, by integrators without an error estimate");
    add_number(app, "--step-tolerance", step_tolerance,
               "error allowed in a time step, in R0, by integrators with one (default: by the preset, 2.5e-4)");
    add_number(app, "--elements", elements,
               "elements, or modes, on the meridian (default: linear 80; spectral as many as it takes, from 48 on)");
    method.add_to(app);
    add_number(app, "--max-steps", most_steps, "give up after this many steps");
    add_number(app, "--frames", frames, "shapes to keep, evenly along the way");
    app.add_option("--out", directory, "directory for summary.json, shape.csv, history.csv, frames.csv and wall.csv");
}

int main(int argc, char** argv) {
    CLI::App app{"A vesicle is carried through a channel that narrows to less than its rest radius"};
    examples::PassageOptions options;
    options.add_to(app);
    return examples::run_program("vesicle_through_constriction", app, argc, argv, [&] {
        options.check();
        return examples::pass(options);
    });
}
