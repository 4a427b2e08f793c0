// SPDX-License-Identifier: MIT
// The Stokeslet's single layer on linear triangles with linear densities, at the nodes.
#pragma once

#include "surface.hpp"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

namespace three_dimensional {

/// Accuracy of the integrals: a triangle whose centre is closer to the target than `split` times its longest edge is
/// divided into four, one farther away than `far` times that edge takes three points instead of seven.
struct QuadratureParams {
    double split = 1.5;
    double far = 4;
    Index singular_points = 10;  // on the edge opposite to the target
};

namespace detail {

/// Int G f_c dA of the hat functions f_c of a triangle: the upper triangle of each symmetric 3 x 3 block,
/// xx, yy, zz, xy, xz, yz a column.
using Blocks = Eigen::Matrix<double, 6, 3>;

/// Components of I/r + d d'/r^3.
inline Eigen::Matrix<double, 6, 1> stokeslet(const Vector3d& d) {
    const double inverse = 1 / d.norm();
    const double cube = inverse * inverse * inverse;
    Eigen::Matrix<double, 6, 1> g;
    g << inverse + cube * d[0] * d[0], inverse + cube * d[1] * d[1], inverse + cube * d[2] * d[2], cube * d[0] * d[1],
        cube * d[0] * d[2], cube * d[1] * d[2];
    return g;
}

/// Gauss-Legendre nodes and weights on (0, 1), from the eigenvalues of the Jacobi matrix.
struct UnitRule {
    explicit UnitRule(Index n) {
        MatrixXd jacobi = MatrixXd::Zero(n, n);
        for (Index k = 1; k < n; ++k) {
            const double kk = static_cast<double>(k);
            jacobi(k, k - 1) = jacobi(k - 1, k) = kk / std::sqrt(4 * kk * kk - 1);
        }
        const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(jacobi);
        nodes = (solver.eigenvalues().array() + 1) / 2;
        weights = solver.eigenvectors().row(0).cwiseAbs2();
    }
    VectorXd nodes;
    VectorXd weights;
};

/// Target at corner 0. With x = x0 + s (e + t (f - e)), dA = 2 A s ds dt: s cancels the 1/r, and integrates exactly.
inline Blocks singular_blocks(const Vector3d& e, const Vector3d& f, const UnitRule& rule) {
    Blocks sum = Blocks::Zero();
    const double area = e.cross(f).norm() / 2;
    for (Index q = 0; q < rule.nodes.size(); ++q) {
        const double t = rule.nodes[q];
        sum += stokeslet(e + t * (f - e)) * (area * rule.weights[q]) * Eigen::RowVector3d(1, 1 - t, t);
    }
    return sum;
}

/// `corners`: the triangle's, or a part's; `bary`: their barycentric coordinates on the whole triangle, a column each.
inline void add_regular(Blocks& sum, const Vector3d& target, const Matrix3d& corners, const Matrix3d& bary,
                        const QuadratureParams& params) {
    const double longest = std::sqrt(
        std::max({(corners.col(1) - corners.col(0)).squaredNorm(), (corners.col(2) - corners.col(1)).squaredNorm(),
                  (corners.col(0) - corners.col(2)).squaredNorm()}));
    const double distance = (corners.rowwise().mean() - target).norm();
    if (distance < params.split * longest) {
        Matrix3d halves = Matrix3d::Constant(0.5);
        halves.diagonal().setZero();  // column c: the middle of the edge opposite to corner c
        const Matrix3d middles = corners * halves;
        const Matrix3d bary_middles = bary * halves;
        add_regular(sum, target, middles, bary_middles, params);
        for (Index c = 0; c < 3; ++c) {
            Matrix3d part = middles;
            Matrix3d bary_part = bary_middles;
            part.col(c) = corners.col(c);
            bary_part.col(c) = bary.col(c);
            add_regular(sum, target, part, bary_part, params);
        }
        return;
    }
    const TriangleRule& rule = distance > params.far * longest ? coarse_rule() : fine_rule();
    const double area = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
    for (Index q = 0; q < rule.weights.size(); ++q) {
        const Vector3d point = corners * rule.points.col(q);
        const Vector3d shape = bary * rule.points.col(q);
        sum += stokeslet(target - point) * (area * rule.weights[q] * shape).transpose();
    }
}

}  // namespace detail

/// G with u = G f: velocities at the nodes, three rows a node, from force densities at the nodes; viscosity 1.
inline MatrixXd single_layer(const Mesh& mesh, const QuadratureParams& params = {}) {
    const detail::UnitRule rule(params.singular_points);
    const Index n = mesh.nodes.cols();
    MatrixXd g = MatrixXd::Zero(3 * n, 3 * n);
    for (const auto& t : mesh.triangles) {
        Matrix3d corners;
        corners << mesh.nodes.col(t[0]), mesh.nodes.col(t[1]), mesh.nodes.col(t[2]);
        for (Index i = 0; i < n; ++i) {
            detail::Blocks blocks = detail::Blocks::Zero();
            std::array<Index, 3> owner = t;
            if (i == t[0] || i == t[1] || i == t[2]) {
                const std::size_t c = i == t[0] ? 0 : i == t[1] ? 1 : 2;
                owner = {t[c], t[(c + 1) % 3], t[(c + 2) % 3]};
                blocks = detail::singular_blocks(mesh.nodes.col(owner[1]) - mesh.nodes.col(i),
                                                 mesh.nodes.col(owner[2]) - mesh.nodes.col(i), rule);
            } else {
                detail::add_regular(blocks, mesh.nodes.col(i), corners, Matrix3d::Identity(), params);
            }
            blocks /= 8 * kPi;
            for (std::size_t c = 0; c < 3; ++c) {
                const auto b = blocks.col(static_cast<Index>(c));
                auto target = g.block<3, 3>(3 * i, 3 * owner[c]);
                target.col(0) += Vector3d(b[0], b[3], b[4]);
                target.col(1) += Vector3d(b[3], b[1], b[5]);
                target.col(2) += Vector3d(b[4], b[5], b[2]);
            }
        }
    }
    return g;
}

}  // namespace three_dimensional
