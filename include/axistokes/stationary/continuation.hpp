// SPDX-License-Identifier: MIT
// Continuation of the solutions of F(x, p) = 0 in the parameter p (docs/stationary.md, section 4): steps along the
// tangent of the branch, corrected by a chord method on the plane normal to it (pseudo-arclength, passes folds) or at
// fixed p (natural parameter). Keller (1977), in Applications of Bifurcation Theory.
#pragma once

#include "../core.hpp"
#include "broyden.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace axistokes {

/// ContinuationProblem: `Point` is a value of (x, p) with what was computed there. `defect` is F, `derivative` is
/// (dF/dx, dF/dp), m x (m + 1), `residual` a norm of F. `moved(point, dx, dp)` is the point displaced, without a value
/// if there is none, for instance because a shape intersects itself. `growth(point, derivative)` is the largest real
/// part of the growth rates. An optional `regularize(point)` may change a solution's representation, for instance move
/// its nodes, and returns whether it did; the solution then is corrected again.
template <class P>
concept ContinuationProblem = requires(P& problem, const typename P::Point& point, const Vector<typename P::Scalar>& dx,
                                       const typename P::Scalar& dp, const Matrix<typename P::Scalar>& derivative) {
    { problem.parameter(point) } -> std::convertible_to<typename P::Scalar>;
    { problem.residual(point) } -> std::convertible_to<typename P::Scalar>;
    { problem.defect(point) } -> std::convertible_to<Vector<typename P::Scalar>>;
    { problem.derivative(point) } -> std::convertible_to<Matrix<typename P::Scalar>>;
    { problem.moved(point, dx, dp) } -> std::convertible_to<std::optional<typename P::Point>>;
    { problem.growth(point, derivative) } -> std::convertible_to<typename P::Scalar>;
};

enum class ContinuationMethod { natural, arclength };

template <class S>
struct ContinuationParams {
    ContinuationMethod method = ContinuationMethod::arclength;
    /// Converged: residual below this, > 0.
    S tolerance = S(1e-9);
    /// Steps along the branch: the root of the mean square of dx, plus the square of dp over its scale.
    S first_step = S(0.05);
    S smallest_step = S(1e-5);
    S largest_step = S(0.2);
    S parameter_scale = S(1);
    /// Where the branch is left.
    S least_parameter = -std::numeric_limits<S>::max();
    S largest_parameter = std::numeric_limits<S>::max();
    Index most_points = 1000;
    /// Corrections to a point; with more the step is halved.
    Index most_corrections = 8;
    /// Cosine of the largest turn of the tangent in a step.
    S least_cosine = S(0.9);
    /// Folds are found up to this slope dp/ds, other changes of stability up to this fraction of the step.
    S event_tolerance = S(1e-4);
};

enum class BranchEvent { none, fold, stability_change };

/// A point of a branch, as handed to the observer.
template <class Point, class S>
struct BranchPoint {
    const Point& point;
    S parameter{};
    S residual{};
    S growth{};  // of the fastest disturbance; the state is stable if < 0
    S slope{};   // dp/ds; 0 in a fold
    Index corrections = 0;
    BranchEvent event = BranchEvent::none;  // that lies here; ordinary points have none
};

/// Follows the branch of solutions through a point.
template <ContinuationProblem Problem>
class Continuation {
  public:
    using Scalar = typename Problem::Scalar;
    using Point = typename Problem::Point;
    using Params = ContinuationParams<Scalar>;
    using Record = BranchPoint<Point, Scalar>;

    /// Throws InvalidArgument when a parameter is out of range.
    explicit Continuation(Problem problem, Params params = {}) : problem_(std::move(problem)), params_(params) {
        detail::require(params.tolerance > Scalar(0), "continuation tolerance", params.tolerance, "> 0");
        detail::require(params.smallest_step > Scalar(0), "smallest step", params.smallest_step, "> 0");
        detail::require(params.first_step >= params.smallest_step, "first step", params.first_step,
                        "at least the smallest step");
        detail::require(params.largest_step >= params.first_step, "largest step", params.largest_step,
                        "at least the first step");
        detail::require(params.parameter_scale > Scalar(0), "parameter scale", params.parameter_scale, "> 0");
        detail::require(params.least_parameter < params.largest_parameter, "least parameter", params.least_parameter,
                        "< the largest parameter");
        detail::require(params.most_points >= 1, "number of points", params.most_points, "at least 1");
        detail::require(params.most_corrections >= 1, "number of corrections", params.most_corrections, "at least 1");
        detail::require(params.event_tolerance > Scalar(0), "event tolerance", params.event_tolerance, "> 0");
    }

    Problem& problem() { return problem_; }

    /// From `start`, corrected at its parameter, towards larger (direction > 0) or smaller parameters, until a bound is
    /// reached (true) or `observe(record)` returns false or there are most_points points (false). Throws
    /// SimulationFailure with the cause when the smallest step fails; the observer has the points before.
    template <class Observer>
    bool follow(const Point& start, int direction, Observer observe) {
        std::optional<Node> first = corrected(start, problem_.derivative(start), fixed_parameter(start));
        if (!first) {
            throw SimulationFailure("continuation: no solution near the start, at parameter " +
                                    detail::text(problem_.parameter(start)));
        }
        Node now = std::move(*first);
        finish(now, fixed_parameter(start) * Scalar(direction));
        if (!observe(record(now, BranchEvent::none))) {
            return false;
        }
        Scalar step = params_.first_step;
        for (Index k = 1; k < params_.most_points; ++k) {
            std::optional<Node> next;
            for (;;) {
                next = advanced(now, step);
                if (next && acceptable(now, *next)) {
                    break;
                }
                step /= 2;
                if (step < params_.smallest_step) {
                    throw SimulationFailure("continuation: no solution beyond parameter " +
                                            detail::text(parameter(now)) + " with steps of " +
                                            detail::text(params_.smallest_step));
                }
            }
            const bool fold = (now.slope() > Scalar(0)) != (next->slope() > Scalar(0));
            const bool change = (now.growth > Scalar(0)) != (next->growth > Scalar(0));
            if (fold || change) {
                const auto kind = fold ? BranchEvent::fold : BranchEvent::stability_change;
                // Where it cannot be located it is at least reported, at the point behind it.
                const auto event = located(now, *next, step, kind);
                if (!observe(record(event ? *event : *next, kind))) {
                    return false;
                }
            }
            const Scalar p = parameter(*next);
            if (p < params_.least_parameter || p > params_.largest_parameter) {
                const auto last = at_bound(now, *next);
                if (last) {
                    observe(record(*last, BranchEvent::none));
                }
                return true;
            }
            if (!observe(record(*next, BranchEvent::none))) {
                return false;
            }
            now = std::move(*next);
            if (now.corrections <= 3) {
                step = std::min(params_.largest_step, Scalar(step * Scalar(1.5)));
            } else if (2 * now.corrections > params_.most_corrections) {
                step = std::max(params_.smallest_step, Scalar(step / Scalar(1.5)));
            }
        }
        return false;
    }

  private:
    /// A solution with its derivative and the unit tangent (dx, dp) of the branch.
    struct Node {
        Point point;
        Matrix<Scalar> derivative;
        Vector<Scalar> tangent;
        Scalar growth{};
        Index corrections = 0;

        Scalar slope() const { return tangent[tangent.size() - 1]; }
    };

    Scalar parameter(const Node& node) { return problem_.parameter(node.point); }

    /// Weights of the norm of (dx, dp).
    Vector<Scalar> weights(Index size) const {
        Vector<Scalar> w = Vector<Scalar>::Constant(size, Scalar(1) / Scalar(size - 1));
        w[size - 1] = Scalar(1) / (params_.parameter_scale * params_.parameter_scale);
        return w;
    }

    Vector<Scalar> fixed_parameter(const Point& point) {
        const Index m = problem_.defect(point).size();
        Vector<Scalar> direction = Vector<Scalar>::Zero(m + 1);
        direction[m] = params_.parameter_scale;
        return direction;
    }

    Record record(const Node& node, BranchEvent event) {
        return {node.point,
                problem_.parameter(node.point),
                problem_.residual(node.point),
                node.growth,
                node.slope(),
                node.corrections,
                event};
    }

    /// Chord iteration with Broyden's updates on the plane through `trial` normal to `normal`.
    std::optional<Node> corrected(Point trial, Matrix<Scalar> derivative, const Vector<Scalar>& normal) {
        const Index m = derivative.rows();
        const Vector<Scalar> row = normal.cwiseProduct(weights(m + 1));
        Scalar residual = problem_.residual(trial);
        const Scalar first = residual;
        Index corrections = 0;
        while (!(residual < params_.tolerance)) {
            if (++corrections > params_.most_corrections || !(residual <= 10 * first)) {
                return std::nullopt;
            }
            Matrix<Scalar> system(m + 1, m + 1);
            system << derivative, row.transpose();
            Vector<Scalar> rhs = Vector<Scalar>::Zero(m + 1);
            const Vector<Scalar> defect = problem_.defect(trial);
            rhs.head(m) = -defect;
            const Vector<Scalar> step = system.partialPivLu().solve(rhs);
            if (!step.allFinite()) {
                return std::nullopt;
            }
            std::optional<Point> next = problem_.moved(trial, step.head(m), step[m]);
            if (!next) {
                return std::nullopt;
            }
            detail::learn<Scalar>(derivative, step, problem_.defect(*next) - defect);
            trial = std::move(*next);
            residual = problem_.residual(trial);
        }
        return Node{std::move(trial), {}, {}, {}, corrections};
    }

    /// Derivative, stability and tangent, the latter on the side of `along`.
    void finish(Node& node, const Vector<Scalar>& along) {
        using std::sqrt;
        node.derivative = problem_.derivative(node.point);
        node.growth = problem_.growth(node.point, node.derivative);
        const Index m = node.derivative.rows();
        const Vector<Scalar> w = weights(m + 1);
        Matrix<Scalar> system(m + 1, m + 1);
        system << node.derivative, along.cwiseProduct(w).transpose();
        node.tangent = system.partialPivLu().solve(Vector<Scalar>::Unit(m + 1, m));
        node.tangent /= sqrt(node.tangent.cwiseAbs2().dot(w));
    }

    std::optional<Node> advanced(const Node& from, const Scalar& step) {
        const Index m = from.derivative.rows();
        const Vector<Scalar> predictor = step * from.tangent;
        auto trial = problem_.moved(from.point, predictor.head(m), predictor[m]);
        if (!trial) {
            return std::nullopt;
        }
        const Vector<Scalar> normal =
            params_.method == ContinuationMethod::natural ? fixed_parameter(from.point) : from.tangent;
        auto next = corrected(std::move(*trial), from.derivative, normal);
        if constexpr (requires(Point & point) {
                          { problem_.regularize(point) } -> std::same_as<bool>;
                      }) {
            if (next && problem_.regularize(next->point)) {
                const Index corrections = next->corrections;
                Matrix<Scalar> derivative = problem_.derivative(next->point);
                next = corrected(std::move(next->point), std::move(derivative), normal);
                if (next) {
                    next->corrections += corrections;
                }
            }
        }
        if (next) {
            finish(*next, from.tangent);
        }
        return next;
    }

    bool acceptable(const Node& from, const Node& to) const {
        const Vector<Scalar> w = weights(from.tangent.size());
        return from.tangent.cwiseProduct(w).dot(to.tangent) >= params_.least_cosine;
    }

    /// Zero of the slope or of the growth rate between two points `step` apart: false position (Illinois).
    std::optional<Node> located(const Node& from, const Node& to, const Scalar& step, BranchEvent kind) {
        using std::abs;
        const auto value = [&](const Node& node) { return kind == BranchEvent::fold ? node.slope() : node.growth; };
        Scalar low = 0;
        Scalar high = step;
        Scalar at_low = value(from);
        Scalar at_high = value(to);
        std::optional<Node> found;
        constexpr int most = 12;
        for (int k = 0; k < most; ++k) {
            const Scalar middle = low + (high - low) * at_low / (at_low - at_high);
            auto node = advanced(from, middle);
            if (!node) {
                break;
            }
            const Scalar here = value(*node);
            const bool close = kind == BranchEvent::fold ? abs(here) < params_.event_tolerance * params_.parameter_scale
                                                         : high - low < params_.event_tolerance * step;
            found = std::move(node);
            if (close || here == Scalar(0)) {
                break;
            }
            if ((here > Scalar(0)) == (at_low > Scalar(0))) {
                low = middle;
                at_low = here;
                at_high /= 2;
            } else {
                high = middle;
                at_high = here;
                at_low /= 2;
            }
        }
        return found;
    }

    /// The solution at the bound that lies between two points.
    std::optional<Node> at_bound(const Node& from, const Node& to) {
        const Index m = from.derivative.rows();
        const Scalar p = parameter(to);
        const Scalar bound = p > params_.largest_parameter ? params_.largest_parameter : params_.least_parameter;
        const Scalar part = bound - parameter(from);
        const Vector<Scalar> predictor = from.tangent * (part / from.slope());
        auto trial = problem_.moved(from.point, predictor.head(m), part);
        if (!trial) {
            return std::nullopt;
        }
        auto last = corrected(std::move(*trial), from.derivative, fixed_parameter(from.point));
        if (last) {
            finish(*last, from.tangent);
        }
        return last;
    }

    Problem problem_;
    Params params_;
};

}  // namespace axistokes
