// SPDX-License-Identifier: MIT
// Semi-implicit steps of second and higher order by extrapolation (a policy for the time integrator;
// docs/time_stepping.md).
//
// A step H is done with 1, 2, ..., Order semi-implicit Euler steps H/j. Their results T(j, 1) have an expansion in the
// powers of H/j, of which Aitken-Neville's table
//   T(j, k+1) = T(j, k) + [T(j, k) - T(j-1, k)] / [j/(j-k) - 1]
// removes one per column (Deuflhard 1985; Hairer & Wanner, Solving ODEs II, section IV.9). The method is one-step: the
// nodes may be redistributed between two steps. All the rows start from one geometry, which is evaluated once.
#pragma once

#include "euler.hpp"

#include <utility>
#include <vector>

namespace axistokes {

/// As Step, with an estimate of the step's error: the largest normal distance (in R0) between the result and the one of
/// the order below.
template <class S, class InstantType>
struct EstimatedStep : Step<S, InstantType> {
    S error{};
};

namespace detail {

template <class S, class SceneType>
void restore_measures(SceneType& scene, Configuration<S>& now, const Measures<S>& kept) {
    if constexpr (SceneType::deformable) {
        const Index n = now.shape.nodes();
        if (!now.shape.r.allFinite() || !now.shape.z.allFinite() ||
            !(now.shape.r.segment(1, n - 2).minCoeff() > S(0))) {
            throw SimulationFailure("extrapolated step: a node crossed the axis");
        }
        if (!scene.discretization().restore(now.shape, kept.area, kept.volume)) {
            throw SimulationFailure("extrapolated step: area and volume could not be restored");
        }
    }
}

/// `count` Euler steps, the first of which is known: r, z and the displacement, stacked. Each ends with its area and
/// volume restored: what is extrapolated is then the motion on the surface of constant area and volume, as the
/// discretisation measures them, and the correction that ends the whole step is as small as the step's error. The
/// tension that stabilises a step stays that of `now`: one that changed from step to step would put terms (H/j)^3 of
/// its own into the table.
template <class S, class SceneType, class InstantType>
Vector<S> euler_steps(SceneType& scene, Configuration<S> now, const InstantType& first, const Measures<S>& kept,
                      int count, const S& dt) {
    const S origin = now.position;
    euler_move(now, first, dt);
    restore_measures(scene, now, kept);
    for (int i = 1; i < count; ++i) {
        const InstantType next = scene.evaluate(now, dt);
        euler_move(now, next, dt);
        restore_measures(scene, now, kept);
    }
    const Index n = now.shape.nodes();
    Vector<S> result(2 * n + 1);
    result << now.shape.r, now.shape.z, now.position - origin;
    return result;
}

/// A step of an order of at least 2.
template <class S, class SceneType>
EstimatedStep<S, typename SceneType::InstantType> extrapolated_step(SceneType& scene, const Configuration<S>& start,
                                                                    const S& dt, int order) {
    const Measures<S> kept = scene.discretization().measures(start.shape);
    const typename SceneType::Frozen frozen = scene.freeze(start);
    std::vector<Vector<S>> row(static_cast<std::size_t>(order));  // T(j, 1), ..., T(j, j)
    std::vector<Vector<S>> previous = row;
    EstimatedStep<S, typename SceneType::InstantType> result;
    for (int j = 1; j <= order; ++j) {
        std::swap(row, previous);
        result.instant = scene.evaluate(frozen, start, dt / S(j));
        row[0] = euler_steps(scene, start, result.instant, kept, j, S(dt / S(j)));
        for (int k = 1; k < j; ++k) {
            const auto from = static_cast<std::size_t>(k - 1);
            row[from + 1] = row[from] + (row[from] - previous[from]) * (S(j - k) / S(k));
        }
    }
    const Index n = start.shape.nodes();
    const Vector<S>& best = row.back();
    result.shape = {best.head(n), best.segment(n, n)};
    result.displacement = best[2 * n];
    const Vector<S> difference = best - row[row.size() - 2];
    const auto& surface = result.instant.surface;
    result.error =
        (surface.normal_r.cwiseProduct(difference.head(n)) + surface.normal_z.cwiseProduct(difference.segment(n, n)))
            .cwiseAbs()
            .maxCoeff();
    return result;
}

}  // namespace detail

template <int Order>
requires(Order >= 2) class ExtrapolatedEuler {
  public:
    static constexpr int order = Order;

    template <class S, class SceneType>
    auto step(SceneType& scene, const Configuration<S>& start, const S& dt) const {
        return detail::extrapolated_step(scene, start, dt, Order);
    }
};

/// Order 2: two evaluations of the geometry and three solutions a step.
using SecondOrder = ExtrapolatedEuler<2>;
/// Order 3: four evaluations of the geometry and six solutions a step.
using ThirdOrder = ExtrapolatedEuler<3>;

/// The same with the order chosen at run time; 1 is the semi-implicit Euler step, without an estimate of its error.
class ExtrapolatedEulerOfOrder {
  public:
    int order = 1;

    /// Throws InvalidArgument for an order outside 1 to 6.
    explicit ExtrapolatedEulerOfOrder(int wanted = 1) : order(wanted) {
        detail::require(wanted >= 1 && wanted <= 6, "order of the time step", wanted, "in [1, 6]");
    }

    /// The order that reaches an accuracy in the least time when `tolerance` (in R0) is the error allowed in a step:
    /// the longer steps of a higher one pay the sooner the tighter that is (measured: docs/time_stepping.md).
    template <class S>
    static ExtrapolatedEulerOfOrder for_tolerance(const S& tolerance) {
        return ExtrapolatedEulerOfOrder(tolerance > S(3e-6) ? 3 : tolerance > S(3e-8) ? 5 : 6);
    }

    bool estimates_error() const { return order > 1; }

    template <class S, class SceneType>
    EstimatedStep<S, typename SceneType::InstantType> step(SceneType& scene, const Configuration<S>& start,
                                                           const S& dt) const {
        if (order == 1) {
            return {detail::euler_step(scene, start, dt, dt), S(0)};
        }
        return detail::extrapolated_step(scene, start, dt, order);
    }
};

}  // namespace axistokes
