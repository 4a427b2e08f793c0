// SPDX-License-Identifier: MIT
// What a meshed wall costs (docs/wall_mesh.md): how far a particle disturbs the flow in a tube, the wall nodes that a
// settling sphere needs for an accuracy of its tractions, by kind of mesh, and the time compared with the tube kernel.
#include "support/program.hpp"
#include "support/report.hpp"
#include <axistokes/axistokes.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace axistokes;
using Tube = WallMesh<StraightTube<double>>;

struct Case {
    double radius;   // of the tube
    Index elements;  // on the sphere
    double paper_length;
    Index paper_wall_elements;
};
/// Trozzo et al. 2015, section 3.2.2: 0.1 % on the profile of the tractions.
constexpr Case kCases[] = {{3.0, 100, 9.0, 690}, {2.0, 100, 7.0, 1820}, {1.1, 200, 5.0, 2921}};

/// A sphere settling under a unit load, and what it costs to find out how.
struct Settling {
    Vector<double> traction;  // without its uniform pressure
    double velocity;
    double seconds;
};

Vector<double> settle(const LinearSurface<double>& surface, const Matrix<double>& mobility, double& velocity) {
    const Index n = surface.size();
    Vector<double> load = Vector<double>::Zero(2 * n);
    load.tail(n).setOnes();
    const Vector<double> none = Vector<double>::Zero(2 * n);
    const Vector<double> tension;
    DenseLU<double> solver;
    const auto solution = RigidBody<double>().solve(
        MobilityProblem<double, LinearSurface<double>>{surface, mobility, none, load, tension, 0.0}, solver);
    velocity = solution.velocity[n];
    return solution.force;
}

template <class Confine>
Settling settling(const Meridian<double>& sphere, const Confine& confined_mobility) {
    const LinearElements<double> elements;
    const LinearSurface<double> surface = elements.surface(sphere);
    Settling result;
    result.seconds = 1e9;
    for (int repetition = 0; repetition < 3; ++repetition) {
        const auto begin = std::chrono::steady_clock::now();
        const Matrix<double> mobility = confined_mobility(elements);
        result.traction = settle(surface, mobility, result.velocity);
        result.seconds =
            std::min(result.seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return result;
}

/// The mesh and its factors are made in the first of the repetitions, as in a simulation's first step.
Settling with_wall(const Meridian<double>& sphere, Tube& tube) {
    return settling(sphere, [&](const LinearElements<double>& elements) {
        const FreeSpaceKernel<double> kernel;
        Matrix<double> mobility = elements.single_layer(sphere, kernel);
        Vector<double> background = Vector<double>::Zero(mobility.rows());
        tube.confine(elements, kernel, sphere, mobility, background);
        return mobility;
    });
}

double largest_deviation(const Settling& result, const Settling& reference) {
    return (result.traction - reference.traction).lpNorm<Eigen::Infinity>() /
           reference.traction.lpNorm<Eigen::Infinity>();
}

Settling reference(const Case& c, const Meridian<double>& sphere) {
    WallMeshParams<double> params;
    params.tolerance = 1e-10;
    Tube tube(StraightTube<double>(c.radius), params);
    return with_wall(sphere, tube);
}

/// Fewest nodes on wall and ends with which the tractions are right to `accuracy`.
void nodes_needed(const std::string& directory, double accuracy) {
    examples::Report report(
        directory, "wall_nodes.csv",
        "tube_radius,sphere_elements,accuracy,mesh,nodes_per_panel,wall_panels,nodes,error,paper_wall_elements");
    for (const Case& c : kCases) {
        const Meridian<double> body = sphere<double>(c.elements);
        const Settling exact = reference(c, body);
        const auto search = [&](const char* mesh, WallGrading grading, Index order, double length) {
            for (double panels = 2; panels < 1000; panels = std::max(panels + 1, std::floor(panels * 1.15))) {
                WallMeshParams<double> params;
                params.tolerance = accuracy;
                params.grading = grading;
                params.nodes_per_panel = order;
                params.panels = static_cast<Index>(panels);
                if (length > 0) {
                    params.length = length - 1;  // the paper's is from the centre
                }
                Tube tube(StraightTube<double>(c.radius), params);
                const double error = largest_deviation(with_wall(body, tube), exact);
                if (error < accuracy) {
                    report.row(c.radius, c.elements, accuracy, mesh, order, tube.mesh()->wall_panels(),
                               tube.mesh()->curve().size(), error, c.paper_wall_elements);
                    return;
                }
            }
        };
        search("automatic", WallGrading::automatic, 8, 0);
        search("automatic", WallGrading::automatic, 4, 0);
        search("automatic", WallGrading::automatic, 2, 0);
        search("quadratic", WallGrading::quadratic, 8, c.paper_length);
        search("quadratic", WallGrading::quadratic, 2, c.paper_length);
        search("uniform", WallGrading::uniform, 8, c.paper_length);
        search("uniform", WallGrading::uniform, 2, c.paper_length);
    }
}

/// What the mesh chosen from a tolerance achieves, and the time of one evaluation compared with the tube kernel's.
void chosen(const std::string& directory) {
    examples::Report report(directory, "wall_tolerance.csv",
                            "tube_radius,tolerance,nodes,traction_error,velocity_error,wall_seconds,tube_seconds,"
                            "tube_over_wall,velocity_wall_over_tube_minus_1");
    for (const Case& c : kCases) {
        const Meridian<double> body = sphere<double>(c.elements);
        const Settling exact = reference(c, body);
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
            WallMeshParams<double> params;
            params.tolerance = tolerance;
            Tube tube(StraightTube<double>(c.radius), params);
            const Settling wall = with_wall(body, tube);
            TubeKernel<double>::Params kernel_params;
            kernel_params.tolerance = tolerance;
            const TubeKernel<double> kernel(c.radius, kernel_params);
            const Settling tube_kernel = settling(
                body, [&](const LinearElements<double>& elements) { return elements.single_layer(body, kernel); });
            report.row(c.radius, tolerance, tube.mesh()->curve().size(), largest_deviation(wall, exact),
                       std::abs(wall.velocity / exact.velocity - 1), wall.seconds, tube_kernel.seconds,
                       tube_kernel.seconds / wall.seconds, wall.velocity / tube_kernel.velocity - 1);
        }
    }
}

/// Mean over the section of |u| / U for a sphere settling with velocity U in fluid at rest (the paper's Fig. 12).
void decay(const std::string& directory) {
    examples::Report report(directory, "wall_decay.csv", "tube_radius,z,mean_perturbation,rate_times_radius");
    for (const Case& c : kCases) {
        const Meridian<double> body = sphere<double>(c.elements);
        const Settling exact = reference(c, body);
        WallMeshParams<double> params;
        params.tolerance = 1e-12;
        Tube tube(StraightTube<double>(c.radius), params);
        const LinearElements<double> elements;
        const FreeSpaceKernel<double> kernel;
        const auto field = tube.field(elements, kernel, body, exact.traction);
        const GaussLegendreRule<double> rule = gauss_legendre<double>(20);
        double before = 0;
        const double step = 0.5 * c.radius;
        for (double z = 1.25 * c.radius; z < 4.5 * c.radius; z += step) {
            const Index n = rule.nodes.size();
            const Vector<double> u =
                field.velocity({Vector<double>(c.radius * rule.nodes), Vector<double>::Constant(n, z)});
            const Vector<double> magnitude = (u.head(n).array().square() + u.tail(n).array().square()).sqrt();
            const double mean = rule.weights.dot(magnitude) / exact.velocity;
            const double rate = before > 0 ? std::log(before / mean) / step * c.radius : 0.0;
            report.row(c.radius, z, mean, rate);
            before = mean;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Accuracy and cost of a meshed wall around a sphere that settles in a tube"};
    std::string directory;
    double accuracy = 1e-3;
    app.add_option("--out", directory, "directory that receives wall_decay.csv, wall_tolerance.csv, wall_nodes.csv");
    examples::add_number(app, "--accuracy", accuracy, "of the tractions, for the number of nodes needed");
    return examples::run_program("wall_study", app, argc, argv, [&] {
        decay(directory);
        chosen(directory);
        nodes_needed(directory, accuracy);
        return examples::success;
    });
}
