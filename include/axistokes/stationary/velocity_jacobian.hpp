// SPDX-License-Identifier: MIT
// Derivative of an interface's normal velocity with respect to normal displacements of its nodes, whatever its law
// (docs/stationary.md).
#pragma once

#include "../equation/flux.hpp"
#include "../geometry/series_transfer.hpp"
#include "../scene.hpp"
#include "coarse_scene.hpp"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <type_traits>

namespace axistokes::detail {

/// Moves the nodes by `displacement` along the normals of `surface`; the poles stay on the axis.
template <class S, class Surface>
void displace(Meridian<S>& shape, const Surface& surface, const Vector<S>& displacement) {
    const Index n = shape.nodes();
    shape.r += surface.normal_r.cwiseProduct(displacement);
    shape.z += surface.normal_z.cwiseProduct(displacement);
    shape.r[0] = shape.r[n - 1] = 0;
}

/// Change of the velocity G f + (what walls add to the flow) at the nodes, f fixed, with the amplitudes of the first
/// modes cos(kt) of the normal displacement: 2n x modes. Differences, one-sided or central: an assembly for each mode,
/// or two.
template <class SceneType>
Matrix<typename SceneType::Scalar> mobility_change(SceneType& scene,
                                                   const Configuration<typename SceneType::Scalar>& configuration,
                                                   const Vector<typename SceneType::Scalar>& force, Index modes,
                                                   const typename SceneType::Scalar& step, bool central) {
    using std::cos;
    using S = typename SceneType::Scalar;
    const Index n = configuration.shape.nodes();
    const auto velocity = [&](const Configuration<S>& at, auto& surface) {
        auto frozen = scene.freeze({at});
        surface = std::move(frozen.bodies.front().surface);
        Vector<S> u = frozen.mobility * force;
        if constexpr (std::decay_t<decltype(scene.wall())>::present) {
            u += frozen.background - without_flux<S>(surface, scene.background_velocity(at));
        }
        return u;
    };
    typename SceneType::Surface surface;
    typename SceneType::Surface moved_surface;
    const Vector<S> here = velocity(configuration, surface);
    Matrix<S> change(2 * n, modes);
    Vector<S> mode(n);
    for (Index k = 0; k < modes; ++k) {
        for (Index i = 0; i < n; ++i) {
            mode[i] = step * cos(pi_value<S>() * S(k * i % (2 * (n - 1))) / S(n - 1));
        }
        const auto displaced = [&](const S& factor) {
            Configuration<S> moved = configuration;
            displace<S>(moved.shape, surface, factor * mode);
            return velocity(moved, moved_surface);
        };
        if (central) {
            change.col(k) = (displaced(S(1)) - displaced(S(-1))) / (2 * step);
        } else {
            change.col(k) = (displaced(S(1)) - here) / step;
        }
    }
    return change;
}

/// The change of G f with normal displacements, found on a coarse meridian: it is smoother by three derivatives than
/// that of the bending force. Kept as modes, it serves any number of nodes, and shapes near by.
template <class SceneType>
class MobilityChange {
  public:
    using S = typename SceneType::Scalar;

    Index degree() const { return degree_; }

    /// For an iteration: one-sided differences, the first three quarters of the modes.
    void find(SceneType& coarse, const Configuration<S>& configuration, const Vector<S>& force, Index degree) {
        find(coarse, configuration, force, degree, (3 * degree) / 4, false);
    }
    /// For growth rates, in films no thicker than some hundred steps of the differences too: central ones, all modes.
    void find_accurately(SceneType& coarse, const Configuration<S>& configuration, const Vector<S>& force,
                         Index degree) {
        find(coarse, configuration, force, degree, degree + 1, true);
    }

    /// 2n x n, once found.
    Matrix<S> at_nodes(Index n) const {
        const auto up = SeriesTransfer<S>::between(degree_, n - 1);
        const auto down = SeriesTransfer<S>::between(n - 1, degree_);
        const Matrix<S> by_node = change_ * down->amplitudes.topRows(change_.cols());
        Matrix<S> result(2 * n, n);
        result << up->odd * by_node.topRows(degree_ + 1), up->even * by_node.bottomRows(degree_ + 1);
        return result;
    }

  private:
    void find(SceneType& coarse, const Configuration<S>& configuration, const Vector<S>& force, Index degree,
              Index modes, bool central) {
        degree_ = degree;
        const Index n = configuration.shape.nodes();
        const auto down = SeriesTransfer<S>::between(n - 1, degree);
        const Configuration<S> there{resampled(configuration.shape, degree), configuration.position, {}};
        Vector<S> coarse_force(2 * (degree + 1));
        coarse_force << down->odd * force.head(n), down->even * force.tail(n);
        change_ = mobility_change(coarse, there, coarse_force, modes, coarse_difference_step<S>(), central);
    }

    Index degree_ = 0;
    Matrix<S> change_;
};

/// d(normal velocity relative to the centroid)/d(normal displacement) of u = u_inf + G (F + load + T gamma), D u = 0,
/// or without T and D for a law without that constraint. The derivatives of F, T, D, of the load, of u_inf and of the
/// normals are one-sided differences, without assemblies; that of G comes in `mobility_change`, 2n x n.
template <class SceneType>
Matrix<typename SceneType::Scalar> velocity_jacobian(const SceneType& scene, const typename SceneType::Frozen& frozen,
                                                     const Configuration<typename SceneType::Scalar>& configuration,
                                                     const typename SceneType::InstantType& instant,
                                                     const Matrix<typename SceneType::Scalar>& mobility_change) {
    using std::sqrt;
    using S = typename SceneType::Scalar;
    const auto& surface = frozen.bodies.front().surface;
    const Index n = surface.size();
    const Vector<S>& tension = instant.solution.tension;
    const bool inextensible = tension.size() > 0;
    const auto force_on = [&](const auto& at) {
        Vector<S> force = elastic_force<S>(scene.law(), at);
        if (inextensible) {
            force += at.tension_force * tension;
        }
        return force;
    };
    const Vector<S> force = force_on(surface) + frozen.bodies.front().load;
    const Vector<S> flow = without_flux<S>(surface, scene.background_velocity(configuration));
    Vector<S> motion = instant.solution.velocity;  // relative to the centroid: 0 in the stationary state
    motion.tail(n).array() -= instant.velocity;
    const Vector<S> normal = relative_normal_velocity<S>(surface, configuration.shape.z, motion).second;
    const S step = sqrt(std::numeric_limits<S>::epsilon());
    Matrix<S> force_change(2 * n, n);
    Matrix<S> change(2 * n, n);
    Matrix<S> stretch_change(inextensible ? surface.divergence.rows() : 0, n);
    Matrix<S> jacobian(n, n);
    Vector<S> stretch;
    if (inextensible) {
        stretch = surface.divergence * motion;
    }
    for (Index j = 0; j < n; ++j) {
        Configuration<S> moved = configuration;
        displace<S>(moved.shape, surface, step * Vector<S>::Unit(n, j));
        const auto at = scene.discretization().surface(moved.shape, SurfaceParts::all);
        force_change.col(j) = (force_on(at) + scene.normal_load(moved, at) - force) / step;
        change.col(j) = (without_flux<S>(at, scene.background_velocity(moved)) - flow) / step;
        if (inextensible) {
            stretch_change.col(j) = (at.divergence * motion - stretch) / step;
        }
        jacobian.col(j) = (relative_normal_velocity<S>(at, moved.shape.z, motion).second - normal) / step;
    }
    const Matrix<S>& g = frozen.mobility;
    change += g * force_change;
    change += mobility_change;
    if (inextensible) {
        const Matrix<S> pull = g * surface.tension_force;
        const Matrix<S> divergence_of_pull = surface.divergence * pull;
        const Matrix<S> divergence_of_change = surface.divergence * change + stretch_change;
        change -= pull * divergence_of_pull.partialPivLu().solve(divergence_of_change);
    }

    Matrix<S> normal_change =
        surface.normal_r.asDiagonal() * change.topRows(n) + surface.normal_z.asDiagonal() * change.bottomRows(n);
    const Vector<S> moment = surface.weight.cwiseProduct(configuration.shape.z);
    normal_change -= (surface.normal_z * (moment.transpose() * normal_change / moment.dot(surface.normal_z))).eval();
    return jacobian + normal_change;
}

}  // namespace axistokes::detail
