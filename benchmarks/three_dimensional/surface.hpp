// SPDX-License-Identifier: MIT
// Closed triangulated surfaces in space: icospheres and spheroids, discrete curvatures, area and volume. Part of a
// model that is independent of the library (docs/three_dimensional.md) and shares nothing with it but Eigen.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace three_dimensional {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Points = Eigen::Matrix3Xd;
using SparseMatrix = Eigen::SparseMatrix<double>;

inline const double kPi = std::acos(-1.0);

/// Nodes, and triangles of three of them, counterclockwise seen from outside.
struct Mesh {
    Points nodes;
    std::vector<std::array<Index, 3>> triangles;
};

/// Points of the unit sphere: an icosahedron with nodes at both poles, each triangle divided into four `levels` times;
/// 10 * 4^levels + 2 nodes. Throws std::invalid_argument unless levels is in [0, 6].
inline Mesh icosphere(int levels) {
    if (levels < 0 || levels > 6) {
        throw std::invalid_argument("levels of an icosphere = " + std::to_string(levels) + ": must be in [0, 6]");
    }
    std::vector<Vector3d> nodes{Vector3d::UnitZ()};
    for (int k = 0; k < 10; ++k) {
        const double angle = kPi * k / 5;
        nodes.push_back(Vector3d(2 * std::cos(angle), 2 * std::sin(angle), k % 2 == 0 ? 1 : -1) / std::sqrt(5.0));
    }
    nodes.emplace_back(-Vector3d::UnitZ());
    std::vector<std::array<Index, 3>> triangles;
    for (Index k = 0; k < 10; ++k) {
        const std::array<Index, 3> next{1 + k, 1 + (k + 1) % 10, 1 + (k + 2) % 10};
        if (k % 2 == 0) {
            triangles.push_back({next[0], next[1], next[2]});
            triangles.push_back({0, next[0], next[2]});
        } else {
            triangles.push_back({next[0], next[2], next[1]});
            triangles.push_back({11, next[2], next[0]});
        }
    }
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<Index, Index>, Index> middles;
        const auto middle = [&](Index i, Index j) {
            const auto [place, fresh] = middles.try_emplace(std::minmax(i, j), static_cast<Index>(nodes.size()));
            if (fresh) {
                nodes.push_back((nodes[static_cast<std::size_t>(i)] + nodes[static_cast<std::size_t>(j)]).normalized());
            }
            return place->second;
        };
        std::vector<std::array<Index, 3>> finer;
        for (const auto& [i, j, k] : triangles) {
            const Index a = middle(j, k);
            const Index b = middle(k, i);
            const Index c = middle(i, j);
            finer.insert(finer.end(), {{i, c, b}, {c, j, a}, {b, a, k}, {a, b, c}});
        }
        triangles = std::move(finer);
    }
    Mesh mesh{Points(3, static_cast<Index>(nodes.size())), std::move(triangles)};
    for (Index i = 0; i < mesh.nodes.cols(); ++i) {
        mesh.nodes.col(i) = nodes[static_cast<std::size_t>(i)];
    }
    return mesh;
}

/// A quadrature rule on triangles: barycentric coordinates, and weights whose sum is 1.
struct TriangleRule {
    Eigen::Matrix3Xd points;
    VectorXd weights;
};

/// Three points, exact for polynomials of degree 2.
inline const TriangleRule& coarse_rule() {
    static const TriangleRule rule = [] {
        TriangleRule r{Eigen::Matrix3Xd::Constant(3, 3, 1.0 / 6), VectorXd::Constant(3, 1.0 / 3)};
        r.points.diagonal().setConstant(2.0 / 3);
        return r;
    }();
    return rule;
}

/// Seven points, exact for polynomials of degree 5 (Radon's rule).
inline const TriangleRule& fine_rule() {
    static const TriangleRule rule = [] {
        TriangleRule r{Eigen::Matrix3Xd::Constant(3, 7, 1.0 / 3), VectorXd::Constant(7, 9.0 / 40)};
        for (int sign = 0; sign < 2; ++sign) {
            const double root = sign == 0 ? std::sqrt(15.0) : -std::sqrt(15.0);
            auto block = r.points.middleCols<3>(1 + 3 * sign);
            block.setConstant((6 + root) / 21);
            block.diagonal().setConstant(1 - 2 * (6 + root) / 21);
            r.weights.segment<3>(1 + 3 * sign).setConstant((155 + root) / 1200);
        }
        return r;
    }();
    return rule;
}

/// Unit normals at the nodes, outward: the normals of the triangles weighted by sin(angle)/(product of both edges'
/// lengths), which makes them exact where the neighbours lie on a sphere.
inline Points normals(const Mesh& mesh) {
    Points n = Points::Zero(3, mesh.nodes.cols());
    for (const auto& t : mesh.triangles) {
        for (std::size_t c = 0; c < 3; ++c) {
            const Vector3d e = mesh.nodes.col(t[(c + 1) % 3]) - mesh.nodes.col(t[c]);
            const Vector3d f = mesh.nodes.col(t[(c + 2) % 3]) - mesh.nodes.col(t[c]);
            n.col(t[c]) += e.cross(f) / (e.squaredNorm() * f.squaredNorm());
        }
    }
    n.colwise().normalize();
    return n;
}

/// The middle of the edge from node i to node j on the cubic curve that leaves both along their tangent planes.
inline Vector3d middle(const Points& x, const Points& n, Index i, Index j) {
    const Vector3d e = x.col(j) - x.col(i);
    return (x.col(i) + x.col(j)) / 2 + (n.col(j) * n.col(j).dot(e) - n.col(i) * n.col(i).dot(e)) / 8;
}

struct Measures {
    double area = 0;
    double volume = 0;
};

/// Of the surface of quadratic triangles through the nodes and the middles of edges: error O(h^4).
inline Measures measures(const Mesh& mesh, const Points& n) {
    const TriangleRule& rule = fine_rule();
    Measures sum;
    for (const auto& [i, j, k] : mesh.triangles) {
        Eigen::Matrix<double, 3, 6> p;
        p << mesh.nodes.col(i), mesh.nodes.col(j), mesh.nodes.col(k), middle(mesh.nodes, n, j, k),
            middle(mesh.nodes, n, k, i), middle(mesh.nodes, n, i, j);
        for (Index q = 0; q < rule.weights.size(); ++q) {
            const Vector3d l = rule.points.col(q);
            Eigen::Matrix<double, 6, 1> shape;
            Eigen::Matrix<double, 6, 3> slope;  // with respect to each barycentric coordinate
            slope.setZero();
            for (int c = 0; c < 3; ++c) {
                const int d = (c + 1) % 3;
                const int e = (c + 2) % 3;
                shape[c] = l[c] * (2 * l[c] - 1);
                slope(c, c) = 4 * l[c] - 1;
                shape[3 + c] = 4 * l[d] * l[e];
                slope(3 + c, d) = 4 * l[e];
                slope(3 + c, e) = 4 * l[d];
            }
            const Matrix3d tangents = p * slope;
            const Vector3d normal =
                (tangents.col(1) - tangents.col(0)).cross(tangents.col(2) - tangents.col(0)) * rule.weights[q] / 2;
            sum.area += normal.norm();
            sum.volume += (p * shape).dot(normal) / 3;
        }
    }
    return sum;
}

/// v -> a x v.
inline Matrix3d cross_matrix(const Vector3d& a) {
    Matrix3d m;
    m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    return m;
}

/// Linear finite elements on the triangles (Dziuk, Numer. Math. 111 (2008) 55). The polyhedron's area has the gradient
/// g and the Hessian L; the mean curvature vector y = 2 H n satisfies M y = g, M the mass matrix of the hat functions,
/// and the bending energy is y' M y/2. Vectors of three components a node are x, y, z node by node.
struct Surface {
    explicit Surface(const Mesh& mesh)
        : normal(normals(mesh)),
          mass(mesh.nodes.cols(), mesh.nodes.cols()),
          lumped(VectorXd::Zero(mesh.nodes.cols())),
          flux(Points::Zero(3, mesh.nodes.cols())),
          buoyancy(Points::Zero(3, mesh.nodes.cols())),
          area_hessian(3 * mesh.nodes.cols(), 3 * mesh.nodes.cols()),
          area_slopes(mesh.nodes.cols(), 3 * mesh.nodes.cols()),
          triangle_slopes_(static_cast<Index>(mesh.triangles.size()), 3 * mesh.nodes.cols()),
          triangles_(mesh.triangles) {
        std::vector<Eigen::Triplet<double>> masses;
        std::vector<Eigen::Triplet<double>> slopes;
        std::vector<Eigen::Triplet<double>> of_triangles;
        std::vector<Eigen::Triplet<double>> hessian;
        const auto add = [&](Index row, Index column, const Matrix3d& block) {
            for (Index i = 0; i < 3; ++i) {
                for (Index j = 0; j < 3; ++j) {
                    hessian.emplace_back(3 * row + i, 3 * column + j, block(i, j));
                }
            }
        };
        for (std::size_t e = 0; e < mesh.triangles.size(); ++e) {
            const auto& t = mesh.triangles[e];
            Matrix3d x;
            x << mesh.nodes.col(t[0]), mesh.nodes.col(t[1]), mesh.nodes.col(t[2]);
            // The vector of twice the area changes by v x d[c] where corner c moves by v.
            Matrix3d d;
            d << x.col(1) - x.col(2), x.col(2) - x.col(0), x.col(0) - x.col(1);
            const Vector3d twice = d.col(1).cross(d.col(2));
            const double twice_area = twice.norm();
            const Vector3d n = twice / twice_area;
            const Eigen::RowVector3d z = x.row(2);
            const double z_squared = (z.squaredNorm() + z.sum() * z.sum()) / 12;  // mean over the triangle
            for (Index c = 0; c < 3; ++c) {
                const Index i = t[static_cast<std::size_t>(c)];
                lumped[i] += twice_area / 6;
                flux.col(i) += x.col((c + 1) % 3).cross(x.col((c + 2) % 3)) / 6;
                buoyancy.col(i) += z_squared / 4 * d.col(c).cross(Vector3d::UnitZ());
                buoyancy(2, i) += twice[2] / 4 * (z[c] + z.sum()) / 6;
                const Vector3d slope = d.col(c).cross(n) / 2;  // of the triangle's area
                for (Index a = 0; a < 3; ++a) {
                    of_triangles.emplace_back(static_cast<Index>(e), 3 * i + a, slope[a]);
                    for (const Index k : t) {
                        slopes.emplace_back(k, 3 * i + a, slope[a] / 3);
                    }
                }
                for (Index b = 0; b < 3; ++b) {
                    const Index k = t[static_cast<std::size_t>(b)];
                    masses.emplace_back(i, k, twice_area / (i == k ? 12 : 24));
                    Matrix3d block = cross_matrix(d.col(c)).transpose() * (Matrix3d::Identity() - n * n.transpose()) *
                                     cross_matrix(d.col(b)) / (2 * twice_area);
                    if (b != c) {
                        block += ((b + 3 - c) % 3 == 1 ? -0.5 : 0.5) * cross_matrix(n);
                    }
                    add(i, k, block);
                }
            }
        }
        mass.setFromTriplets(masses.begin(), masses.end());
        area_slopes.setFromTriplets(slopes.begin(), slopes.end());
        area_hessian.setFromTriplets(hessian.begin(), hessian.end());
        triangle_slopes_.setFromTriplets(of_triangles.begin(), of_triangles.end());
        mass_solver_.compute(mass);
        curvature = over_mass(area_slopes.transpose() * VectorXd::Ones(mesh.nodes.cols())).reshaped(3, normal.cols());
        mean = curvature.cwiseProduct(normal).colwise().sum().transpose() / 2;
    }

    /// Nodal values of what has these integrals against the hat functions, in every column.
    MatrixXd over_mass(MatrixXd integrals) const {
        const Index n = mass.rows();
        for (Index a = 0; a < 3; ++a) {
            Eigen::Map<MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 3>> part(integrals.data() + a, n, integrals.cols(),
                                                                           Eigen::Stride<Eigen::Dynamic, 3>(3 * n, 3));
            part = mass_solver_.solve(MatrixXd(part));
        }
        return integrals;
    }

    /// From each node along the surface to the middle of its neighbours.
    Points smoothing(const Points& nodes) const {
        Points step(3, nodes.cols());
        for (Index i = 0; i < nodes.cols(); ++i) {
            Vector3d sum = Vector3d::Zero();
            double count = 0;
            for (SparseMatrix::InnerIterator entry(mass, i); entry; ++entry) {
                sum += nodes.col(entry.row()) - nodes.col(i);
                count += entry.row() == i ? 0 : 1;
            }
            step.col(i) = sum / count;
        }
        return step - normal * step.cwiseProduct(normal).colwise().sum().asDiagonal();
    }

    double bending_energy() const { return (curvature * mass).cwiseProduct(curvature).sum() / 2; }

    /// Minus the bending energy's gradient: -L y + (y' dM y)/2.
    VectorXd bending_force() const {
        VectorXd share(triangle_slopes_.rows());  // of a triangle: Int |y|^2/2 over its area
        for (Index e = 0; e < share.size(); ++e) {
            const auto& t = triangles_[static_cast<std::size_t>(e)];
            Matrix3d y;
            y << curvature.col(t[0]), curvature.col(t[1]), curvature.col(t[2]);
            share[e] = (y.squaredNorm() + y.rowwise().sum().squaredNorm()) / 24;
        }
        return triangle_slopes_.transpose() * share - area_hessian * VectorXd(curvature.reshaped());
    }

    Points normal;
    SparseMatrix mass;
    VectorXd lumped;            // Int f_i dA
    Points flux;                // dV/dx, V the volume of the polyhedron
    Points buoyancy;            // d/dx of Int z dV
    SparseMatrix area_hessian;  // of the whole area
    SparseMatrix area_slopes;   // row i: d/dx of a third of the area of the triangles around node i
    Points curvature;           // 2 H n, H > 0 on a sphere
    VectorXd mean;

  private:
    Eigen::SimplicialLLT<SparseMatrix> mass_solver_;
    SparseMatrix triangle_slopes_;
    std::vector<std::array<Index, 3>> triangles_;
};

/// Moves the nodes along the normals by a + b H until area and volume are as given. Throws std::runtime_error if that
/// does not succeed.
inline void restore(Mesh& mesh, const Measures& wanted) {
    for (int iteration = 0; iteration < 20; ++iteration) {
        const Surface surface(mesh);
        const Measures now = measures(mesh, surface.normal);
        const Eigen::Vector2d missing(wanted.area - now.area, wanted.volume - now.volume);
        if (missing.cwiseAbs().maxCoeff() < 1e-13 * wanted.area) {
            return;
        }
        const VectorXd& h = surface.mean;
        const VectorXd& w = surface.lumped;
        Eigen::Matrix2d slope;
        slope << 2 * w.dot(h), 2 * w.dot(h.cwiseAbs2()), w.sum(), w.dot(h);
        const Eigen::Vector2d step = slope.fullPivLu().solve(missing);
        mesh.nodes += surface.normal * (step[0] + step[1] * h.array()).matrix().asDiagonal();
    }
    throw std::runtime_error("area and volume cannot be restored");
}

/// Prolate, of volume 4 pi/3 and area 4 pi + excess_area, along z. Throws std::invalid_argument unless 0 < excess_area.
inline Mesh prolate_spheroid(double excess_area, int levels) {
    if (!(excess_area > 0)) {
        throw std::invalid_argument("excess area = " + std::to_string(excess_area) + ": must be > 0");
    }
    const auto area = [](double c) {
        const double a = 1 / std::sqrt(c);
        const double e = std::sqrt(1 - a * a / (c * c));
        return 2 * kPi * a * (a + c * std::asin(e) / e);
    };
    double low = 1 + 1e-9;
    double high = 2;
    while (area(high) < 4 * kPi + excess_area) {
        high *= 2;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle_c = (low + high) / 2;
        (area(middle_c) < 4 * kPi + excess_area ? low : high) = middle_c;
    }
    Mesh mesh = icosphere(levels);
    mesh.nodes = Vector3d(1 / std::sqrt(low), 1 / std::sqrt(low), low).asDiagonal() * mesh.nodes;
    restore(mesh, {4 * kPi + excess_area, 4 * kPi / 3});
    return mesh;
}

}  // namespace three_dimensional
