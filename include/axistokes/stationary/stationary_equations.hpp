// SPDX-License-Identifier: MIT
// The equations of a stationary state, w = 0 with volume, axial position and, if the law keeps it, area given, and
// their linearisation (docs/stationary.md).
#pragma once

#include "../geometry/conserved.hpp"
#include "velocity_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// A shape, and the velocities on it.
template <class SceneType>
struct StationaryPoint {
    using Scalar = typename SceneType::Scalar;

    Configuration<Scalar> configuration;
    typename SceneType::Frozen frozen;
    typename SceneType::InstantType instant;
    Vector<Scalar> velocity;  // normal, relative to the centroid
    Scalar residual{};        // as in StepRecord
};

template <class SceneType>
void evaluate(SceneType& scene, StationaryPoint<SceneType>& point) {
    using S = typename SceneType::Scalar;
    const typename SceneType::State state{point.configuration};
    point.frozen = scene.freeze(state);
    point.instant = std::move(scene.evaluate(point.frozen, state, S(0)).front());
    point.velocity =
        relative_normal_velocity<S>(point.instant.surface, point.configuration.shape.z, point.instant.solution.velocity)
            .second;
    point.residual = point.instant.deformation_rate / std::max(S(1), scene.velocity_scale());
}

/// What the one body of a scene conserves, with the values given.
template <class SceneType, class S>
Conserved<S> conserved_in(const SceneType& scene, const S& area, const S& volume) {
    return {Measures<S>{area, volume, S(0)}, keeps_area(scene.law())};
}

/// Restores what the body conserves and puts the centroid at 0; false if the shape is unusable.
template <class SceneType, class S>
bool settle(const SceneType& scene, Configuration<S>& configuration, const Conserved<S>& conserved) {
    Meridian<S>& shape = configuration.shape;
    if (!scene.fault(configuration).empty() || !conserved.restore(scene.discretization(), shape) ||
        !scene.fault(configuration).empty()) {
        return false;
    }
    shape.z.array() -= scene.discretization().measures(shape).centroid;
    return true;
}

/// Rows: the change of volume, of the centroid and, if the law keeps it, of the area by a normal displacement phi (phi,
/// z phi and 2 H phi integrated). Columns: the displacements n, the translation and H n that correct them.
template <class S, class Surface>
std::pair<Matrix<S>, Matrix<S>> constraints(const Surface& surface, const Vector<S>& z, bool keeps_area) {
    const Index n = surface.size();
    const Index count = keeps_area ? 3 : 2;
    Matrix<S> gradients(count, n);
    Matrix<S> corrections(n, count);
    gradients.row(0) = surface.weight.transpose();
    gradients.row(1) = surface.weight.cwiseProduct(z).transpose();
    corrections.col(0).setOnes();
    corrections.col(1) = surface.normal_z;
    if (keeps_area) {
        gradients.row(2) = 2 * surface.weight.cwiseProduct(surface.mean_curvature).transpose();
        corrections.col(2) = surface.mean_curvature;
    }
    return {std::move(gradients), std::move(corrections)};
}

/// [J, corrections; constraints, 0]: unknowns phi and multipliers that vanish with w. They take up what is left of w's
/// exact dependencies.
template <class S, class Surface>
Matrix<S> bordered(const Surface& surface, const Vector<S>& z, const Matrix<S>& jacobian, bool keeps_area) {
    const Index n = jacobian.rows();
    const auto [gradients, corrections] = constraints<S>(surface, z, keeps_area);
    const Index count = gradients.rows();
    Matrix<S> system = Matrix<S>::Zero(n + count, n + count);
    system.topLeftCorner(n, n) = jacobian;
    system.topRightCorner(n, count) = corrections;
    system.bottomLeftCorner(count, n) = gradients;
    return system;
}

/// Eigenvalues of J on the displacements that keep the constraints G phi = 0, largest real part first.
///
/// With the corrections C, J - C (G C)^-1 (G J + s G) takes these displacements to such ones and all others, up to such
/// ones, to -s times themselves: it has the eigenvalues wanted, and -s as often as there are constraints. A large s
/// tells them apart.
template <class S, class Surface>
std::vector<std::complex<S>> growth_rates(const Surface& surface, const Vector<S>& z, const Matrix<S>& jacobian,
                                          bool keeps_area) {
    const auto [gradients, corrections] = constraints<S>(surface, z, keeps_area);
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
