// SPDX-License-Identifier: MIT
// Stationary states of a scene that depends on a parameter, as a problem for Continuation (docs/stationary.md,
// section 4).
#pragma once

#include "coarse_scene.hpp"
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

    struct Params {
        /// Difference of the parameter for derivatives; > 0. The integrals' errors are divided by it.
        Scalar parameter_step = Scalar(1e-4);
        /// Degree of the meridian on which the mobility's change is found; at least 8.
        Index change_degree = 16;
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
        detail::require(params.change_degree >= 8, "degree of the mobility's change", params.change_degree,
                        "at least 8");
    }

    /// `shape` at parameter p; need not be stationary. Throws SimulationFailure if it cannot have area and volume.
    Point at(const Scalar& p, const Meridian<Scalar>& shape) {
        validate(shape);
        Configuration<Scalar> configuration;
        configuration.shape = shape;
        auto point = evaluated(p, std::move(configuration));
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
        const auto& surface = point.state.frozen.bodies.front().surface;
        const auto& configuration = point.state.configuration;
        const Index n = surface.size();
        detail::MobilityChange<SceneType> change;
        SceneType coarse = detail::loosened_scene(*point.scene, Scalar(1e-4));
        const Index degree = std::min(params_.change_degree, n - 1);
        change.find(coarse, configuration, point.state.instant.solution.force, degree);
        const Matrix<Scalar> system =
            detail::bordered<Scalar>(surface, configuration.shape.z,
                                     detail::velocity_jacobian(*point.scene, point.state.frozen, configuration,
                                                               point.state.instant, change.at_nodes(n)),
                                     keeps_area(point));
        const Index m = system.rows();
        Matrix<Scalar> derivative = Matrix<Scalar>::Zero(m, m + 1);
        derivative.leftCols(m) = system;
        const Scalar step = params_.parameter_step;
        const Scalar p = point.parameter;
        detail::StationaryPoint<SceneType> there;
        there.configuration = configuration;
        SceneType scene = scene_(p + step);
        detail::evaluate(scene, there);
        derivative.col(m).head(n) = (there.velocity - point.state.velocity) / step;
        derivative(n, m) = -(volume_(p + step) - volume_(p)) / step;
        if (keeps_area(point)) {
            derivative(n + 2, m) = -(area_(p + step) - area_(p)) / step;
        }
        return derivative;
    }

    std::optional<Point> moved(const Point& point, const Vector<Scalar>& dx, const Scalar& dp) const {
        Configuration<Scalar> configuration = point.state.configuration;
        const Index n = configuration.shape.nodes();
        detail::displace<Scalar>(configuration.shape, point.state.frozen.bodies.front().surface, dx.head(n));
        return evaluated(point.parameter + dp, std::move(configuration));
    }

    /// Nodes are moved between solutions: within an iteration that would upset what it has learned.
    bool regularize(Point& point) const {
        Meridian<Scalar> shape = point.state.configuration.shape;
        if (!point.scene->discretization().redistribute(shape)) {
            return false;
        }
        Configuration<Scalar> configuration = point.state.configuration;
        configuration.shape = std::move(shape);
        auto moved = evaluated(point.parameter, std::move(configuration));
        if (!moved) {
            return false;
        }
        point = std::move(*moved);
        return true;
    }

    Scalar growth(const Point& point, const Matrix<Scalar>& derivative) const {
        const Index n = point.state.velocity.size();
        return detail::growth_rates<Scalar>(point.state.frozen.bodies.front().surface,
                                            point.state.configuration.shape.z, derivative.topLeftCorner(n, n),
                                            keeps_area(point))
            .front()
            .real();
    }

  private:
    static bool keeps_area(const Point& point) { return detail::keeps_area(point.scene->law()); }

    std::optional<Point> evaluated(const Scalar& p, Configuration<Scalar> configuration) const {
        Point point;
        point.parameter = p;
        point.scene = std::make_shared<SceneType>(scene_(p));
        point.state.configuration = std::move(configuration);
        const auto conserved = detail::conserved_in(*point.scene, Scalar(area_(p)), Scalar(volume_(p)));
        if (!detail::settle(*point.scene, point.state.configuration, conserved)) {
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
