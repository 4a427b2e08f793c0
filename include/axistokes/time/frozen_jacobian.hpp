// SPDX-License-Identifier: MIT
// Most of the derivative of a vesicle's normal velocity with respect to normal displacements, without a single-layer
// assembly (docs/stationary.md).
#pragma once

#include "../membrane/vesicle.hpp"
#include "../scene.hpp"

#include <Eigen/LU>

namespace axistokes::detail {

/// Normal velocity relative to the centroid's.
template <class InstantType>
auto relative_normal_velocity(const InstantType& instant) {
    const auto& surface = instant.surface;
    const Index n = surface.size();
    const auto& u = instant.solution.velocity;
    using S = std::decay_t<decltype(u[0])>;
    return Vector<S>(surface.normal_r.cwiseProduct(u.head(n)) + surface.normal_z.cwiseProduct(u.tail(n)) -
                     instant.velocity * surface.normal_z);
}

/// Moves the nodes by `displacement` along the normals of `surface`; the poles stay on the axis.
template <class S, class Surface>
void displace(Meridian<S>& shape, const Surface& surface, const Vector<S>& displacement) {
    const Index n = shape.nodes();
    shape.r += surface.normal_r.cwiseProduct(displacement);
    shape.z += surface.normal_z.cwiseProduct(displacement);
    shape.r[0] = shape.r[n - 1] = 0;
}

/// d(normal velocity)/d(normal displacement) with the single layer frozen: u = u_inf + G (F + load) + G T gamma, the
/// tension eliminated by D u = 0. The derivatives of F, of the load and of u_inf are one-sided differences. What is
/// left out, (dG) f, is smoother by three derivatives, and vanishes for no force.
template <class SceneType>
Matrix<typename SceneType::Scalar> frozen_jacobian(SceneType& scene, const typename SceneType::Frozen& frozen,
                                                   const Configuration<typename SceneType::Scalar>& configuration,
                                                   const typename SceneType::InstantType& instant) {
    using std::sqrt;
    using S = typename SceneType::Scalar;
    const auto& surface = frozen.surface;
    const Index n = surface.size();
    const Vector<S>& tension = instant.solution.tension;
    const auto& membrane = scene.membrane();
    const Vector<S> force = membrane.force(surface, tension) + frozen.load;
    const Vector<S> flow = scene.background_velocity(configuration);
    const S step = sqrt(std::numeric_limits<S>::epsilon());
    Matrix<S> force_change(2 * n, n);
    Matrix<S> flow_change(2 * n, n);
    for (Index j = 0; j < n; ++j) {
        Configuration<S> moved = configuration;
        displace<S>(moved.shape, surface, step * Vector<S>::Unit(n, j));
        const auto at = scene.discretization().surface(moved.shape);
        force_change.col(j) = (membrane.force(at, tension) + scene.normal_load(moved, at) - force) / step;
        flow_change.col(j) = (scene.background_velocity(moved) - flow) / step;
    }
    Matrix<S> g = frozen.mobility;
    complete_rank<S>(surface, g);
    Matrix<S> change = g * force_change + flow_change;
    const Matrix<S> pull = g * surface.tension_force;
    const Matrix<S> divergence_of_pull = surface.divergence * pull;
    const Matrix<S> divergence_of_change = surface.divergence * change;
    change -= pull * divergence_of_pull.partialPivLu().solve(divergence_of_change);

    Matrix<S> jacobian =
        surface.normal_r.asDiagonal() * change.topRows(n) + surface.normal_z.asDiagonal() * change.bottomRows(n);
    const Vector<S> moment = surface.weight.cwiseProduct(configuration.shape.z);
    jacobian -= (surface.normal_z * (moment.transpose() * jacobian / moment.dot(surface.normal_z))).eval();
    return jacobian;
}

}  // namespace axistokes::detail
