// SPDX-License-Identifier: MIT
// A rigid sphere on the axis of a tube: drag factor K in fluid at rest; velocity and added pressure drop in Poiseuille
// flow; the traction along the meridian.
#include "support/body_case.hpp"
#include "support/command_line.hpp"
#include "support/tube.hpp"
#include "support/wall.hpp"
#include <axistokes/io/csv.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace {

using namespace axistokes;

/// Angle from the equator, -pi/2 at the lower pole (upwind in a flow along +z), and the traction jump there, which a
/// rigid body leaves undetermined up to a multiple of the normal: the mean normal part is zero.
void write_traction(const examples::RunOptions& run, const examples::BodyMotion& motion) {
    if (run.directory.empty()) {
        return;
    }
    const Index n = motion.nodes.nodes();
    Vector<double> angle(n);
    for (Index i = 0; i < n; ++i) {
        angle[i] = std::atan2(motion.nodes.z[i], motion.nodes.r[i]);
    }
    write_csv(
        std::filesystem::path(run.directory) / "traction.csv",
        std::vector<Column<double>>{{"angle", angle}, {"f_r", motion.force.head(n)}, {"f_z", motion.force.tail(n)}});
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"sphere_in_tube", "A rigid sphere of radius R0 on the axis of a tube"};
    examples::RunOptions run;
    examples::TubeOptions tube;
    std::string flow = "none";
    examples::WallOptions wall;
    std::optional<double> tolerance;
    tube.add_to(app, "0.5");
    app.number("--elements", run.elements,
               "elements, or modes, on the meridian (default: spectral 32, linear 64, with filon 16; with "
               "--preset-accuracy as many as it takes)");
    app.text("--flow", flow, "none: it is dragged along; poiseuille: it floats freely");
    wall.add_to(app, true);
    app.number("--tolerance", tolerance, "of the quadratures and of the tube kernel or the wall (default: 1e-8)");
    run.method.add_to(app, true);
    run.add_output_to(app);

    return app.run(argc, argv, [&] {
        tube.confinement = tube.confinement.value_or(0.5);
        const double radius = tube.radius();
        detail::require(radius > 1, "confinement", *tube.confinement, "< 1, that is the sphere must fit into the tube");
        detail::require(flow == "none" || flow == "poiseuille", "flow", flow, "none or poiseuille");
        const bool dragged = flow == "none";
        run.method.check();
        const auto accuracy = run.method.accuracy();
        const double quadrature = tolerance.value_or(accuracy ? accuracy->quadrature : 1e-8);
        const auto details = [&](const examples::BodyMotion& motion) {
            write_traction(run, motion);
            // Dragged by the weight of a sphere that settles at unit velocity in an unbounded fluid: U = -1/K.
            return dragged ? nlohmann::ordered_json{{"drag_factor", -1 / motion.velocity}}
                           : nlohmann::ordered_json{{"velocity_ratio", motion.velocity}};
        };
        examples::BodyCase c{
            run,
            [&](Index elements) {
                return run.method.high_order() ? smooth_spheroid<double>(1, elements) : sphere<double>(elements);
            },
            wall.method == "filon"    ? 16
            : run.method.high_order() ? 32
                                      : 64,
            quadrature,
            dragged ? examples::Drive(Gravity<double>(4.5)) : examples::Drive(Poiseuille<double>(1, radius)),
            {},
            dragged ? 0 : Poiseuille<double>(1, radius).mean_velocity(),
            details,
            {{"confinement", *tube.confinement}, {"flow", flow}, {"method", wall.method}, {"tolerance", quadrature}}};
        c.surroundings.tube_radius = radius;
        if (wall.meshed()) {
            c.surroundings.wall = wall.params(tolerance.value_or(accuracy ? accuracy->wall : 1e-8));
        }
        c.surroundings.slow_quadrature = wall.method == "filon";
        return examples::run_body(c);
    });
}
