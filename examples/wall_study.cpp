// SPDX-License-Identifier: MIT
// What a meshed wall costs (docs/wall_mesh.md): how far a settling sphere disturbs the flow in a tube, the wall nodes
// needed for an accuracy of its tractions, by kind of mesh, and the time compared with the tube kernel.
#include "support/command_line.hpp"
#include "support/interleaved.hpp"
#include "support/report.hpp"
#include "support/wall_decay.hpp"
#include "support/wall_nodes.hpp"
#include <axistokes/axistokes.hpp>

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
    Index paper_nodes;
};
/// Trozzo et al. 2015, section 3.2.2: 0.1 % on the profile of the tractions.
constexpr Case kCases[] = {{3.0, 100, 9.0, 690}, {2.0, 100, 7.0, 1820}, {1.1, 200, 5.0, 2921}};

LinearElements<double> elements(double tolerance) {
    LinearElements<double>::Params params;
    params.tolerance = tolerance;
    return LinearElements<double>(params);
}

TubeKernel<double> tube_kernel(double radius, double tolerance) {
    TubeKernel<double>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<double>(radius, params);
}

/// A sphere that settles with unit velocity.
struct Settling {
    Vector<double> traction;  // without its uniform pressure
    double drag;              // over that of a uniform unit traction
};

Settling settle(const LinearSurface<double>& surface, const Matrix<double>& mobility) {
    const Index n = surface.size();
    Vector<double> load = Vector<double>::Zero(2 * n);
    load.tail(n).setOnes();
    const Vector<double> none = Vector<double>::Zero(2 * n);
    DenseLU<double> solver;
    const auto solution = detail::lone_motion<double>(RigidBody<double>(), surface, mobility, none, load, solver);
    return {solution.force / solution.velocity[n], 1 / solution.velocity[n]};
}

Settling by_tube(const LinearElements<double>& discretization, const Meridian<double>& sphere,
                 const TubeKernel<double>& kernel) {
    return settle(discretization.surface(sphere), discretization.single_layer(sphere, kernel));
}

Settling by_wall(const LinearElements<double>& discretization, const Meridian<double>& sphere, Matrix<double> unbounded,
                 Tube& tube) {
    Vector<double> background = Vector<double>::Zero(unbounded.rows());
    tube.confine(discretization, FreeSpaceKernel<double>(), {sphere}, unbounded, background);
    return settle(discretization.surface(sphere), unbounded);
}
/// The mesh and its factors are made in the first call, as in a simulation's first step.
Settling by_wall(const LinearElements<double>& discretization, const Meridian<double>& sphere, Tube& tube) {
    return by_wall(discretization, sphere, discretization.single_layer(sphere, FreeSpaceKernel<double>()), tube);
}

double largest_deviation(const Settling& result, const Settling& reference) {
    return (result.traction - reference.traction).lpNorm<Eigen::Infinity>() /
           reference.traction.lpNorm<Eigen::Infinity>();
}

/// Errors and times of meshes of the wall, compared with the tube kernel of the largest tolerance (a power of ten) that
/// gives the tractions to the accuracy asked for.
class Comparison {
  public:
    Comparison(const Case& c, double accuracy)
        : radius_(c.radius),
          body_(sphere<double>(c.elements)),
          unbounded_(fine_.single_layer(body_, FreeSpaceKernel<double>())),
          exact_(by_tube(fine_, body_, tube_kernel(c.radius, 1e-10))),
          kernel_tolerance_(accuracy),
          coarse_(elements(accuracy / 1000)) {
        while (kernel_error() > accuracy) {
            kernel_tolerance_ /= 10;
        }
    }

    const Meridian<double>& body() const { return body_; }
    double wall_error(const WallMeshParams<double>& params) const {
        Tube tube(StraightTube<double>(radius_), params);
        return largest_deviation(by_wall(fine_, body_, unbounded_, tube), exact_);
    }
    double kernel_error() const {
        return largest_deviation(by_tube(fine_, body_, tube_kernel(radius_, kernel_tolerance_)), exact_);
    }

    void report(examples::Report& table, const Case& c, const std::string& mesh, double accuracy,
                const WallMeshParams<double>& params) const {
        Tube tube(StraightTube<double>(radius_), params);
        const Settling wall = by_wall(fine_, body_, unbounded_, tube);
        const TubeKernel<double> kernel = tube_kernel(radius_, kernel_tolerance_);
        constexpr int repetitions = 31;
        const auto [tube_seconds, wall_seconds] = examples::median_seconds(
            repetitions, [&] { by_tube(coarse_, body_, kernel); }, [&] { by_wall(coarse_, body_, tube); });
        table.row(c.radius, c.elements, accuracy, mesh, examples::name_of(params.grading), tube.mesh()->upper() - 1,
                  tube.mesh()->curve().nodes_per_panel(), tube.mesh()->wall_panels(), tube.mesh()->curve().size(),
                  largest_deviation(wall, exact_), wall.drag / exact_.drag - 1, kernel_tolerance_, kernel_error(),
                  1e3 * tube_seconds, 1e3 * wall_seconds, tube_seconds / wall_seconds, c.paper_nodes);
    }

  private:
    double radius_;
    LinearElements<double> fine_ = elements(1e-10);
    Meridian<double> body_;
    Matrix<double> unbounded_;
    Settling exact_;
    double kernel_tolerance_;
    LinearElements<double> coarse_;
};

const std::vector<Index> kOrders{4, 3, 5, 6, 8, 2};

const char* const kColumns =
    "tube_radius,sphere_elements,accuracy,mesh,grading,length_beyond_sphere,nodes_per_panel,wall_panels,nodes,"
    "traction_error,drag_error,kernel_tolerance,kernel_traction_error,tube_ms,wall_ms,tube_over_wall,paper_wall_"
    "elements";

/// The meshes chosen from a tolerance.
void chosen(const std::string& directory) {
    examples::Report table(directory, "wall_tolerance.csv", kColumns);
    for (const Case& c : kCases) {
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
            WallMeshParams<double> params;
            params.tolerance = tolerance;
            Comparison(c, tolerance).report(table, c, "default", tolerance, params);
        }
    }
}

/// Fewest nodes on wall and ends with which the tractions are right to `accuracy`: over all meshes, and with the
/// paper's length and low order.
void nodes_needed(const std::string& directory, double accuracy) {
    examples::Report table(directory, "wall_nodes.csv", kColumns);
    for (const Case& c : kCases) {
        const Comparison comparison(c, accuracy);
        const auto search = [&](const char* name, const std::vector<WallGrading>& gradings,
                                const std::vector<Index>& orders, const std::vector<double>& lengths) {
            const auto best =
                examples::cheapest_wall(StraightTube<double>(c.radius), comparison.body(), accuracy, gradings, orders,
                                        lengths, [&](const auto& params) { return comparison.wall_error(params); });
            if (best.error < accuracy) {
                comparison.report(table, c, name, accuracy, best.params);
            }
        };
        std::vector<double> lengths;
        for (const double length : {1.2, 0.8, 0.6, 0.4, 0.25}) {
            lengths.push_back(length * c.radius);
        }
        const double paper_length = c.paper_length - 1;  // the paper's is from the centre
        search("fewest", {WallGrading::automatic, WallGrading::quadratic, WallGrading::uniform}, kOrders, lengths);
        search("fewest", {WallGrading::quadratic}, kOrders, lengths);
        search("fewest", {WallGrading::uniform}, kOrders, lengths);
        search("order 2 and the paper's length", {WallGrading::quadratic}, {2}, {paper_length});
        search("order 2 and the paper's length", {WallGrading::uniform}, {2}, {paper_length});
    }
}

/// For a sphere that settles in fluid at rest.
void decay(const std::string& directory) {
    examples::DecayReport report(directory);
    for (const Case& c : kCases) {
        const Meridian<double> body = sphere<double>(c.elements);
        const LinearElements<double> discretization = elements(1e-13);
        const FreeSpaceKernel<double> kernel;
        constexpr double farthest = 4.5;
        WallMeshParams<double> params;
        params.tolerance = 1e-12;
        params.length = (farthest + 1.5) * c.radius;
        Tube tube(StraightTube<double>(c.radius), params);
        const Settling settling = by_wall(discretization, body, tube);
        const auto field = tube.field(discretization, kernel, body, settling.traction);
        report.add("sphere", c.radius, 1.0, 0.5 * std::ceil(2.2 / c.radius), farthest, 1,
                   [&](const Meridian<double>& points) { return field.velocity(points); });
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{"wall_study",
                              "Accuracy and cost of a meshed wall around a sphere that settles in a tube"};
    std::string directory;
    double accuracy = 1e-3;
    app.text("--out", directory, "directory that receives wall_decay.csv, wall_tolerance.csv, wall_nodes.csv");
    app.number("--accuracy", accuracy, "of the tractions, for the number of nodes needed");
    return app.run(argc, argv, [&] {
        detail::require(accuracy >= 1e-6 && accuracy <= 0.1, "accuracy", accuracy, "in [1e-6, 0.1]");
        decay(directory);
        chosen(directory);
        nodes_needed(directory, accuracy);
        return examples::success;
    });
}
