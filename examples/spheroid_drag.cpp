// SPDX-License-Identifier: MIT
// The drag on a rigid spheroid that translates along its axis, against the analytic one.
#include "support/body_case.hpp"
#include "support/command_line.hpp"

#include <cmath>
#include <numbers>

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
    CLI::App app{"Drag on a rigid spheroid of volume 4 pi/3 that translates along its axis in an unbounded fluid"};
    examples::RunOptions run;
    double aspect = 2;
    examples::add_number(app, "--aspect", aspect, "polar over equatorial semi-axis (> 1: prolate)");
    examples::add_number(
        app, "--elements", run.elements,
        "elements, or modes, on the meridian (default: spectral 32, linear 64; with --preset-accuracy as many "
        "as it takes)");
    run.method.add_to(app, true);
    run.add_output_to(app);

    return examples::run_program("spheroid_drag", app, argc, argv, [&] {
        run.method.check();
        const auto accuracy = run.method.accuracy();
        const auto drag = [&](const examples::BodyMotion& motion) -> nlohmann::ordered_json {
            const double force = motion.weight.dot(motion.force.tail(motion.nodes.nodes()));
            const double a = 1 / std::cbrt(aspect);
            const double exact = analytic_drag(a, aspect * a);
            const double computed = force / motion.velocity;
            return {{"drag", computed}, {"analytic_drag", exact}, {"relative_error", computed / exact - 1}};
        };
        return examples::run_body(
            {run,
             [&](Index elements) { return axistokes::spheroid_of_aspect<double>(aspect, elements); },
             run.method.spectral() ? 32 : 64,
             accuracy                ? accuracy->quadrature
             : run.method.spectral() ? 1e-10
                                     : 1e-6,
             examples::Drive(axistokes::Gravity<double>(1)),
             {},
             drag,
             {{"aspect", aspect}, {"bond", 1}}});
    });
}
