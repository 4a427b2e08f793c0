// SPDX-License-Identifier: MIT
// A vesicle is carried through a channel that narrows to less than its rest radius.
#include "support/command_line.hpp"
#include "support/passage_case.hpp"

void examples::PassageOptions::add_to(CommandLine& app) {
    app.text("--profile", profile, "constriction (smooth) or pore (a straight throat)");
    app.number("--throat", throat, "radius of the throat, in R0");
    app.number("--wide", wide, "radius of the channel on either side");
    app.number("--length", length, "length of a pore's throat");
    app.number("--transition", transition, "length of the narrowing, and of the widening behind");
    app.number("--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2");
    app.number("--flow-rate", flow_rate, "flow rate, in R0 kappa/eta, > 0");
    app.number("--tolerance", wall_tolerance, "relative error allowed of the wall (default: by the preset, 1e-3)");
    app.number("--displacement", displacement,
               "largest normal displacement in a time step, in R0, by integrators without an error estimate");
    app.number("--step-tolerance", step_tolerance,
               "error allowed in a time step, in R0, by integrators with one (default: by the preset, 2.5e-4)");
    app.number("--elements", elements,
               "elements, or modes, on the meridian (default: linear 80; spectral as many as it takes, from 48 on)");
    method.add_to(app);
    app.number("--max-steps", most_steps, "give up after this many steps");
    app.number("--frames", frames, "shapes to keep, evenly along the way");
    app.text("--out", directory, "directory for summary.json, shape.csv, history.csv, frames.csv and wall.csv");
    app.resumable(directory, checkpoints);
}

int main(int argc, char** argv) {
    examples::CommandLine app{"vesicle_through_constriction",
                              "A vesicle is carried through a channel that narrows to less than its rest radius"};
    examples::PassageOptions options;
    options.add_to(app);
    return app.run(argc, argv, [&] {
        options.check();
        return examples::pass(options);
    });
}
