// SPDX-License-Identifier: MIT
// The paper's Figs 5 and 7: a model in space that shares nothing with the library, beside the axisymmetric one
// (docs/three_dimensional.md). Writes the shapes to DIR, which plot_three_dimensional.py draws.

#include "../examples/support/simulation.hpp"
#include "three_dimensional/vesicle.hpp"
#include <axistokes/geometry/shapes.hpp>

#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace axistokes;

constexpr double kExcessArea = 0.6;

struct Row {
    std::string name;
    double velocity;
    double length;
    double radius;
    double bending_energy;
    double residual;
    double seconds;
    Index steps;
};

double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::ofstream opened(const std::filesystem::path& path) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path);
    if (!file) {
        throw std::runtime_error(path.string() + ": cannot be written");
    }
    file << "r,z\n" << std::setprecision(10);
    return file;
}

Row axisymmetric(const std::string& path, examples::DiscretizationKind kind, Index n,
                 const examples::Drive::Choice& flow, double tolerance) {
    SimulationParams<double> params;
    params.tolerance = tolerance;
    const double begin = processor_seconds();
    auto simulation = examples::free_simulation(
        examples::AnyDiscretization::of(kind, std::nullopt), examples::Vesicle(), examples::Drive(flow),
        spheroid_of_excess_area<double>(kExcessArea, SpheroidKind::prolate, n), params);
    if (!simulation.run()) {
        throw std::runtime_error("not stationary with " + std::to_string(n) + " nodes");
    }
    const double seconds = processor_seconds() - begin;
    const auto& shape = simulation.configuration().shape;
    auto file = opened(path);
    for (Index i = 0; i < shape.z.size(); ++i) {
        file << shape.r[i] << ',' << shape.z[i] << '\n';
    }
    const auto& last = simulation.history().back();
    const std::string name = kind == examples::DiscretizationKind::linear ? "P1, N = " : "series, N = ";
    return {name + std::to_string(n), last.velocity, last.length, last.max_radius,
            last.bending_energy,      last.residual, seconds,     last.step};
}

Row spatial(const std::string& path, int levels, const three_dimensional::Drive& drive,
            const three_dimensional::MarchParams& params) {
    const double begin = processor_seconds();
    auto mesh = three_dimensional::prolate_spheroid(kExcessArea, levels);
    const auto state = three_dimensional::march(mesh, drive, params);
    const double seconds = processor_seconds() - begin;
    auto file = opened(path);
    for (Index i = 0; i < mesh.nodes.cols(); ++i) {
        file << mesh.nodes.col(i).head<2>().norm() << ',' << mesh.nodes(2, i) << '\n';
    }
    std::cout << mesh.nodes.cols() << " nodes: largest change of area and volume in a step before its correction "
              << state.area_error << ", " << state.volume_error << "; sideways speed " << state.sideways
              << "; largest velocity relative to the centroid over the scale " << state.slip << '\n';
    return {std::to_string(mesh.nodes.cols()) + " nodes",
            state.velocity,
            state.length,
            state.radius,
            state.bending_energy,
            state.residual,
            seconds,
            state.steps};
}

/// Stationary states, differences from the series, seconds over those of the mesh of 642 nodes (the last row).
void scene(const std::string& directory, const std::string& name, const examples::Drive::Choice& flow,
           const three_dimensional::Drive& drive, const three_dimensional::MarchParams& params) {
    using examples::DiscretizationKind;
    std::cout << std::setprecision(3) << name << '\n';
    const std::string stem = directory + "/" + name + "_";
    std::vector<Row> rows{axisymmetric(stem + "series.csv", DiscretizationKind::spectral, 48, flow, 1e-7)};
    for (const Index n : {64, 260}) {
        rows.push_back(
            axisymmetric(stem + std::to_string(n) + ".csv", DiscretizationKind::linear, n, flow, params.residual));
    }
    for (const int levels : {2, 3}) {
        rows.push_back(spatial(stem + "space_" + std::to_string(levels) + ".csv", levels, drive, params));
    }
    std::cout
        << "| | velocity | length | radius | bending energy | velocity - series | length - series | residual | steps "
           "| seconds | over 642 nodes |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Row& row : rows) {
        std::cout << "| " << row.name << std::setprecision(6) << " | " << row.velocity << " | " << row.length << " | "
                  << row.radius << " | " << row.bending_energy << std::setprecision(2) << " | "
                  << 100 * (row.velocity / rows[0].velocity - 1) << " % | " << 100 * (row.length / rows[0].length - 1)
                  << " % | " << row.residual << " | " << row.steps << " | " << row.seconds << " | "
                  << row.seconds / rows.back().seconds << " |\n";
    }
    std::cout << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string directory = argc > 1 ? argv[1] : "";
    if (argc != 2 || directory.substr(0, 1) == "-") {
        std::cerr << "usage: three_dimensional DIR\n";
        return directory == "--help" ? EXIT_SUCCESS : 2;
    }
    try {
        three_dimensional::MarchParams params;
        params.residual = 5e-3;
        params.displacement = 0.1;
        params.longest_step = 1;
        params.most_steps = 60;
        scene(directory, "settling", Gravity<double>(47.0), {47, 0}, params);
        // Tensions are negative there: without smoothing nodes slide about.
        params.residual = 2e-2;
        params.displacement = 0.05;
        params.longest_step = 0.1;
        params.most_steps = 100;
        params.smoothing = 0.1;
        scene(directory, "poiseuille", UnboundedPoiseuille<double>(0.5), {0, 0.5}, params);
    } catch (const std::exception& error) {
        std::cerr << "three_dimensional: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
