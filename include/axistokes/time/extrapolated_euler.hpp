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

#include "../geometry/conserved.hpp"
#include "euler.hpp"

#include <utility>
#include <vector>

namespace axistokes {

/// As Step, with an estimate of the step's error: the largest normal distance (in R0) between the result and the one of
/// the order below.
template <class S>
struct EstimatedStep : Step<S> {
    S error{};
};

namespace detail {

/// What the bodies conserve, by the measures of the discretisation.
template <class SceneType>
std::vector<Conserved<typename SceneType::Scalar>> conserved_by(const SceneType& scene,
                                                                const typename SceneType::State& state) {
    std::vector<Conserved<typename SceneType::Scalar>> conserved;
    for (std::size_t b = 0; b < state.size(); ++b) {
        conserved.emplace_back(scene.discretization().measures(state[b].shape), keeps_area(scene.law(b)));
    }
    return conserved;
}

template <class SceneType, class S>
void restore_all(const SceneType& scene, std::vector<Configuration<S>>& state,
                 const std::vector<Conserved<S>>& conserved) {
    for (std::size_t b = 0; b < state.size(); ++b) {
        Meridian<S>& shape = state[b].shape;
        if (!scene.deforms(b)) {
            continue;
        }
        if (!shape.r.allFinite() || !shape.z.allFinite() ||
            !(shape.r.segment(1, shape.nodes() - 2).minCoeff() > S(0))) {
            throw SimulationFailure("extrapolated step: a node crossed the axis");
        }
        if (!conserved[b].restore(scene.discretization(), shape)) {
            throw SimulationFailure("extrapolated step: what the interface conserves could not be restored");
        }
    }
}

/// r, z and the position, from that at the start on, of all bodies in one vector, and back.
template <class S>
Vector<S> stacked(const std::vector<Configuration<S>>& state, const std::vector<Configuration<S>>& start) {
    Index size = 0;
    for (const Configuration<S>& body : state) {
        size += 2 * body.shape.nodes() + 1;
    }
    Vector<S> all(size);
    Index begin = 0;
    for (std::size_t b = 0; b < state.size(); ++b) {
        const Index n = state[b].shape.nodes();
        all.segment(begin, n) = state[b].shape.r;
        all.segment(begin + n, n) = state[b].shape.z;
        all[begin + 2 * n] = state[b].position - start[b].position;
        begin += 2 * n + 1;
    }
    return all;
}

template <class S>
void unstack(const Vector<S>& all, std::vector<Configuration<S>>& state) {
    Index begin = 0;
    for (Configuration<S>& body : state) {
        const Index n = body.shape.nodes();
        body.shape.r = all.segment(begin, n);
        body.shape.z = all.segment(begin + n, n);
        body.position += all[begin + 2 * n];
        begin += 2 * n + 1;
    }
}

/// Largest normal displacement of a body's nodes relative to its centroid, or of a body relative to the first one.
template <class SceneType, class S>
S largest_normal(const typename SceneType::Moment& start, const Vector<S>& displacement) {
    using std::abs;
    S largest = 0;
    const auto consider = [&](const S& value) {
        // NaN must not get lost.
        largest = abs(value) <= largest ? largest : S(abs(value));
    };
    Index begin = 0;
    for (const auto& body : start.frozen.bodies) {
        const Index n = body.surface.size();
        for (Index i = 0; i < n; ++i) {
            consider(body.surface.normal_r[i] * displacement[begin + i] +
                     body.surface.normal_z[i] * displacement[begin + n + i]);
        }
        consider(displacement[begin + 2 * n] - displacement[2 * start.frozen.bodies.front().surface.size()]);
        begin += 2 * n + 1;
    }
    return largest;
}

/// `count` Euler steps, the first of which is known. Each ends with what the bodies conserve restored: what is
/// extrapolated is then the motion on the surface of constant area and volume, as the discretisation measures them, and
/// the correction that ends the whole step is as small as the step's error. The tensions that stabilise a step stay
/// those of `now`: ones that changed from step to step would put terms (H/j)^3 of their own into the table.
template <class SceneType, class S>
Vector<S> euler_steps(SceneType& scene, std::vector<Configuration<S>> now, const typename SceneType::Instants& first,
                      const std::vector<Conserved<S>>& conserved, int count, const S& dt) {
    const std::vector<Configuration<S>> start = now;
    euler_move(now, first, dt);
    restore_all(scene, now, conserved);
    for (int i = 1; i < count; ++i) {
        euler_move(now, scene.evaluate(now, dt), dt);
        restore_all(scene, now, conserved);
    }
    return stacked(now, start);
}

/// A step of an order of at least 2.
template <class SceneType, class S>
EstimatedStep<S> extrapolated_step(SceneType& scene, const typename SceneType::Moment& start, const S& dt, int order) {
    const std::vector<Conserved<S>> conserved = conserved_by(scene, start.bodies);
    std::vector<Vector<S>> row(static_cast<std::size_t>(order));  // T(j, 1), ..., T(j, j)
    std::vector<Vector<S>> previous = row;
    EstimatedStep<S> result{{start.bodies}, S(0)};
    for (int j = 1; j <= order; ++j) {
        std::swap(row, previous);
        const auto first = scene.evaluate(start.frozen, start.bodies, S(dt / S(j)));
        row[0] = euler_steps(scene, start.bodies, first, conserved, j, S(dt / S(j)));
        for (int k = 1; k < j; ++k) {
            const auto from = static_cast<std::size_t>(k - 1);
            row[from + 1] = row[from] + (row[from] - previous[from]) * (S(j - k) / S(k));
        }
        take_tensions(result.bodies, first);
    }
    unstack(row.back(), result.bodies);
    result.error = largest_normal<SceneType, S>(start, row.back() - row[row.size() - 2]);
    return result;
}

}  // namespace detail

template <int Order>
requires(Order >= 2) class ExtrapolatedEuler {
  public:
    static constexpr int order = Order;

    template <class SceneType, class S>
    EstimatedStep<S> step(SceneType& scene, const typename SceneType::Moment& start, const S& dt) const {
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

    template <class SceneType, class S>
    EstimatedStep<S> step(SceneType& scene, const typename SceneType::Moment& start, const S& dt) const {
        if (order == 1) {
            return {detail::semi_implicit_euler_step(scene, start, dt), S(0)};
        }
        return detail::extrapolated_step(scene, start, dt, order);
    }
};

}  // namespace axistokes
