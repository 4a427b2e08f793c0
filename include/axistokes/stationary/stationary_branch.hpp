// SPDX-License-Identifier: MIT
// Stationary states of a scene that depends on a parameter, as a problem for Continuation (docs/stationary.md,
// section 4).
#pragma once

#include "continuation.hpp"
#include "stationary_equations.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace axistokes {

/// `scene(p)`, `area(p)` and `volume(p)` describe the body at parameter p (its law decides whether the area
/// matters). The unknowns are normal displacements of
/// the nodes and multipliers of the constraints, which vanish.
template <class SceneType>
requires(SceneType::deformable) class StationaryBranch {
  public:
    using Scalar = typename SceneType::Scalar;
    using Bodies = typename SceneType::State;

    struct Params {
        /// Difference of the parameter for derivatives; > 0. The integrals' errors are divided by it.
        Scalar parameter_step = Scalar(1e-4);
    };

    struct Point {
        Scalar parameter{};
        std::shared_ptr<SceneType> scene;
        detail::StationaryPoint<SceneType> state;
    };

    StationaryBranch(std::function<SceneType(Scalar)> scene, std::function<Scalar(Scalar)> area,
                     std::function<Scalar(Scalar)> volume, Params params = {})
        : scene_(std::move(scene)), area_(std::move(area)), volume_(std::move(volume)), params_(params) {
        detail::require(params.parameter_step > Scalar(0), "parameter step", params.parameter_step, "> 0");
    }

    /// `shape` at parameter p; need not be stationary. Throws SimulationFailure if it cannot have area and volume.
    Point at(const Scalar& p, const Meridian<Scalar>& shape) {
        validate(shape);
        auto point = evaluated(p, Bodies{{shape, Scalar(0), {}}});
        if (!point) {
            throw SimulationFailure("stationary branch: the first shape cannot be given its area and volume");
        }
        return std::move(*point);
    }

    Scalar parameter(const Point& point) const { return point.parameter; }
    Scalar residual(const Point& point) const { return point.state.residual; }

    /// w, and the constraints, which all shapes meet.
    Vector<Scalar> defect(const Point& point) const {
        Vector<Scalar> defect = Vector<Scalar>::Zero(point.state.velocity.size() + (keeps_area(point) ? 3 : 2));
        defect.head(point.state.velocity.size()) = point.state.velocity;
        return defect;
    }

    Matrix<Scalar> derivative(const Point& point) {
        const auto& bodies = point.state.bodies;
        const Index n = point.state.velocity.size();
        const auto constraints = detail::constraints(*point.scene, point.state);
        const Matrix<Scalar> system =
            detail::bordered<Scalar>(constraints, detail::VelocityJacobian<SceneType>(*point.scene, point.state)());
        const Index m = system.rows();
        Matrix<Scalar> derivative = Matrix<Scalar>::Zero(m, m + 1);
        derivative.leftCols(m) = system;
        const Scalar step = params_.parameter_step;
        const Scalar p = point.parameter;
        detail::StationaryPoint<SceneType> there;
        there.bodies = bodies;
        SceneType scene = scene_(p + step);
        detail::evaluate(scene, there);
        derivative.col(m).head(n) = (there.velocity - point.state.velocity) / step;
        derivative(n + constraints.volumes[0], m) = -(volume_(p + step) - volume_(p)) / step;
        if (constraints.areas[0] >= 0) {
            derivative(n + constraints.areas[0], m) = -(area_(p + step) - area_(p)) / step;
        }
        return derivative;
    }

    std::optional<Point> moved(const Point& point, const Vector<Scalar>& dx, const Scalar& dp) const {
        return evaluated(point.parameter + dp,
                         detail::displaced(*point.scene, point.state, dx.head(point.state.velocity.size())));
    }

    /// Nodes are moved between solutions: within an iteration that would upset what it has learned.
    bool regularize(Point& point) const {
        Bodies bodies = point.state.bodies;
        if (!point.scene->discretization().redistribute(bodies.front().shape)) {
            return false;
        }
        auto moved = evaluated(point.parameter, std::move(bodies));
        if (!moved) {
            return false;
        }
        point = std::move(*moved);
        return true;
    }

    Scalar growth(const Point& point, const Matrix<Scalar>& derivative) const {
        const Index n = point.state.velocity.size();
        return detail::growth_rates<Scalar>(detail::constraints(*point.scene, point.state),
                                            derivative.topLeftCorner(n, n))
            .front()
            .real();
    }

  private:
    static bool keeps_area(const Point& point) { return detail::keeps_area(point.scene->law()); }

    std::optional<Point> evaluated(const Scalar& p, Bodies bodies) const {
        Point point;
        point.parameter = p;
        point.scene = std::make_shared<SceneType>(scene_(p));
        point.state.bodies = std::move(bodies);
        const std::vector<Measures<Scalar>> measures{{area_(p), volume_(p), Scalar(0)}};
        if (!detail::settle(*point.scene, point.state.bodies, detail::conserved_in(*point.scene, measures)).empty()) {
            return std::nullopt;
        }
        detail::evaluate(*point.scene, point.state);
        return point;
    }

    std::function<SceneType(Scalar)> scene_;
    std::function<Scalar(Scalar)> area_;
    std::function<Scalar(Scalar)> volume_;
    Params params_;
};

}  // namespace axistokes
