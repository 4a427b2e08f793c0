// SPDX-License-Identifier: MIT
// A rigid sphere on the axis of a tube: drag factor K in fluid at rest; velocity and added pressure drop in Poiseuille
// flow; the traction along the meridian.
#include "support/run.hpp"
#include "support/tube.hpp"
#include <axistokes/axistokes.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace axistokes;

template <class Flow>
using SphereInTube =
    Simulator<TubeKernel<double>, LinearElements<double>, RigidBody<double>, Flow, ExplicitEuler, DenseLU<double>>;

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

/// `flow` drives the sphere with a typical velocity 1; `result(instant)` gives the keys that depend on it.
template <class Flow, class Result>
int solve(const examples::RunOptions& run, double tube_radius, double tolerance, const Flow& flow,
          const Result& result) {
    LinearElements<double>::Params elements;
    elements.tolerance = tolerance;
    TubeKernel<double>::Params kernel;
    kernel.tolerance = tolerance;
    SphereInTube<Flow> simulator(sphere<double>(run.elements), flow, run.params(),
                                 TubeKernel<double>(tube_radius, kernel), LinearElements<double>(elements));
    return examples::run_to_end(simulator, run, {{"quadrature_tolerance", tolerance}},
                                [&](const auto& s, const auto& instant) {
                                    write_traction(run, instant);
                                    nlohmann::ordered_json summary = examples::tube_summary(s, 0);
                                    summary.update(result(instant));
                                    return summary;
                                });
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"A rigid sphere of radius R0 on the axis of a tube"};
    examples::RunOptions run;
    examples::TubeOptions tube;
    std::string flow = "none";
    double tolerance = 1e-8;
    tube.add_to(app, "0.5");
    examples::add_number(app, "--elements", run.elements, "elements on the meridian");
    app.add_option("--flow", flow, "none: it is dragged along; poiseuille: it floats freely")->capture_default_str();
    examples::add_number(app, "--quadrature-tolerance", tolerance, "of the quadratures and of the tube kernel");
    run.add_output_to(app);

    return examples::run_program("sphere_in_tube", app, argc, argv, [&] {
        tube.confinement = tube.confinement.value_or(0.5);
        const double radius = tube.radius();
        detail::require(radius > 1, "confinement", *tube.confinement, "< 1, that is the sphere must fit into the tube");
        detail::require(flow == "none" || flow == "poiseuille", "flow", flow, "none or poiseuille");
        if (flow == "none") {
            // The weight of a sphere that settles at unit velocity in an unbounded fluid: U = -1/K.
            return solve(run, radius, tolerance, Gravity<double>(4.5), [](const auto& instant) {
                return nlohmann::ordered_json{{"drag_factor", -1 / instant.velocity}};
            });
        }
        return solve(run, radius, tolerance, Poiseuille<double>(1, radius), [](const auto& instant) {
            return nlohmann::ordered_json{{"velocity_ratio", instant.velocity},
                                          {"pressure_drop", instant.pressure_drop}};
        });
    });
}
