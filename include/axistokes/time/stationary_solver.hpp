// SPDX-License-Identifier: MIT
// Stationary shapes, their velocity and tension by Newton's method, and their linear stability (docs/stationary.md).
//
// Unknowns: normal displacements phi of the nodes. Equations: the normal velocity relative to the centroid vanishes,
// w(x) = 0, with area, volume and axial position given. The Jacobian J is that of velocity_jacobian.hpp, corrected by
// what the iterations show to be missing (Broyden 1965). Far from the solution a step is one of the linearly implicit
// Euler method, (1/dt - J) phi = w, with the longest dt that keeps the displacement within bounds.
#pragma once

#include "velocity_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <optional>
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
    /// The Jacobian is renewed when an iteration reduces the residual by less than this factor, > 1.
    S renewal = S(5);
    /// Keep off states that are unstable against axisymmetric disturbances, as time marching does.
    bool only_stable = true;
    /// Solve with half the modes first (discretisations that can be resampled).
    bool coarse_start = true;
};

template <class S, class InstantType>
struct StationaryState {
    Configuration<S> configuration;
    InstantType instant;
    S residual{};
    Index iterations = 0;
    Index evaluations = 0;         // with all modes
    Index jacobians = 0;           // likewise
    Index coarse_evaluations = 0;  // with half of the modes, or fewer
    Index coarse_jacobians = 0;
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
    explicit StationarySolver(SceneType scene, Params params = {})
        : scene_(std::move(scene)), coarse_(detail::loosened_scene(scene_, Scalar(1e-4))), params_(params) {
        detail::require(params.tolerance > Scalar(0) && params.tolerance < Scalar(1), "stationarity tolerance",
                        params.tolerance, "in (0, 1)");
        detail::require(params.most_iterations >= 1, "number of iterations", params.most_iterations, "at least 1");
        detail::require(params.largest_displacement > Scalar(0), "largest displacement", params.largest_displacement,
                        "> 0");
        detail::require(params.allowed_increase >= Scalar(1), "allowed increase", params.allowed_increase,
                        "at least 1");
        detail::require(params.renewal > Scalar(1), "renewal of the Jacobian", params.renewal, "> 1");
    }

    const SceneType& scene() const { return scene_; }
    const Params& params() const { return params_; }

    /// The stationary state near `shape`, of the given area and volume. Throws SimulationFailure with the cause when
    /// the iteration does not converge; then start closer, from a few time steps or a neighbouring solution.
    State solve(const Meridian<Scalar>& shape, const Scalar& area, const Scalar& volume) {
        validate(shape);
        State state;
        if constexpr (detail::Resampling<SceneType>) {
            const Index half = shape.elements() / 2;
            if (params_.coarse_start && half >= least_degree) {
                try {
                    State coarse;
                    const auto& resample = scene_.discretization();
                    iterate(coarse_, resample.resampled(shape, half), area, volume, coarse_tolerance(), coarse);
                    state.coarse_evaluations = coarse.evaluations;
                    state.coarse_jacobians = coarse.jacobians;
                    iterate(scene_, resample.resampled(coarse.configuration.shape, shape.elements()), area, volume,
                            params_.tolerance, state);
                    return state;
                } catch (const SimulationFailure&) {
                    // The shape may not be resolved by half the modes.
                }
            }
        }
        iterate(scene_, shape, area, volume, params_.tolerance, state);
        return state;
    }

    /// Growth rates of small axisymmetric disturbances that keep area, volume and the centroid, largest real part
    /// first: the eigenvalues of dw/dphi on these disturbances. The state is stable if all are negative.
    std::vector<std::complex<Scalar>> growth_rates(const State& state) {
        if constexpr (detail::Resampling<SceneType>) {
            Point point;
            point.configuration = state.configuration;
            evaluate(scene_, point);
            return rates(state.instant.surface, state.configuration, jacobian_at(scene_, point));
        } else {
            return growth_rates(state, Scalar(1e-5));
        }
    }

    /// The same by central differences of the full equations: twice as many evaluations as nodes.
    std::vector<std::complex<Scalar>> growth_rates(const State& state, const Scalar& step) {
        const auto& surface = state.instant.surface;
        const Index n = surface.size();
        Matrix<Scalar> jacobian(n, n);
        for (Index j = 0; j < n; ++j) {
            jacobian.col(j) = (disturbed(state, step * Vector<Scalar>::Unit(n, j)) -
                               disturbed(state, -step * Vector<Scalar>::Unit(n, j))) /
                              (2 * step);
        }
        return rates(surface, state.configuration, jacobian);
    }

  private:
    /// Of a meridian whose solution is a first guess, and of the one on which the mobility's change is found.
    static constexpr Index least_degree = 12;
    static constexpr Index change_degree = 16;
    static constexpr Index change_modes = 11;

    struct Point {
        Configuration<Scalar> configuration;
        Frozen frozen;
        InstantType instant;
        Vector<Scalar> velocity;
        Scalar residual{};
    };

    static Scalar coarse_tolerance() { return Scalar(1e-4); }

    static std::string text(const Scalar& value) {
        std::ostringstream out;
        out << value;
        return out.str();
    }

    /// From `shape` to the stationary state of `scene`; counts what it takes, also when it fails.
    void iterate(SceneType& scene, const Meridian<Scalar>& shape, const Scalar& area, const Scalar& volume,
                 const Scalar& tolerance, State& state) {
        Point point;
        point.configuration.shape = shape;
        scene.discretization().redistribute(point.configuration.shape);
        if (!settle(scene, point.configuration, area, volume)) {
            throw SimulationFailure("stationary state: the first shape cannot be given the area " + text(area) +
                                    " and the volume " + text(volume));
        }
        evaluate(scene, point);
        ++state.evaluations;
        const Index n = shape.nodes();
        Matrix<Scalar> learned;
        Matrix<Scalar> jacobian;
        Scalar growth = 0;
        const auto renew = [&] {
            jacobian = jacobian_at(scene, point);
            if (learned.size() == 0) {
                learned = Matrix<Scalar>::Zero(n, n);
            }
            ++state.jacobians;
            growth = 0;
            if (params_.only_stable) {
                growth = std::max(growth, rates(point.frozen.surface, point.configuration, jacobian).front().real());
            }
        };
        Scalar limit = params_.largest_displacement;
        Index iterations = 0;
        while (!(point.residual < tolerance)) {
            if (++iterations > params_.most_iterations) {
                throw SimulationFailure("stationary state: the residual is " + text(point.residual) + " after " +
                                        std::to_string(params_.most_iterations) + " iterations");
            }
            ++state.iterations;
            if (jacobian.size() == 0) {
                renew();
            }
            const Vector<Scalar> step = bounded_step(point, jacobian, 2 * growth, limit);
            const Scalar length = step.cwiseAbs().maxCoeff();
            if (!(length < std::numeric_limits<Scalar>::max())) {
                throw SimulationFailure("stationary state: the linearised equations are singular");
            }
            Point trial;
            trial.configuration = point.configuration;
            detail::displace<Scalar>(trial.configuration.shape, point.frozen.surface, step);
            const bool usable = settle(scene, trial.configuration, area, volume);
            bool moved = false;
            if (usable) {
                moved = scene.discretization().redistribute(trial.configuration.shape);
                evaluate(scene, trial);
                ++state.evaluations;
            }
            if (usable && !moved) {
                const Vector<Scalar> missed = trial.velocity - point.velocity - jacobian * step;
                jacobian += missed * step.transpose() / step.squaredNorm();
            }
            if (trace) {
                std::printf("    n %d it %d res %.2e -> %.2e len %.2e limit %.2e growth %.2f moved %d usable %d\n", (int)n, (int)iterations, (double)point.residual, (double)trial.residual, (double)length, (double)limit, (double)growth, moved, usable);
            }
            if (usable && trial.residual <= params_.allowed_increase * point.residual) {
                // As long as the iteration converges well, what it has learned is cheaper than a new Jacobian.
                const bool stale = moved || !(trial.residual < point.residual / params_.renewal);
                point = std::move(trial);
                if (stale && !(point.residual < tolerance)) {
                    renew();
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
    }
  public: static inline bool trace = false; private:

    Matrix<Scalar> jacobian_at(SceneType& scene, const Point& point) {
        Matrix<Scalar> mobility_change;
        if constexpr (detail::Resampling<SceneType>) {
            const Index degree = std::min(change_degree, point.frozen.surface.size() - 1);
            mobility_change = detail::coarse_mobility_change(coarse_, point.configuration,
                                                             point.instant.solution.force, degree, change_modes);
        }
        return detail::velocity_jacobian(scene, point.frozen, point.configuration, point.instant, mobility_change);
    }

    static void evaluate(SceneType& scene, Point& point) {
        point.frozen = scene.freeze(point.configuration);
        point.instant = scene.evaluate(point.frozen, point.configuration, Scalar(0));
        point.velocity = relative_velocity(point.configuration, point.instant);
        point.residual = point.instant.deformation_rate / std::max(Scalar(1), scene.velocity_scale());
    }

    static Vector<Scalar> relative_velocity(const Configuration<Scalar>& configuration, const InstantType& instant) {
        return detail::relative_normal_velocity<Scalar>(instant.surface, configuration.shape.z,
                                                        instant.solution.velocity)
            .second;
    }

    Vector<Scalar> disturbed(const State& state, const Vector<Scalar>& displacement) {
        Configuration<Scalar> moved = state.configuration;
        detail::displace<Scalar>(moved.shape, state.instant.surface, displacement);
        return relative_velocity(moved, scene_.evaluate(moved, Scalar(0)));
    }

    /// Restores area and volume and puts the centroid at 0; false if the shape is unusable.
    static bool settle(const SceneType& scene, Configuration<Scalar>& configuration, const Scalar& area,
                       const Scalar& volume) {
        Meridian<Scalar>& shape = configuration.shape;
        const auto proper = [&] {
            return shape.r.allFinite() && shape.z.allFinite() &&
                   shape.r.segment(1, shape.nodes() - 2).minCoeff() > Scalar(0) && !self_intersection(shape) &&
                   scene.film_thickness(configuration).min > Scalar(0);
        };
        if (!proper() || !scene.discretization().restore(shape, area, volume) || !proper()) {
            return false;
        }
        shape.z.array() -= scene.discretization().measures(shape).centroid;
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

    template <class Surface>
    static std::vector<std::complex<Scalar>> rates(const Surface& surface, const Configuration<Scalar>& configuration,
                                                   const Matrix<Scalar>& jacobian) {
        const Index n = surface.size();
        const auto [gradients, corrections] = constraints(surface, configuration);
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

    /// (J - s) phi + (a + b H + c n_z) = -w with the three constraints' changes zero. The multipliers vanish with w:
    /// they take up what is left of w's three exact dependencies.
    static Vector<Scalar> newton_step(const Point& point, const Matrix<Scalar>& jacobian, const Scalar& shift) {
        const Index n = jacobian.rows();
        const auto [gradients, corrections] = constraints(point.frozen.surface, point.configuration);
        Matrix<Scalar> system = Matrix<Scalar>::Zero(n + 3, n + 3);
        system.topLeftCorner(n, n) = jacobian;
        system.diagonal().head(n).array() -= shift;
        system.topRightCorner(n, 3) = corrections;
        system.bottomLeftCorner(3, n) = gradients;
        Vector<Scalar> rhs = Vector<Scalar>::Zero(n + 3);
        rhs.head(n) = -point.velocity;
        return system.partialPivLu().solve(rhs).head(n);
    }

    /// The step with the least shift, from `least` on, whose displacements keep to the limit.
    static Vector<Scalar> bounded_step(const Point& point, const Matrix<Scalar>& jacobian, const Scalar& least,
                                       const Scalar& limit) {
        using std::sqrt;
        Vector<Scalar> step = newton_step(point, jacobian, least);
        if (step.cwiseAbs().maxCoeff() <= limit) {
            return step;
        }
        // With no elasticity the displacement is w/s.
        Scalar high = least + point.velocity.cwiseAbs().maxCoeff() / limit;
        Scalar low = least + (high - least) / Scalar(4096);
        for (int k = 0; k < 5; ++k) {
            const Scalar middle = least + sqrt((low - least) * (high - least));
            step = newton_step(point, jacobian, middle);
            (step.cwiseAbs().maxCoeff() > limit ? low : high) = middle;
        }
        step = newton_step(point, jacobian, high);
        const Scalar length = step.cwiseAbs().maxCoeff();
        return length > limit ? Vector<Scalar>(step * (limit / length)) : step;
    }

    SceneType scene_;
    SceneType coarse_;
    Params params_;
};

}  // namespace axistokes
