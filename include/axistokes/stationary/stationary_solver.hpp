// SPDX-License-Identifier: MIT
// Stationary shapes, their velocity and tension by Newton's method, and their linear stability (docs/stationary.md).
//
// Unknowns: normal displacements phi of the nodes, and axial ones of rigid bodies. Equations: the velocities against
// them relative to the first body's centroid vanish, w(x) = 0, with areas, volumes and the first body's place given.
// The Jacobian J is that of velocity_jacobian.hpp; between its renewals it learns from the iterations (Broyden 1965).
// Far from the solution a step is one of the linearly implicit Euler method, (1/dt - J) phi = w, with the longest dt
// that keeps the displacement within bounds.
#pragma once

#include "../geometry/series_transfer.hpp"
#include "broyden.hpp"
#include "coarse_scene.hpp"
#include "stationary_equations.hpp"

#include <algorithm>
#include <complex>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace axistokes {

template <class S>
struct StationaryParams {
    /// Converged: residual, as in StepRecord, below this; in (0, 1).
    S tolerance = S(1e-9);
    /// Go on below the tolerance as long as an iteration reduces the residual by the factor `renewal`.
    bool to_round_off = false;
    Index most_iterations = 100;
    /// Largest normal displacement in an iteration, in R0; next to a wall, over three times the distance from it.
    S largest_displacement = S(0.1);
    /// A trial may increase the residual by this factor.
    S allowed_increase = S(2);
    /// The Jacobian is renewed when an iteration reduces the residual by less than this factor, > 1.
    S renewal = S(5);
    /// Keep off states that are unstable against axisymmetric disturbances, as time marching does.
    bool only_stable = true;
    /// Solve with half of the modes or elements first.
    bool coarse_start = true;
    /// Asked before every iteration, if there is one; false ends the search with SimulationStopped.
    std::function<bool()> proceed{};
};

template <class S, class InstantType>
struct StationaryState {
    std::vector<Configuration<S>> bodies;
    std::vector<InstantType> instants;
    S residual{};  // the largest of all bodies
    /// Leading growth rate by the last Jacobian: to a few per cent, but in thin films wrong by a factor, unlike those
    /// of growth_rates(); NaN if none was needed, or only_stable is not set.
    S growth = std::numeric_limits<S>::quiet_NaN();
    Index iterations = 0;
    Index evaluations = 0;         // with all modes
    Index jacobians = 0;           // likewise
    Index coarse_evaluations = 0;  // with half of the modes, or fewer
    Index coarse_jacobians = 0;

    const Configuration<S>& configuration(std::size_t body = 0) const { return bodies.at(body); }
    const InstantType& instant(std::size_t body = 0) const { return instants.at(body); }
};

/// Finds and examines stationary states of a scene with deformable bodies, and rigid ones beside them. Not of laws that
/// carry a reference: where their material ends along the curve only marching tells.
template <class SceneType>
requires(SceneType::deformable) class StationarySolver {
    static_assert(!SceneType::carries_reference,
                  "a law that carries a reference has no StationarySolver: march to its stationary states");

  public:
    using Scalar = typename SceneType::Scalar;
    using Frozen = typename SceneType::Frozen;
    using InstantType = typename SceneType::InstantType;
    using Bodies = typename SceneType::State;
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

    /// The stationary state near these bodies, of the given areas and volumes: one body's centroid relative to the
    /// first one's is part of the solution. Throws InvalidArgument if there are not as many measures as bodies, and
    /// SimulationFailure with the cause when the iteration does not converge; then start closer, from a few time steps
    /// or a neighbouring solution.
    State solve(const Bodies& bodies, const std::vector<Measures<Scalar>>& measures) {
        detail::require(measures.size() == bodies.size() && !bodies.empty(), "number of measures", measures.size(),
                        "that of the bodies, at least 1");
        for (const auto& body : bodies) {
            validate(body.shape);
        }
        const auto conserved = detail::conserved_in(scene_, measures);
        State state;
        if (params_.coarse_start && half_resolves(bodies)) {
            try {
                State coarse;
                Bodies start = bodies;
                for (std::size_t b = 0; b < start.size(); ++b) {
                    resample(start, b, bodies[b].shape.elements() / 2);
                }
                for (const auto& body : start) {
                    if (const std::string cause = detail::fault(body.shape); !cause.empty()) {
                        throw SimulationFailure(cause);
                    }
                }
                iterate(coarse_, start, conserved, coarse_tolerance(), coarse);
                state.coarse_evaluations = coarse.evaluations;
                state.coarse_jacobians = coarse.jacobians;
                start = std::move(coarse.bodies);
                for (std::size_t b = 0; b < start.size(); ++b) {
                    resample(start, b, bodies[b].shape.elements());
                }
                iterate(scene_, start, conserved, params_.tolerance, state);
                return state;
            } catch (const SimulationFailure&) {
                // Half of the nodes may not resolve the shape.
            }
        }
        iterate(scene_, bodies, conserved, params_.tolerance, state);
        return state;
    }
    /// Of one body, near `shape`.
    State solve(const Meridian<Scalar>& shape, const Scalar& area, const Scalar& volume) {
        return solve(Bodies{{shape, Scalar(0), {}}}, {Measures<Scalar>{area, volume, Scalar(0)}});
    }

    /// Growth rates of small axisymmetric disturbances that keep areas, volumes and the first centroid, largest real
    /// part first: the eigenvalues of dw/dphi on these disturbances. The state is stable if all are negative.
    std::vector<std::complex<Scalar>> growth_rates(const State& state) {
        const Point point = point_of(state);
        return detail::growth_rates<Scalar>(detail::constraints(scene_, point),
                                            detail::VelocityJacobian<SceneType>(scene_, point, true)());
    }

    /// The same by central differences of the full equations: twice as many evaluations as unknowns.
    std::vector<std::complex<Scalar>> growth_rates(const State& state, const Scalar& step) {
        const Point point = point_of(state);
        const Index n = detail::StationaryLayout(scene_, point.bodies).all();
        const auto velocity = [&](const Vector<Scalar>& displacement) {
            Point moved;
            moved.bodies = detail::displaced(scene_, point, displacement);
            detail::evaluate(scene_, moved);
            return moved.velocity;
        };
        Matrix<Scalar> jacobian(n, n);
        for (Index j = 0; j < n; ++j) {
            jacobian.col(j) =
                (velocity(step * Vector<Scalar>::Unit(n, j)) - velocity(-step * Vector<Scalar>::Unit(n, j))) /
                (2 * step);
        }
        return detail::growth_rates<Scalar>(detail::constraints(scene_, point), jacobian);
    }

  private:
    using Point = detail::StationaryPoint<SceneType>;

    using Conserved = std::vector<axistokes::Conserved<Scalar>>;

    /// Of the deformable bodies.
    Index fewest_elements(const Bodies& bodies) const {
        Index fewest = std::numeric_limits<Index>::max();
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (scene_.deforms(b)) {
                fewest = std::min(fewest, bodies[b].shape.elements());
            }
        }
        return fewest;
    }

    /// Whether half of the elements, and coarse integrals, may do for a first guess: the wall leaves (h/Rc)^(5/2) of
    /// the forces along a film of thickness h in a tube of radius Rc.
    bool half_resolves(const Bodies& bodies) const {
        bool resolved = fewest_elements(bodies) / 2 >= least_degree;
        if constexpr (SceneType::confined) {
            for (std::size_t b = 0; b < bodies.size(); ++b) {
                const Meridian<Scalar>& shape = bodies[b].shape;
                const Scalar film = scene_.film_thickness(bodies[b]).min;
                const bool fine = 2 * detail::length_in_film(shape, film) <= Scalar(0.85) * Scalar(shape.elements()) &&
                                  film >= Scalar(0.02) * (film + shape.r.maxCoeff());
                resolved = resolved && (fine || !scene_.deforms(b));
            }
        }
        return resolved;
    }

    void resample(Bodies& bodies, std::size_t b, Index elements) const {
        if (scene_.deforms(b)) {
            bodies[b].shape = detail::resampled(bodies[b].shape, elements);
            bodies[b].tension.resize(0);
        }
    }

    Point point_of(const State& state) {
        Point point;
        point.bodies = state.bodies;
        point.frozen = scene_.freeze(state.bodies);
        point.instants = state.instants;
        return point;
    }

    /// Least degree and residual of a solution that is a first guess.
    static constexpr Index least_degree = 12;
    static Scalar coarse_tolerance() { return Scalar(1e-4); }

    /// Whether nodes were moved.
    bool redistribute(const SceneType& scene, Bodies& bodies) const {
        bool moved = false;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            moved = (scene.deforms(b) && scene.discretization().redistribute(bodies[b].shape)) || moved;
        }
        return moved;
    }

    /// From `bodies` to the stationary state of `scene`; counts what it takes, also when it fails.
    void iterate(SceneType& scene, const Bodies& bodies, const Conserved& conserved, const Scalar& tolerance,
                 State& state) {
        Point point;
        point.bodies = bodies;
        redistribute(scene, point.bodies);
        if (const std::string cause = detail::settle(scene, point.bodies, conserved); !cause.empty()) {
            throw SimulationFailure("stationary state: at the start " + cause);
        }
        detail::evaluate(scene, point);
        ++state.evaluations;
        Matrix<Scalar> jacobian;
        Scalar growth = 0;
        Scalar travelled = 0;  // since the Jacobian was found, in units of the limit
        const auto renew = [&] {
            jacobian = detail::VelocityJacobian<SceneType>(scene, point)();
            travelled = 0;
            ++state.jacobians;
            if (params_.only_stable) {
                state.growth = detail::growth_rates<Scalar>(detail::constraints(scene, point), jacobian).front().real();
                growth = std::max(Scalar(0), state.growth);
            }
        };
        Scalar limit = params_.largest_displacement;
        const bool to_round_off = params_.to_round_off && &scene == &scene_;
        bool going = !(point.residual < tolerance) || to_round_off;
        for (Index iteration = 1; going; ++iteration) {
            const bool converged = point.residual < tolerance;
            if (iteration > params_.most_iterations) {
                if (converged) {
                    break;
                }
                throw SimulationFailure("stationary state: the residual is " + detail::text(point.residual) +
                                        " after " + std::to_string(params_.most_iterations) + " iterations, not " +
                                        detail::text(tolerance));
            }
            if (params_.proceed && !params_.proceed()) {
                throw SimulationStopped("stationary state: stopped with a residual of " + detail::text(point.residual));
            }
            ++state.iterations;
            if (jacobian.size() == 0) {
                renew();
            }
            const Vector<Scalar> room = room_of(scene, point);
            const Vector<Scalar> step = bounded_step(scene, point, jacobian, Scalar(1.1) * growth, room, limit);
            const Scalar length = step.cwiseQuotient(room).cwiseAbs().maxCoeff();
            if (!(length < std::numeric_limits<Scalar>::max())) {
                throw SimulationFailure("stationary state: the linearised equations are singular");
            }
            Point trial;
            trial.bodies = detail::displaced(scene, point, step);
            const bool usable = detail::settle(scene, trial.bodies, conserved).empty();
            bool moved = false;
            if (usable) {
                detail::evaluate(scene, trial);
                ++state.evaluations;
                detail::learn<Scalar>(jacobian, step, trial.velocity - point.velocity);
            }
            if (converged && !(usable && trial.residual < point.residual)) {
                break;
            }
            const bool short_step = length < params_.largest_displacement / 10;
            // An unstable state near by is left with a residual that grows tenfold in a step.
            const bool leaving = growth > Scalar(0) && 2 * length < limit;
            const Scalar increase = params_.allowed_increase * Scalar(leaving ? 10 : 1);
            if (usable && trial.residual <= increase * point.residual) {
                // As long as the iteration converges well, what it has learned is cheaper than a new Jacobian.
                const bool stale = !(trial.residual < point.residual / params_.renewal);
                const bool hardly = !(trial.residual < point.residual / 2);
                point = std::move(trial);
                if (!(point.residual < tolerance)) {
                    moved = redistribute(scene, point.bodies);
                    if (moved) {
                        if (const std::string cause = detail::settle(scene, point.bodies, conserved); !cause.empty()) {
                            throw SimulationFailure("stationary state: after its nodes were moved " + cause);
                        }
                        detail::evaluate(scene, point);
                        ++state.evaluations;
                    }
                }
                going = !(point.residual < tolerance) || (to_round_off && !stale);
                travelled += length;
                // After a short step the Jacobian would be the same again, without what it has learned.
                const bool outdated = !short_step || hardly;
                if (!(point.residual < tolerance) && (moved || (stale && outdated))) {
                    renew();
                }
                limit = std::min(params_.largest_displacement, Scalar(2 * limit));
            } else {
                if (usable && short_step && travelled > 3 * length) {
                    renew();
                }
                limit = std::min(limit, length) / 4;
                if (limit < std::numeric_limits<Scalar>::epsilon()) {
                    throw SimulationFailure("stationary state: no step reduces the residual " +
                                            detail::text(point.residual));
                }
            }
        }
        state.bodies = std::move(point.bodies);
        state.instants = std::move(point.instants);
        for (std::size_t b = 0; b < state.bodies.size(); ++b) {
            state.bodies[b].tension = state.instants[b].solution.tension;
        }
        state.residual = point.residual;
    }

    /// What displacements are bounded by, in units of the limit: thrice the film's thickness, and no more than R0.
    static Vector<Scalar> room_of(const SceneType& scene, const Point& point) {
        const detail::StationaryLayout layout(scene, point.bodies);
        Vector<Scalar> room = Vector<Scalar>::Ones(layout.all());
        for (std::size_t b = 0; b < point.bodies.size(); ++b) {
            const Meridian<Scalar>& shape = point.bodies[b].shape;
            const Scalar position = point.bodies[b].position;
            for (Index i = 0; scene.deforms(b) && i < shape.nodes(); ++i) {
                room[layout.unknowns[b] + i] = std::min(
                    Scalar(1), Scalar(3 * scene.gap(axistokes::Point<Scalar>{shape.r[i], shape.z[i] + position})));
            }
        }
        return room;
    }

    /// (J - s) phi = -w with the constraints' changes zero.
    static Vector<Scalar> newton_step(const Point& point, Matrix<Scalar> system, const Scalar& shift) {
        const Index n = point.velocity.size();
        system.diagonal().head(n).array() -= shift;
        Vector<Scalar> rhs = Vector<Scalar>::Zero(system.rows());
        rhs.head(n) = -point.velocity;
        return system.partialPivLu().solve(rhs).head(n);
    }

    /// The step with the least shift, from `least` on, whose displacements keep to the limit.
    static Vector<Scalar> bounded_step(const SceneType& scene, const Point& point, const Matrix<Scalar>& jacobian,
                                       const Scalar& least, const Vector<Scalar>& room, const Scalar& limit) {
        using std::sqrt;
        const Matrix<Scalar> system = detail::bordered(detail::constraints(scene, point), jacobian);
        Vector<Scalar> step = newton_step(point, system, least);
        if (step.cwiseQuotient(room).cwiseAbs().maxCoeff() <= limit) {
            return step;
        }
        // Without elasticity the displacement is w/s.
        Scalar high = least + point.velocity.cwiseQuotient(room).cwiseAbs().maxCoeff() / limit;
        Scalar low = least + (high - least) / Scalar(4096);
        for (int k = 0; k < 5; ++k) {
            const Scalar middle = least + sqrt((low - least) * (high - least));
            step = newton_step(point, system, middle);
            (step.cwiseQuotient(room).cwiseAbs().maxCoeff() > limit ? low : high) = middle;
        }
        step = newton_step(point, system, high);
        const Scalar length = step.cwiseQuotient(room).cwiseAbs().maxCoeff();
        return length > limit ? Vector<Scalar>(step * (limit / length)) : step;
    }

    SceneType scene_;
    SceneType coarse_;
    Params params_;
};

}  // namespace axistokes
