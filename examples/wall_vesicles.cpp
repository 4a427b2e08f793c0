// SPDX-License-Identifier: MIT
// A stationary vesicle in a tube by either method (docs/wall_mesh.md): agreement, wall nodes needed, time per step, and
// how far it disturbs the flow.
#include "support/command_line.hpp"
#include "support/interleaved.hpp"
#include "support/progress.hpp"
#include "support/report.hpp"
#include "support/simulation.hpp"
#include "support/tube.hpp"
#include "support/wall_decay.hpp"
#include "support/wall_nodes.hpp"
#include <axistokes/geometry/distance.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace axistokes;
using examples::AnyDiscretization;
using examples::Scene;

struct Options {
    examples::VesicleOptions vesicle{1.59, "prolate"};
    examples::TubeOptions tube;
    double capillary_number = 100;
    Index elements = 64;
    double settled = 1e-2;
    double accuracy = 1e-3;
    std::string directory;

    double radius() const { return tube.radius(); }
    Poiseuille<double> flow() const { return {capillary_number, radius()}; }
};

AnyDiscretization elements_with(double tolerance) {
    return AnyDiscretization::of(examples::DiscretizationKind::linear, tolerance);
}

AnyDiscretization fine_elements() {
    return elements_with(1e-9);
}

Scene scene_in(const examples::Surroundings& surroundings, const Options& options, const AnyDiscretization& elements,
               std::optional<double> tolerance) {
    return {examples::kernel_for(surroundings, tolerance),
            elements,
            examples::Law(examples::Vesicle()),
            examples::Drive(options.flow()),
            examples::Solver(),
            examples::wall_for(surroundings)};
}

Scene by_tube(const Options& options, const AnyDiscretization& elements, std::optional<double> tolerance) {
    examples::Surroundings tube;
    tube.tube_radius = options.radius();
    return scene_in(tube, options, elements, tolerance);
}

Scene by_wall(const Options& options, const AnyDiscretization& elements, const WallMeshParams<double>& params) {
    examples::Surroundings tube;
    tube.tube_radius = options.radius();
    tube.wall = params;
    return scene_in(tube, options, elements, std::nullopt);
}

WallMeshParams<double> wall_of(double tolerance) {
    WallMeshParams<double> params;
    params.tolerance = tolerance;
    return params;
}

/// Time steps with the tube kernel until the residual is below `settled`, as a start for Newton's method.
Meridian<double> settle(const Options& options) {
    SimulationParams<double> params;
    params.tolerance = options.settled;
    examples::Simulation run(
        by_tube(options, AnyDiscretization::of(examples::DiscretizationKind::linear, std::nullopt), std::nullopt),
        ExtrapolatedEulerOfOrder(1), options.tube.shape(options.vesicle, options.elements), params);
    examples::ProgressBar bar;
    examples::Approach approach(params.tolerance);
    run.run([&](const auto& record) {
        std::ostringstream text;
        text << "step " << record.step << "  residual " << record.residual;
        bar.show(approach.fraction(record.residual), text.str());
    });
    return run.configuration().shape;
}

examples::Newton::State stationary(const Scene& scene, const Meridian<double>& start, const Options& options,
                                   bool coarse_start) {
    StationaryParams<double> params;
    params.coarse_start = coarse_start;
    return examples::Newton(scene, params)
        .solve(start, 4 * detail::pi_value<double>() + options.vesicle.excess_area, 4 * detail::pi_value<double>() / 3);
}

double largest_deviation(const Vector<double>& values, const Vector<double>& reference) {
    return (values - reference).lpNorm<Eigen::Infinity>() / reference.lpNorm<Eigen::Infinity>();
}

/// The stationary shapes and velocities of both methods, each by Newton's method, for walls of several tolerances.
void agreement(const Options& options, const examples::Newton::State& exact) {
    examples::Report table(options.directory, "agreement.csv",
                           "wall_tolerance,wall_panels,wall_nodes,velocity,velocity_error,pressure_drop_error,"
                           "shape_distance,velocity_tube");
    for (const double tolerance : {1e-3, 1e-5}) {
        const WallMeshParams<double> params = wall_of(tolerance);
        Scene scene = by_wall(options, fine_elements(), params);
        // From the other method's shape, so that the nodes are the same: where they are matters by O(h^2).
        const auto state = stationary(scene, exact.configuration().shape, options, false);
        scene.evaluate(state.configuration(), 0);
        const auto& mesh = *scene.wall().mesh()->mesh();
        table.row(tolerance, mesh.wall_panels(), mesh.curve().size(), state.instant().velocity,
                  state.instant().velocity / exact.instant().velocity - 1,
                  state.instant().pressure_drop / exact.instant().pressure_drop - 1,
                  std::max(distance(state.configuration().shape, exact.configuration().shape),
                           distance(exact.configuration().shape, state.configuration().shape)),
                  exact.instant().velocity);
    }
}

/// Errors of the force densities and velocities on one frozen shape, and the times of one step.
void cost(const Options& options, const examples::Newton::State& state) {
    examples::Report table(options.directory, "cost.csv",
                           "accuracy,mesh,grading,length_beyond_vesicle,nodes_per_panel,wall_panels,wall_nodes,"
                           "force_error,velocity_error,kernel_tolerance,kernel_force_error,tube_ms,wall_ms,"
                           "tube_over_wall");
    const auto& configuration = state.configuration();
    const AnyDiscretization fine = fine_elements();
    const auto exact = by_tube(options, fine, 1e-10).evaluate(configuration, 0);
    const auto force_error = [&](const auto& instant) {
        return largest_deviation(instant.solution.force, exact.solution.force);
    };
    double kernel_tolerance = options.accuracy;
    double kernel_error = 0;
    for (;; kernel_tolerance /= 10) {
        kernel_error = force_error(by_tube(options, fine, kernel_tolerance).evaluate(configuration, 0));
        if (kernel_error < options.accuracy) {
            break;
        }
    }
    const auto report = [&](const std::string& name, const WallMeshParams<double>& params) {
        const auto instant = by_wall(options, fine, params).evaluate(configuration, 0);
        const AnyDiscretization coarse = elements_with(options.accuracy / 1000);
        Scene tube = by_tube(options, coarse, kernel_tolerance);
        Scene wall = by_wall(options, coarse, params);
        wall.evaluate(configuration, 0);  // makes the mesh
        constexpr double time_step = 1e-3;
        constexpr int repetitions = 31;
        const auto [tube_seconds, wall_seconds] = examples::median_seconds(
            repetitions, [&] { tube.evaluate(configuration, time_step); },
            [&] { wall.evaluate(configuration, time_step); });
        const auto& mesh = *wall.wall().mesh()->mesh();
        const double length = configuration.shape.z.maxCoeff() - configuration.shape.z.minCoeff();
        table.row(options.accuracy, name, examples::name_of(params.grading), (mesh.upper() - mesh.lower() - length) / 2,
                  mesh.curve().nodes_per_panel(), mesh.wall_panels(), mesh.curve().size(), force_error(instant),
                  instant.velocity / exact.velocity - 1, kernel_tolerance, kernel_error, 1e3 * tube_seconds,
                  1e3 * wall_seconds, tube_seconds / wall_seconds);
    };
    report("default", wall_of(options.accuracy));
    std::vector<double> lengths;
    for (const double length : {0.8, 0.6, 0.4, 0.25}) {
        lengths.push_back(length * options.radius());
    }
    // The unbounded part does not depend on the wall.
    Scene scene = by_wall(options, fine, wall_of(options.accuracy));
    const auto frozen_without_wall = [&] {
        auto frozen = scene.freeze({configuration});
        frozen.mobility = fine.single_layer(configuration.shape, scene.kernel());
        frozen.background = scene.background_velocity(configuration);
        return frozen;
    }();
    const auto wall_error = [&](const WallMeshParams<double>& params) {
        auto frozen = frozen_without_wall;
        examples::AnyWall tube = by_wall(options, fine, params).wall();
        tube.confine(fine, scene.kernel(), {configuration.shape}, frozen.mobility, frozen.background);
        const std::vector<detail::EquationBody<double, Scene::Surface, examples::Law>> bodies{
            {scene.law(), frozen.bodies[0].surface, frozen.bodies[0].load, configuration.tension, {}}};
        detail::complete_rank<double>(bodies, frozen.mobility, frozen.background);
        return force_error(scene.evaluate(frozen, {configuration}, 0).front());
    };
    for (const WallGrading grading : {WallGrading::automatic, WallGrading::uniform}) {
        const auto best = examples::cheapest_wall(StraightTube<double>(options.radius()), configuration.shape,
                                                  options.accuracy, {grading}, {4, 3, 5, 6, 8, 2}, lengths, wall_error);
        if (best.error < options.accuracy) {
            report("fewest", best.params);
        }
    }
}

/// Up- and downstream of a stationary vesicle.
void decay(const Options& options, const examples::Newton::State& state) {
    const double step = examples::DecayReport::step;
    const double reach = std::max(state.configuration().shape.z.maxCoeff(), -state.configuration().shape.z.minCoeff());
    const double nearest = step * std::ceil(1.1 * reach / options.radius() / step);
    const double farthest = std::max(4.5, nearest + 2);
    WallMeshParams<double> params = wall_of(1e-12);
    params.length = (farthest + 1.0) * options.radius();
    const AnyDiscretization elements = elements_with(1e-13);
    Scene scene = by_wall(options, elements, params);
    const auto instant = scene.evaluate(state.configuration(), 0);
    // The uniform pressure in the force moves nothing: without it, neither does its discretisation error.
    const auto force = detail::without_flux<double>(instant.surface, instant.solution.force);
    examples::AnyWall tube = scene.wall();
    const auto field = tube.field(elements, scene.kernel(), state.configuration().shape, force);
    examples::DecayReport report(options.directory);
    const auto velocity = [&](const Meridian<double>& points) { return field.velocity(points); };
    report.add("vesicle", options.radius(), options.capillary_number, nearest, farthest, 1, velocity);
    report.add("vesicle", options.radius(), options.capillary_number, nearest, farthest, -1, velocity);
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "wall_vesicles", "A stationary vesicle in Poiseuille flow in a tube, by the tube kernel and by a meshed wall"};
    Options options;
    options.vesicle.add_to(app);
    options.tube.add_to(app, "1/0.9");
    app.number("--capillary-number", options.capillary_number, "Ca = eta u_max R0^2 / kappa");
    app.number("--elements", options.elements, "elements on the meridian");
    app.number("--settled", options.settled, "residual at which Newton's method takes over");
    app.number("--accuracy", options.accuracy, "of the force densities, for the wall nodes needed");
    app.text("--out", options.directory, "directory that receives agreement.csv, cost.csv, wall_decay.csv");
    return app.run(argc, argv, [&] {
        detail::require(options.accuracy >= 1e-6 && options.accuracy <= 0.1, "accuracy", options.accuracy,
                        "in [1e-6, 0.1]");
        options.tube.confinement = options.tube.confinement.value_or(1 / 0.9);
        const Meridian<double> start = settle(options);
        const auto state = stationary(by_tube(options, fine_elements(), 1e-9), start, options, true);
        decay(options, state);
        agreement(options, state);
        cost(options, state);
        return examples::success;
    });
}
