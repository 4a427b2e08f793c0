// SPDX-License-Identifier: MIT
// The equations of a stationary state, w = 0 with area, volume and axial position given, and their linearisation
// (docs/stationary.md).
#pragma once

#include "velocity_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

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
    point.frozen = scene.freeze(point.configuration);
    point.instant = scene.evaluate(point.frozen, point.configuration, S(0));
    point.velocity =
        relative_normal_velocity<S>(point.instant.surface, point.configuration.shape.z, point.instant.solution.velocity)
            .second;
    point.residual = point.instant.deformation_rate / std::max(S(1), scene.velocity_scale());
}

/// Restores area and volume and puts the centroid at 0; false if the shape is unusable.
template <class SceneType, class S>
bool settle(const SceneType& scene, Configuration<S>& configuration, const S& area, const S& volume) {
    Meridian<S>& shape = configuration.shape;
    const auto proper = [&] { return fault(shape).empty() && scene.film_thickness(configuration).min > S(0); };
    if (!proper() || !scene.discretization().restore(shape, area, volume) || !proper()) {
        return false;
    }
    shape.z.array() -= scene.discretization().measures(shape).centroid;
    return true;
}

/// Rows: the change of volume, area and centroid by a normal displacement (phi, 2 H phi and z phi integrated).
/// Columns: the displacements n, H n and the translation that correct them.
template <class S, class Surface>
std::pair<Matrix<S>, Matrix<S>> constraints(const Surface& surface, const Vector<S>& z) {
    const Index n = surface.size();
    Matrix<S> gradients(3, n);
    gradients.row(0) = surface.weight.transpose();
    gradients.row(1) = 2 * surface.weight.cwiseProduct(surface.mean_curvature).transpose();
    gradients.row(2) = surface.weight.cwiseProduct(z).transpose();
    Matrix<S> corrections(n, 3);
    corrections << Vector<S>::Ones(n), surface.mean_curvature, surface.normal_z;
    return {std::move(gradients), std::move(corrections)};
}

/// [J, n H n_z; constraints, 0]: unknowns phi and three multipliers that vanish with w. They take up what is left of
/// w's three exact dependencies.
template <class S, class Surface>
Matrix<S> bordered(const Surface& surface, const Vector<S>& z, const Matrix<S>& jacobian) {
    const Index n = jacobian.rows();
    const auto [gradients, corrections] = constraints<S>(surface, z);
    Matrix<S> system = Matrix<S>::Zero(n + 3, n + 3);
    system.topLeftCorner(n, n) = jacobian;
    system.topRightCorner(n, 3) = corrections;
    system.bottomLeftCorner(3, n) = gradients;
    return system;
}

/// Eigenvalues of J on the displacements that keep area, volume and centroid, largest real part first.
template <class S, class Surface>
std::vector<std::complex<S>> growth_rates(const Surface& surface, const Vector<S>& z, const Matrix<S>& jacobian) {
    const Index n = surface.size();
    const auto [gradients, corrections] = constraints<S>(surface, z);
    const Matrix<S> basis = Matrix<S>(Matrix<S>(gradients.transpose()).householderQr().householderQ()).rightCols(n - 3);
    const Matrix<S> kept =
        jacobian - corrections * (gradients * corrections).partialPivLu().solve(gradients * jacobian);
    const Matrix<S> reduced = basis.transpose() * kept * basis;
    const Vector<std::complex<S>> values = reduced.eigenvalues();
    std::vector<std::complex<S>> rates(values.data(), values.data() + values.size());
    std::sort(rates.begin(), rates.end(), [](const auto& a, const auto& b) { return a.real() > b.real(); });
    return rates;
}

}  // namespace axistokes::detail
