// SPDX-License-Identifier: MIT
// A rigid spheroid that translates along its axis: its drag, in an unbounded fluid against the analytic one, or in a
// tube; or, in Poiseuille flow, its velocity.
#include "support/body_case.hpp"
#include "support/command_line.hpp"
#include "support/tube.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace {

/// Force over velocity, in eta R0, of a spheroid with semi-axes a (equatorial) and c (polar). With k = 1 - (a/c)^2 the
/// integrals of Oberbeck's ellipsoid (Happel & Brenner 1983, section 5-11) become
///   16 pi / (chi + c^2 alpha),  chi + c^2 alpha = (2/c) Int_0^1 (1 + y^2)/(1 - k y^2) dy.
double analytic_drag(double a, double c) {
    const double k = (c - a) * (c + a) / (c * c);
    double integral = 0;
    if (std::abs(k) < 0.05) {
        double power = 1;
        for (int n = 0; std::abs(power) > 1e-18; ++n) {
            integral += power * (1.0 / (2 * n + 1) + 1.0 / (2 * n + 3));
            power *= k;
        }
    } else {
        const double e = std::sqrt(std::abs(k));
        const double t = (k > 0 ? std::log((1 + e) * c / a) : std::atan(e)) / e;  // Int_0^1 dy/(1 - k y^2)
        integral = ((1 + k) * t - 1) / k;
    }
    return 8 * std::numbers::pi * c / integral;
}

}  // namespace

int main(int argc, char** argv) {
    using axistokes::Index;
    examples::CommandLine app{
        "spheroid_drag",
        "A rigid spheroid of volume 4 pi/3 on the axis of an unbounded fluid or a tube: its drag, or, with --flow\n"
        "poiseuille, its velocity when it floats freely"};
    examples::RunOptions run;
    examples::TubeOptions tube;
    double aspect = 2;
    std::string flow = "none";
    app.number("--aspect", aspect, "polar over equatorial semi-axis (> 1: prolate)");
    tube.add_to(app, "the fluid is unbounded");
    examples::Option floats =
        app.text("--flow", flow, "none: it is dragged along; poiseuille (in a tube): it floats freely");
    floats.needs("--confinement");
    app.number("--elements", run.elements,
               "elements, or modes, on the meridian (default: spectral 32, linear 64; with --preset-accuracy as many "
               "as it takes)");
    run.method.add_to(app, true);
    run.add_output_to(app);

    return app.run(argc, argv, [&] {
        using axistokes::detail::require;
        run.method.check();
        require(flow == "none" || flow == "poiseuille", "flow", flow, "none or poiseuille");
        require(aspect > 0 && std::isfinite(aspect), "aspect ratio", aspect, "> 0 and finite");
        const auto accuracy = run.method.accuracy();
        const double a = 1 / std::cbrt(aspect);
        const bool dragged = flow == "none";
        if (tube.confinement) {
            require(a < tube.radius(), "confinement", *tube.confinement,
                    ("< " + std::to_string(1 / a) + ", that is the spheroid must fit into the tube").c_str());
        }
        const auto details = [&](const examples::BodyMotion& motion) -> nlohmann::ordered_json {
            if (!dragged) {
                return {{"velocity_ratio", motion.velocity}};  // the flow's peak velocity is 1
            }
            const double computed = motion.weight.dot(motion.force.tail(motion.nodes.nodes())) / motion.velocity;
            const double unbounded = analytic_drag(a, aspect * a);
            nlohmann::ordered_json keys{{"drag", computed}, {"drag_factor", computed / (6 * std::numbers::pi)}};
            if (!tube.confinement) {
                keys["analytic_drag"] = unbounded;
                keys["relative_error"] = computed / unbounded - 1;
            } else {
                keys["drag_over_unbounded"] = computed / unbounded;
            }
            return keys;
        };
        examples::BodyCase c{run,
                             [&](Index elements) {
                                 return run.method.high_order()
                                            ? axistokes::smooth_spheroid<double>(aspect, elements)
                                            : axistokes::spheroid_of_aspect<double>(aspect, elements);
                             },
                             run.method.high_order() ? 32 : 64,
                             accuracy                  ? accuracy->quadrature
                             : run.method.high_order() ? 1e-10
                                                       : 1e-6,
                             examples::Drive(axistokes::Gravity<double>(1)),
                             {},
                             0,
                             details,
                             {{"aspect", aspect}}};
        if (dragged) {
            c.parameters["bond"] = 1;
        } else {
            const axistokes::Poiseuille<double> undisturbed(1, tube.radius());
            c.drive = examples::Drive(undisturbed);
            c.mean_velocity = undisturbed.mean_velocity();
        }
        if (tube.confinement) {
            c.surroundings.tube_radius = tube.radius();
            c.parameters["confinement"] = *tube.confinement;
            c.parameters["flow"] = flow;
        }
        return examples::run_body(c);
    });
}
