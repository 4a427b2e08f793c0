// SPDX-License-Identifier: MIT
// A rigid sphere on the axis of a tube: drag factor K in fluid at rest; velocity and added pressure drop in Poiseuille
// flow; the traction along the meridian.
#include "support/run.hpp"
#include "support/tube.hpp"
#include "support/wall.hpp"
#include <axistokes/axistokes.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace {

using namespace axistokes;

/// Angle from the equator, -pi/2 at the lower pole (upwind in a flow along +z), and the traction jump there, which a
/// rigid body leaves undetermined up to a multiple of the normal: the mean normal part is zero.
template <class InstantType>
void write_traction(const examples::RunOptions& run, const InstantType& instant) {
    if (run.directory.empty()) {
        return;
    }
    const Meridian<double>& nodes = instant.surface.nodes;
    const Index n = nodes.nodes();
    Vector<double> angle(n);
    for (Index i = 0; i < n; ++i) {
        angle[i] = std::atan2(nodes.z[i], nodes.r[i]);
    }
    const Vector<double>& force = instant.solution.force;
    write_csv(std::filesystem::path(run.directory) / "traction.csv",
              std::vector<Column<double>>{{"angle", angle}, {"f_r", force.head(n)}, {"f_z", force.tail(n)}});
}

struct Case {
    examples::RunOptions run;
    double radius;
    double tolerance;
    examples::WallOptions wall;
};

template <class Kernel, class Flow, class Wall = NoWall, class Result>
int solve(const Case& c, const Kernel& kernel, const Flow& flow, const Result& result, const Wall& wall = {}) {
    using Sphere =
        Simulator<Kernel, LinearElements<double>, RigidBody<double>, Flow, ExplicitEuler, DenseLU<double>, Wall>;
    LinearElements<double>::Params elements;
    elements.tolerance = c.tolerance;
    Sphere simulator(sphere<double>(c.run.elements), flow, c.run.params(), kernel, LinearElements<double>(elements), {},
                     {}, {}, wall);
    return examples::run_to_end(simulator, c.run, {{"method", c.wall.method}, {"tolerance", c.tolerance}},
                                [&](const auto& s, const auto& instant) {
                                    write_traction(c.run, instant);
                                    nlohmann::ordered_json summary = examples::tube_summary(s, 0);
                                    summary.update(result(instant));
                                    return summary;
                                });
}

/// `flow` drives the sphere with a typical velocity 1; `result(instant)` gives the keys that depend on it.
template <class Flow, class Result>
int solve(const Case& c, const Flow& flow, const Result& result) {
    if (c.wall.meshed()) {
        const WallMesh wall(StraightTube<double>(c.radius), c.wall.params(c.tolerance));
        return solve(c, FreeSpaceKernel<double>(), flow, result, wall);
    }
    TubeKernel<double>::Params kernel;
    kernel.tolerance = c.tolerance;
    if (c.wall.method == "filon") {
        return solve(c, TubeFilonKernel<double>(c.radius, kernel), flow, result);
    }
    return solve(c, TubeKernel<double>(c.radius, kernel), flow, result);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"A rigid sphere of radius R0 on the axis of a tube"};
    examples::RunOptions run;
    examples::TubeOptions tube;
    std::string flow = "none";
    examples::WallOptions wall;
    double tolerance = 1e-8;
    std::optional<Index> elements;
    tube.add_to(app, "0.5");
    examples::add_number(app, "--elements", elements, "elements on the meridian (default: 64; with filon 16)");
    app.add_option("--flow", flow, "none: it is dragged along; poiseuille: it floats freely")->capture_default_str();
    wall.add_to(app, true);
    examples::add_number(app, "--tolerance", tolerance, "of the quadratures and of the tube kernel or the wall");
    run.add_output_to(app);

    return examples::run_program("sphere_in_tube", app, argc, argv, [&] {
        tube.confinement = tube.confinement.value_or(0.5);
        const double radius = tube.radius();
        detail::require(radius > 1, "confinement", *tube.confinement, "< 1, that is the sphere must fit into the tube");
        detail::require(flow == "none" || flow == "poiseuille", "flow", flow, "none or poiseuille");
        run.elements = elements.value_or(wall.method == "filon" ? 16 : 64);
        const Case c{run, radius, tolerance, wall};
        if (flow == "none") {
            // The weight of a sphere that settles at unit velocity in an unbounded fluid: U = -1/K.
            return solve(c, Gravity<double>(4.5), [](const auto& instant) {
                return nlohmann::ordered_json{{"drag_factor", -1 / instant.velocity}};
            });
        }
        return solve(c, Poiseuille<double>(1, radius), [](const auto& instant) {
            return nlohmann::ordered_json{{"velocity_ratio", instant.velocity}};
        });
    });
}
