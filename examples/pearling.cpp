// SPDX-License-Identifier: MIT
// A very heavy vesicle pulls a tube so thin, and under such a tension, that it breaks up into pearls (Trozzo et al.
// 2015, Fig. 9).
#include "support/command_line.hpp"
#include "support/neck.hpp"
#include "support/vesicle_case.hpp"

namespace {

nlohmann::ordered_json describe(const examples::VesicleEnd& end) {
    const auto& shape = end.shape;
    const double top = shape.z[shape.nodes() - 1];
    nlohmann::ordered_json keys{{"height", top - shape.z[0]}, {"tether_length", 0.0}, {"pearls", 0}};
    if (const auto neck = examples::tube_neck(shape)) {
        keys["tether_length"] = top - shape.z[*neck];
        keys["tether_radius"] = shape.r[*neck];
        keys["pearls"] = examples::pearls_above(shape, *neck, 1.2);
        if (end.tension.size() > 0) {
            // Above 3/2 a tube is unstable.
            keys["tension_over_bending"] = end.tension[*neck] * shape.r[*neck] * shape.r[*neck];
        }
    }
    return keys;
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"pearling",
                              "A very heavy vesicle pulls a thin tube, which breaks up into pearls (Fig. 9); "
                              "until\ntime 0.0056, if no other is given"};
    examples::VesicleOptions vesicle;
    vesicle.excess_area = 0.73;
    examples::RunOptions run;
    run.method.usual_discretization = "adaptive";
    run.method.preset = "fast";
    double bond = 9320;
    vesicle.add_to(app);
    app.number("--bond", bond, "Bond number B0 = (rho_in - rho_out) g R0^4 / kappa");
    run.add_to(app);

    return app.run(argc, argv, [&] {
        run.method.check();
        run.time = run.time.value_or(0.0056);
        if (!run.step_tolerance) {
            // What is unstable magnifies the errors of all steps before.
            run.step_tolerance = run.method.accuracy()->step / 10;
        }
        if (!app.given("--frame-times")) {
            for (const double part : {0.0, 0.55, 0.8, 0.9, 0.95, 1.0}) {
                run.frame_times.push_back(part * *run.time);
            }
        }
        const auto initial = [&](axistokes::Index elements) { return vesicle.shape(elements); };
        examples::VesicleCase c{
            run, initial, vesicle.excess_area, examples::Drive(axistokes::Gravity<double>(bond)), {}, 0, {}, describe};
        c.parameters = {{"excess_area", vesicle.excess_area}, {"bond", bond}};
        return examples::run_vesicle(c);
    });
}
