// SPDX-License-Identifier: MIT
// Stationary shapes, their velocity and tension by a quasi-Newton method, and their linear stability
// (docs/stationary.md).
//
// Unknowns: normal displacements phi of the nodes. Equations: the normal velocity relative to the centroid vanishes,
// w(x) = 0, with area, volume and axial position given. The Jacobian is the one of frozen_jacobian.hpp, corrected by
// what the iterations show to be missing (Broyden 1965).
#pragma once

#include "frozen_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace axistokes {

template <class S>
struct StationaryParams {
    /// Converged: residual, as in StepRecord, below this; in (0, 1).
    S tolerance = S(1e-9);
    Index most_iterations = 60;
    /// Largest normal displacement in an iteration, in R0.
    S largest_displacement = S(0.1);
    /// A trial may increase the residual by this factor.
    S allowed_increase = S(2);
};

template <class S, class InstantType>
struct StationaryState {
    Configuration<S> configuration;
    InstantType instant;
    S residual{};
    Index iterations = 0;
    Index evaluations = 0;
};

/// Finds and examines stationary states of a scene with a deformable membrane.
template <class SceneType>
requires(SceneType::deformable) class StationarySolver {
  public:
    using Scalar = typename SceneType::Scalar;
    using Frozen = typename SceneType::Frozen;
    using InstantType = typename SceneType::InstantType;
    using State = StationaryState<Scalar, InstantType>;
    using Params = StationaryParams<Scalar>;

    /// Throws InvalidArgument when a parameter is out of range.
    explicit StationarySolver(SceneType scene, Params params = {}) : scene_(std::move(scene)), params_(params) {
        detail::require(params.tolerance > Scalar(0) && params.tolerance < Scalar(1), "stationarity tolerance",
                        params.tolerance, "in (0, 1)");
        detail::require(params.most_iterations >= 1, "number of iterations", params.most_iterations, "at least 1");
        detail::require(params.largest_displacement > Scalar(0), "largest displacement", params.largest_displacement,
                        "> 0");
        detail::require(params.allowed_increase >= Scalar(1), "allowed increase", params.allowed_increase,
                        "at least 1");
    }

    const SceneType& scene() const { return scene_; }

    /// The stationary state near `shape`, of the given area and volume. Throws SimulationFailure with the cause when
    /// the iteration does not converge; then start closer, from a few time steps or a neighbouring solution.
    State solve(const Meridian<Scalar>& shape, const Scalar& area, const Scalar& volume) {
        validate(shape);
        Point point;
        point.configuration.shape = shape;
        if (!settle(point.configuration, area, volume)) {
            throw SimulationFailure("stationary state: the first shape cannot be given the area " + text(area) +
                                    " and the volume " + text(volume));
        }
        evaluate(point);
        State state;
        state.evaluations = 1;
        const Index n = shape.nodes();
        Matrix<Scalar> learned = Matrix<Scalar>::Zero(n, n);
        Scalar limit = params_.largest_displacement;
        Matrix<Scalar> frozen = detail::frozen_jacobian(scene_, point.frozen, point.configuration, point.instant);
        while (!(point.residual < params_.tolerance)) {
            if (++state.iterations > params_.most_iterations) {
                throw SimulationFailure("stationary state: the residual is " + text(point.residual) + " after " +
                                        std::to_string(params_.most_iterations) + " iterations");
            }
            const Matrix<Scalar> jacobian = frozen + learned;
            Vector<Scalar> step = newton_step(point, jacobian);
            const Scalar length = step.cwiseAbs().maxCoeff();
            if (!(length < std::numeric_limits<Scalar>::max())) {
                throw SimulationFailure("stationary state: the linearised equations are singular");
            }
            step *= std::min(Scalar(1), Scalar(limit / length));
            Point trial;
            trial.configuration = point.configuration;
            detail::displace<Scalar>(trial.configuration.shape, point.frozen.surface, step);
            const bool usable = settle(trial.configuration, area, volume);
            bool moved = false;
            if (usable) {
                moved = scene_.discretization().redistribute(trial.configuration.shape);
                evaluate(trial);
                ++state.evaluations;
            }
            if (usable && !moved) {
                const Vector<Scalar> missed = trial.velocity - point.velocity - jacobian * step;
                learned += missed * step.transpose() / step.squaredNorm();
            }
            if (usable && trial.residual <= params_.allowed_increase * point.residual) {
                // As long as the iteration converges well, what it has learned is cheaper than a new Jacobian.
                const bool renew = moved || !(trial.residual < point.residual / 3);
                point = std::move(trial);
                if (renew) {
                    frozen = detail::frozen_jacobian(scene_, point.frozen, point.configuration, point.instant);
                }
                limit = std::min(params_.largest_displacement, Scalar(2 * limit));
            } else {
                limit = std::min(limit, length) / 4;
                if (limit < std::numeric_limits<Scalar>::epsilon()) {
                    throw SimulationFailure("stationary state: no step reduces the residual " + text(point.residual));
                }
            }
        }
        state.configuration = std::move(point.configuration);
        state.configuration.tension = point.instant.solution.tension;
        state.instant = std::move(point.instant);
        state.residual = point.residual;
        return state;
    }

    /// Growth rates of small axisymmetric disturbances that keep area, volume and the centroid, largest real part
    /// first: the eigenvalues of dw/dphi (central differences of the full equations, twice as many evaluations as
    /// nodes) on these disturbances. The state is stable if all are negative.
    std::vector<std::complex<Scalar>> growth_rates(const State& state, const Scalar& step = Scalar(1e-5)) {
        const auto& surface = state.instant.surface;
        const Index n = surface.size();
        Matrix<Scalar> jacobian(n, n);
        for (Index j = 0; j < n; ++j) {
            jacobian.col(j) = (disturbed(state, step * Vector<Scalar>::Unit(n, j)) -
                               disturbed(state, -step * Vector<Scalar>::Unit(n, j))) /
                              (2 * step);
        }
        const auto [gradients, corrections] = constraints(surface, state.configuration);
        const Matrix<Scalar> basis =
            Matrix<Scalar>(Matrix<Scalar>(gradients.transpose()).householderQr().householderQ()).rightCols(n - 3);
        const Matrix<Scalar> kept =
            jacobian - corrections * (gradients * corrections).partialPivLu().solve(gradients * jacobian);
        const Matrix<Scalar> reduced = basis.transpose() * kept * basis;
        const Vector<std::complex<Scalar>> values = reduced.eigenvalues();
        std::vector<std::complex<Scalar>> rates(values.data(), values.data() + values.size());
        std::sort(rates.begin(), rates.end(), [](const auto& a, const auto& b) { return a.real() > b.real(); });
        return rates;
    }

  private:
    struct Point {
        Configuration<Scalar> configuration;
        Frozen frozen;
        InstantType instant;
        Vector<Scalar> velocity;
        Scalar residual{};
    };

    static std::string text(const Scalar& value) {
        std::ostringstream out;
        out << value;
        return out.str();
    }

    void evaluate(Point& point) {
        point.frozen = scene_.freeze(point.configuration);
        point.instant = scene_.evaluate(point.frozen, point.configuration, Scalar(0));
        point.velocity = detail::relative_normal_velocity(point.instant);
        point.residual = point.instant.deformation_rate / std::max(Scalar(1), scene_.velocity_scale());
    }

    Vector<Scalar> disturbed(const State& state, const Vector<Scalar>& displacement) {
        Configuration<Scalar> moved = state.configuration;
        detail::displace<Scalar>(moved.shape, state.instant.surface, displacement);
        return detail::relative_normal_velocity(scene_.evaluate(moved, Scalar(0)));
    }

    /// Restores area and volume and puts the centroid at 0; false if the shape is unusable.
    bool settle(Configuration<Scalar>& configuration, const Scalar& area, const Scalar& volume) const {
        Meridian<Scalar>& shape = configuration.shape;
        const auto proper = [&] {
            return shape.r.allFinite() && shape.z.allFinite() &&
                   shape.r.segment(1, shape.nodes() - 2).minCoeff() > Scalar(0) && !self_intersection(shape) &&
                   scene_.film_thickness(configuration).min > Scalar(0);
        };
        if (!proper() || !scene_.discretization().restore(shape, area, volume) || !proper()) {
            return false;
        }
        shape.z.array() -= scene_.discretization().measures(shape).centroid;
        return true;
    }

    /// Rows: the change of volume, area and centroid by a normal displacement (phi, 2 H phi and z phi integrated).
    /// Columns: the displacements n, H n and the translation that correct them.
    template <class Surface>
    static std::pair<Matrix<Scalar>, Matrix<Scalar>> constraints(const Surface& surface,
                                                                 const Configuration<Scalar>& configuration) {
        const Index n = surface.size();
        Matrix<Scalar> gradients(3, n);
        gradients.row(0) = surface.weight.transpose();
        gradients.row(1) = 2 * surface.weight.cwiseProduct(surface.mean_curvature).transpose();
        gradients.row(2) = surface.weight.cwiseProduct(configuration.shape.z).transpose();
        Matrix<Scalar> corrections(n, 3);
        corrections << Vector<Scalar>::Ones(n), surface.mean_curvature, surface.normal_z;
        return {std::move(gradients), std::move(corrections)};
    }

    /// J phi + (a + b H + c n_z) = -w with the three constraints' changes zero. The multipliers vanish with w: they
    /// take up what is left of w's three exact dependencies.
    static Vector<Scalar> newton_step(const Point& point, const Matrix<Scalar>& jacobian) {
        const Index n = jacobian.rows();
        const auto [gradients, corrections] = constraints(point.frozen.surface, point.configuration);
        Matrix<Scalar> system = Matrix<Scalar>::Zero(n + 3, n + 3);
        system.topLeftCorner(n, n) = jacobian;
        system.topRightCorner(n, 3) = corrections;
        system.bottomLeftCorner(3, n) = gradients;
        Vector<Scalar> rhs = Vector<Scalar>::Zero(n + 3);
        rhs.head(n) = -point.velocity;
        return system.partialPivLu().solve(rhs).head(n);
    }

    SceneType scene_;
    Params params_;
};

}  // namespace axistokes
