// SPDX-License-Identifier: MIT
// The linearised equations of a stationary state, w = 0 with volumes, the first body's place and, of laws that keep
// them, areas given; growth rates; and what Newton's method and continuation do alike (docs/stationary.md).
#pragma once

#include "velocity_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// Rows: the change of each deformable body's volume and, if its law keeps it, of its area by normal displacements phi
/// (phi and 2 H phi integrated), and of the first body's place. Columns: the displacements n, H n and the translation
/// that correct them.
template <class S>
struct StationaryConstraints {
    Matrix<S> gradients;
    Matrix<S> corrections;
    std::vector<Index> volumes;  // rows; -1 of rigid bodies
    std::vector<Index> areas;    // likewise, and of laws that do not keep them

    Index size() const { return gradients.rows(); }
};

template <class SceneType>
StationaryConstraints<typename SceneType::Scalar> constraints(const SceneType& scene,
                                                              const StationaryPoint<SceneType>& point) {
    using S = typename SceneType::Scalar;
    const StationaryLayout layout(scene, point.bodies);
    StationaryConstraints<S> result;
    Index count = 1;
    for (std::size_t b = 0; b < point.bodies.size(); ++b) {
        const bool deforms = scene.deforms(b);
        result.volumes.push_back(deforms ? count++ : -1);
        result.areas.push_back(deforms && keeps_area(scene.law(b)) ? count++ : -1);
    }
    result.gradients = Matrix<S>::Zero(count, layout.all());
    result.corrections = Matrix<S>::Zero(layout.all(), count);
    for (std::size_t b = 0; b < point.bodies.size(); ++b) {
        const auto& surface = point.surface(b);
        const Index begin = layout.unknowns[b];
        const Index n = layout.unknowns[b + 1] - begin;
        if (b == 0) {
            if (scene.deforms(b)) {
                result.gradients.row(0).segment(begin, n) =
                    surface.weight.cwiseProduct(point.bodies[b].shape.z).transpose();
                result.corrections.col(0).segment(begin, n) = surface.normal_z;
            } else {
                result.gradients(0, begin) = result.corrections(begin, 0) = S(1);
            }
        }
        if (scene.deforms(b)) {
            result.gradients.row(result.volumes[b]).segment(begin, n) = surface.weight.transpose();
            result.corrections.col(result.volumes[b]).segment(begin, n).setOnes();
        }
        if (result.areas[b] >= 0) {
            result.gradients.row(result.areas[b]).segment(begin, n) =
                2 * surface.weight.cwiseProduct(surface.mean_curvature).transpose();
            result.corrections.col(result.areas[b]).segment(begin, n) = surface.mean_curvature;
        }
    }
    return result;
}

/// [J, corrections; constraints, 0]: unknowns phi and multipliers that vanish with w. They take up what is left of w's
/// exact dependencies.
template <class S>
Matrix<S> bordered(const StationaryConstraints<S>& constraints, const Matrix<S>& jacobian) {
    const Index n = jacobian.rows();
    const Index count = constraints.size();
    Matrix<S> system = Matrix<S>::Zero(n + count, n + count);
    system.topLeftCorner(n, n) = jacobian;
    system.topRightCorner(n, count) = constraints.corrections;
    system.bottomLeftCorner(count, n) = constraints.gradients;
    return system;
}

/// Eigenvalues of J on the displacements that keep the constraints G phi = 0, largest real part first.
///
/// With the corrections C, J - C (G C)^-1 (G J + s G) takes these displacements to such ones and all others, up to such
/// ones, to -s times themselves: it has the eigenvalues wanted, and -s as often as there are constraints. A large s
/// tells them apart.
template <class S>
std::vector<std::complex<S>> growth_rates(const StationaryConstraints<S>& constraints, const Matrix<S>& jacobian) {
    const Matrix<S>& gradients = constraints.gradients;
    const Matrix<S>& corrections = constraints.corrections;
    const Eigen::PartialPivLU<Matrix<S>> lu(Matrix<S>(gradients * corrections));
    Matrix<S> kept = jacobian - corrections * lu.solve(gradients * jacobian);
    const S shift = 2 * kept.cwiseAbs().rowwise().sum().maxCoeff();
    kept -= shift * corrections * lu.solve(gradients);
    const Vector<std::complex<S>> values = kept.eigenvalues();
    std::vector<std::complex<S>> rates(values.data(), values.data() + values.size());
    // Those of the constraints first, to be cut off.
    std::sort(rates.begin(), rates.end(),
              [&](const auto& a, const auto& b) { return std::abs(a + shift) < std::abs(b + shift); });
    rates.erase(rates.begin(), rates.begin() + gradients.rows());
    std::sort(rates.begin(), rates.end(), [](const auto& a, const auto& b) { return a.real() > b.real(); });
    return rates;
}

}  // namespace axistokes::detail
