// SPDX-License-Identifier: MIT
// The pieces of the model in space (benchmarks/three_dimensional/) against closed forms.
#include "../benchmarks/three_dimensional/vesicle.hpp"
#include "catch.hpp"

#include <array>
#include <cmath>

using namespace three_dimensional;

namespace {

/// Prolate with semi-axes a, c: 2 Int H^2 dA by the midpoint rule, and the area.
double spheroid_energy(double a, double c) {
    const int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = kPi * (i + 0.5) / steps;
        const double speed = std::hypot(a * std::cos(t), c * std::sin(t));
        const double h = (a * c / (speed * speed * speed) + c / (a * speed)) / 2;
        sum += 2 * h * h * 2 * kPi * a * std::sin(t) * speed * kPi / steps;
    }
    return sum;
}

Mesh spheroid(double a, double c, int levels) {
    Mesh mesh = icosphere(levels);
    mesh.nodes = Vector3d(a, a, c).asDiagonal() * mesh.nodes;
    return mesh;
}

}  // namespace

TEST_CASE("area and volume of a sphere converge in the fourth order, bending energies in the second") {
    std::array<double, 3> area{};
    std::array<double, 3> volume{};
    std::array<double, 3> energy{};
    std::array<double, 3> spheroids{};
    for (const int level : {2, 3, 4}) {
        const Mesh mesh = icosphere(level);
        const Surface surface(mesh);
        const Measures sphere = measures(mesh, surface.normal);
        const auto k = static_cast<std::size_t>(level - 2);
        area[k] = std::abs(sphere.area / (4 * kPi) - 1);
        volume[k] = std::abs(sphere.volume / (4 * kPi / 3) - 1);
        energy[k] = std::abs(surface.bending_energy() / (8 * kPi) - 1);
        spheroids[k] = std::abs(Surface(spheroid(0.8, 1.4, level)).bending_energy() / spheroid_energy(0.8, 1.4) - 1);
    }
    CHECK(area[2] < 3e-6);
    CHECK(volume[2] < 4e-6);
    CHECK(energy[2] < 5e-4);
    CHECK(spheroids[2] < 2e-3);
    for (const std::size_t k : {0U, 1U}) {
        CHECK(std::log2(area[k] / area[k + 1]) > 3.8);
        CHECK(std::log2(volume[k] / volume[k + 1]) > 3.8);
        CHECK(std::log2(energy[k] / energy[k + 1]) > 1.9);
        CHECK(std::log2(spheroids[k] / spheroids[k + 1]) > 1.8);
    }
}

TEST_CASE("forces are the gradients of their energies") {
    const Mesh mesh = spheroid(0.8, 1.4, 2);
    const Surface surface(mesh);
    const Index n = mesh.nodes.cols();
    VectorXd direction(3 * n);
    for (Index i = 0; i < 3 * n; ++i) {
        direction[i] = std::sin(static_cast<double>(7 * i + 1));
    }
    const double h = 1e-5;
    const auto moved = [&](double step) {
        Mesh other = mesh;
        other.nodes += step * direction.reshaped(3, n);
        return other;
    };
    const Mesh ahead = moved(h);
    const Mesh behind = moved(-h);
    const Surface a(ahead);
    const Surface b(behind);
    const double slope = (a.bending_energy() - b.bending_energy()) / (2 * h);
    CHECK(-surface.bending_force().dot(direction) == Approx(slope).epsilon(1e-5));
    // Int z dV of the polyhedron, tetrahedron by tetrahedron.
    const auto first_moment = [](const Mesh& m) {
        double sum = 0;
        for (const auto& [i, j, k] : m.triangles) {
            sum += m.nodes.col(i).dot(m.nodes.col(j).cross(m.nodes.col(k))) / 24 *
                   (m.nodes(2, i) + m.nodes(2, j) + m.nodes(2, k));
        }
        return sum;
    };
    CHECK(surface.buoyancy.reshaped().dot(direction) ==
          Approx((first_moment(ahead) - first_moment(behind)) / (2 * h)).epsilon(1e-6));
    // The area's gradient and Hessian.
    const VectorXd ones = VectorXd::Ones(n);
    const VectorXd change = (a.area_slopes - b.area_slopes).transpose() * ones / (2 * h);
    CHECK((surface.area_hessian * direction - change).norm() < 1e-6 * change.norm());
    CHECK(ones.dot(surface.area_slopes * direction) ==
          Approx((a.lumped.sum() - b.lumped.sum()) / (2 * h)).epsilon(1e-6));
}

TEST_CASE("uniform traction moves a sphere like Stokes' law") {
    std::array<double, 2> error{};
    for (const int level : {1, 2}) {
        const Mesh mesh = icosphere(level);
        VectorXd traction = VectorXd::Zero(3 * mesh.nodes.cols());
        for (Index i = 0; i < mesh.nodes.cols(); ++i) {
            traction[3 * i + 2] = 1 / (4 * kPi);
        }
        const VectorXd u = 6 * kPi * (single_layer(mesh) * traction);
        for (Index i = 0; i < mesh.nodes.cols(); ++i) {
            const double deviation = (u.segment<3>(3 * i) - Vector3d::UnitZ()).norm();
            error[static_cast<std::size_t>(level - 1)] =
                std::max(error[static_cast<std::size_t>(level - 1)], deviation);
        }
    }
    CHECK(error[1] < 0.02);
    CHECK(std::log2(error[0] / error[1]) > 1.9);
}

TEST_CASE("a spheroid has the area and volume asked for") {
    const Mesh mesh = prolate_spheroid(0.6, 2);
    const Measures now = measures(mesh, normals(mesh));
    CHECK(now.area == Approx(4 * kPi + 0.6).epsilon(1e-12));
    CHECK(now.volume == Approx(4 * kPi / 3).epsilon(1e-12));
}

TEST_CASE("the model in space refuses what it cannot make") {
    CHECK_THROWS_AS(icosphere(7), std::invalid_argument);
    CHECK_THROWS_AS(prolate_spheroid(-1, 2), std::invalid_argument);
}
