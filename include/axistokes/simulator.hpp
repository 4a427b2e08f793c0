// SPDX-License-Identifier: MIT
// A simulation assembled at compile time from its policies; see concepts.hpp for what each must offer.
#pragma once

#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace axistokes {

/// TimeIntegratorFor<Scene>: `step(scene, configuration, dt)` evaluates the scene once or more and returns the
/// displaced meridian, relative to the moved centroid, the centroid's displacement and the instant the motion started
/// from. The result may have a member `error`, an estimate of the step's error in R0: the automatic step then follows
/// it, unless the integrator has a member `estimates_error()` that says it is none.
template <class T, class SceneType>
concept TimeIntegratorFor = requires(const T& integrator, SceneType& scene,
                                     const Configuration<typename SceneType::Scalar>& start,
                                     typename SceneType::Scalar dt) {
    { integrator.order } -> std::convertible_to<int>;
    { integrator.step(scene, start, dt).shape } -> std::convertible_to<Meridian<typename SceneType::Scalar>>;
    { integrator.step(scene, start, dt).displacement } -> std::convertible_to<typename SceneType::Scalar>;
    { integrator.step(scene, start, dt).instant } -> std::convertible_to<typename SceneType::InstantType>;
};

/// One line of a simulation's history: the state a step arrived at, with the velocities that led to it. Dimensionless:
/// lengths in R0, times in eta R0^3/kappa, velocities in kappa/(eta R0^2), energies in kappa.
template <class S>
struct StepRecord {
    Index step = 0;
    S time{};
    S dt{};
    S position{};  // centroid in the laboratory frame
    S velocity{};  // of the centroid
    S length{};    // along the axis
    S max_radius{};
    S area{};
    S volume{};
    S area_drift{};  // relative to the initial shape, after the step's correction
    S volume_drift{};
    S area_error{};  // relative change in this step before the correction
    S volume_error{};
    S bending_energy{};  // 2 Int H^2 dA
    S residual{};        // largest normal velocity relative to the centroid, over the velocity scale
    S film_thickness_min = std::numeric_limits<S>::infinity();  // distance to the wall
    S film_thickness_mean = std::numeric_limits<S>::infinity();
    S step_error{};      // estimated, in R0; integrators with an estimate only
    S pressure_drop{};   // added by the particle, in kappa/R0^3; 0 without walls
    Index rejected = 0;  // attempts with larger steps before this one
    bool redistributed = false;
};

/// Step control and stationarity of a Simulator.
template <class S>
struct SimulationParams {
    /// Stationary: residual below this, in (0, 1). Velocity scale: the larger of 1 and the background's.
    S tolerance = S(1e-5);
    /// A fixed step if given; then nothing is retried.
    std::optional<S> time_step;
    S first_time_step = S(1e-3);
    S largest_time_step = S(1);
    S smallest_time_step = S(1e-9);
    /// Error allowed in a step, in R0, for integrators that estimate it; never more than a tenth of the motion.
    S step_tolerance = S(1e-4);
    /// Largest normal displacement in a step, in R0, for the other ones.
    S largest_displacement = S(0.02);
    /// Largest automatic step times the shear rate, of the undisturbed flow or half of that across the film: both are
    /// explicit in the position. For integrators without an estimate.
    S largest_strain = S(0.5);
    /// Growth of the automatic step from one step to the next, likewise.
    S growth = S(1.3);
    Index most_steps = 20000;
    /// The last step of the automatic ones ends there.
    S longest_time = std::numeric_limits<S>::max();
    /// Automatic steps end at each of these times too.
    std::vector<S> landing_times{};
};

namespace detail {

template <class S>
void validate(const SimulationParams<S>& p) {
    require(p.tolerance > S(0) && p.tolerance < S(1), "stationarity tolerance", p.tolerance, "in (0, 1)");
    if (p.time_step) {
        require(*p.time_step > S(0), "time step", *p.time_step, "> 0");
    }
    require(p.smallest_time_step > S(0), "smallest time step", p.smallest_time_step, "> 0");
    require(p.first_time_step >= p.smallest_time_step, "first time step", p.first_time_step,
            "at least the smallest time step");
    require(p.largest_time_step >= p.first_time_step, "largest time step", p.largest_time_step,
            "at least the first time step");
    require(p.step_tolerance > S(0), "error allowed in a step", p.step_tolerance, "> 0");
    require(p.largest_displacement > S(0), "largest displacement", p.largest_displacement, "> 0");
    require(p.largest_strain > S(0), "largest strain", p.largest_strain, "> 0");
    require(p.growth > S(1), "growth of the time step", p.growth, "> 1");
    require(p.most_steps >= 1, "number of steps", p.most_steps, "at least 1");
    require(p.longest_time > S(0), "longest time", p.longest_time, "> 0");
    for (const S& time : p.landing_times) {
        require(time >= S(0) && time < std::numeric_limits<S>::infinity(), "landing time", time, ">= 0 and finite");
    }
}

}  // namespace detail

/// A vesicle or rigid body in a flow, from an initial shape to any later time or to its stationary state.
///
/// Failures (a singular system, a self-intersection, a step below the smallest) throw SimulationFailure with the cause;
/// the configuration and the history then are those of the last good step.
template <GreenKernel Kernel, DiscretizationFor<Kernel> Discretization, class Membrane, Background Flow,
          class Integrator, LinearSolver Solver, WallFor<Kernel, Discretization> Wall = NoWall>
requires MembraneFor<Membrane, typename Discretization::Surface, Solver> &&
    TimeIntegratorFor<Integrator, Scene<Kernel, Discretization, Membrane, Flow, Solver, Wall>>
class Simulator {
  public:
    using Scalar = typename Kernel::Scalar;
    using SceneType = Scene<Kernel, Discretization, Membrane, Flow, Solver, Wall>;
    using InstantType = typename SceneType::InstantType;
    using Record = StepRecord<Scalar>;
    using Params = SimulationParams<Scalar>;

    /// Throws InvalidArgument when the shape is not a valid meridian, does not fit between the walls, or a parameter is
    /// out of range.
    explicit Simulator(const Meridian<Scalar>& shape, Flow flow, Params params = {}, Kernel kernel = Kernel{},
                       Discretization discretization = Discretization{}, Membrane membrane = Membrane{},
                       Integrator integrator = Integrator{}, Solver solver = Solver{}, Wall wall = Wall{})
        : params_(params),
          scene_(std::move(kernel), std::move(discretization), std::move(membrane), std::move(flow), std::move(solver),
                 std::move(wall)),
          integrator_(std::move(integrator)) {
        detail::validate(params);
        validate(shape);
        const Measures<Scalar> measures = scene_.discretization().measures(shape);
        configuration_.shape = shape;
        configuration_.shape.z.array() -= measures.centroid;
        configuration_.position = measures.centroid;
        area_ = measures.area;
        volume_ = measures.volume;
        dt_ = params.time_step.value_or(params.first_time_step);
        film_ = scene_.film_thickness(configuration_).min;
        detail::require(film_ > Scalar(0), "initial shape: its distance to the wall", film_,
                        "> 0, that is the shape must fit between the walls");
    }

    const SceneType& scene() const { return scene_; }
    const Params& params() const { return params_; }
    const Configuration<Scalar>& configuration() const { return configuration_; }
    const std::vector<Record>& history() const { return history_; }
    Scalar initial_area() const { return area_; }
    Scalar initial_volume() const { return volume_; }

    /// Whether the last step met the stationarity tolerance.
    bool stationary() const { return !history_.empty() && history_.back().residual < params_.tolerance; }

    /// Whether the longest time has passed; automatic steps end there exactly.
    bool finished() const { return !(time_ < params_.longest_time); }

    /// The shape in the laboratory frame.
    Meridian<Scalar> shape() const {
        Meridian<Scalar> shape = configuration_.shape;
        shape.z.array() += configuration_.position;
        return shape;
    }

    /// Velocities and forces on the current shape.
    InstantType instant() { return scene_.evaluate(configuration_, Scalar(0)); }

    /// Goes on with `elements` elements on the current curve. Throws InvalidArgument for fewer than 8 and
    /// SimulationFailure, leaving the state as it was, if they cannot carry the shape.
    void refine(Index elements) requires(Membrane::deformable) {
        const Discretization& discretization = scene_.discretization();
        Meridian<Scalar> shape = discretization.redistributed(configuration_.shape, elements);
        std::string cause;
        if (!usable(shape, cause) || !discretization.restore(shape, area_, volume_) || !usable(shape, cause)) {
            fail(std::to_string(elements) + " elements cannot carry the shape: " + cause);
        }
        shape.z.array() -= discretization.measures(shape).centroid;
        configuration_.shape = std::move(shape);
        configuration_.tension.resize(0);
        motion_.resize(0);
    }

    /// One time step. Throws SimulationFailure, leaving the state as it was.
    const Record& step() {
        Index rejected = 0;
        Scalar planned = dt_;
        const std::optional<Scalar> landing = next_landing();
        if (!params_.time_step && landing) {
            dt_ = std::min(dt_, Scalar(*landing - time_));
        }
        for (;;) {
            std::string cause;
            if (auto attempt = try_step(cause)) {
                attempt->record.rejected = rejected;
                accept(std::move(*attempt), planned);
                return history_.back();
            }
            if (params_.time_step) {
                fail("time step " + detail::text(dt_) + " is too large: " + cause);
            }
            dt_ = planned = retry_;
            ++rejected;
            if (dt_ < params_.smallest_time_step) {
                fail("the time step fell below " + detail::text(params_.smallest_time_step) + ": " + cause);
            }
        }
    }

    /// Steps until stationary (true), or until most_steps or longest_time (false). `observe(record)` is called after
    /// every step; if it returns bool, false stops the run.
    template <class Observer>
    bool run(Observer observe) {
        const Index last = static_cast<Index>(history_.size()) + params_.most_steps;
        while (static_cast<Index>(history_.size()) < last && !finished()) {
            const Record& record = step();
            if constexpr (std::is_convertible_v<decltype(observe(record)), bool>) {
                if (!observe(record)) {
                    return stationary();
                }
            } else {
                observe(record);
            }
            if (stationary()) {
                return true;
            }
        }
        return false;
    }
    bool run() {
        return run([](const Record&) {});
    }

  private:
    static constexpr bool has_estimate =
        requires(Integrator & integrator, SceneType& scene, const Configuration<Scalar>& start, Scalar dt) {
        { integrator.step(scene, start, dt).error } -> std::convertible_to<Scalar>;
    };

    bool estimates_error() const {
        if constexpr (has_estimate && requires { integrator_.estimates_error(); }) {
            return integrator_.estimates_error();
        } else {
            return has_estimate;
        }
    }

    /// The error may be `step_tolerance`, and a tenth of the membrane's motion: close to a stationary state steps at
    /// the limit of stability would otherwise keep it in motion for ever.
    Scalar allowed_error(const Scalar& motion) const {
        if constexpr (Membrane::deformable) {
            const Scalar rounding = 1000 * std::numeric_limits<Scalar>::epsilon();
            return std::min(params_.step_tolerance, std::max(Scalar(motion / 10), rounding));
        } else {
            return params_.step_tolerance;
        }
    }

    /// From a step to the longest one that should meet the tolerance: the estimate, the error of the order below, grows
    /// like dt^order, and its ratio to the motion like dt^(order - 1).
    Scalar step_factor(const Scalar& error, const Scalar& motion) const {
        using std::pow;
        Scalar wanted = pow(params_.step_tolerance / error, Scalar(1) / Scalar(integrator_.order));
        const Scalar allowed = allowed_error(motion);
        if (integrator_.order > 1 && allowed < params_.step_tolerance) {
            wanted = std::min(wanted, Scalar(pow(allowed / error, Scalar(1) / Scalar(integrator_.order - 1))));
        }
        // NaN and infinite errors end up at the lower bound.
        return wanted > Scalar(0.2) ? std::min(Scalar(Scalar(0.9) * wanted), Scalar(3)) : Scalar(0.2);
    }

    /// The first of the longest time and the landing times that is yet to come.
    std::optional<Scalar> next_landing() const {
        std::optional<Scalar> next;
        const auto consider = [&](const Scalar& time) {
            if (time > time_ && (!next || time < *next)) {
                next = time;
            }
        };
        consider(params_.longest_time);
        std::for_each(params_.landing_times.begin(), params_.landing_times.end(), consider);
        return next;
    }

    struct Attempt {
        Configuration<Scalar> configuration;
        Record record;
        Vector<Scalar> motion;  // velocity relative to the centroid, stacked
        Scalar shear_rate{};
    };

    [[noreturn]] void fail(const std::string& cause) const {
        throw SimulationFailure("step " + std::to_string(history_.size() + 1) + " at time " + detail::text(time_) +
                                ": " + cause);
    }

    std::optional<Attempt> try_step(std::string& cause) {
        retry_ = dt_ / 2;
        auto step = [&] {
            try {
                return std::optional(integrator_.step(scene_, configuration_, dt_));
            } catch (const SimulationFailure& failure) {
                cause = failure.what();
                return std::optional<decltype(integrator_.step(scene_, configuration_, dt_))>();
            }
        }();
        if (!step) {
            return std::nullopt;
        }
        Attempt attempt;
        Record& record = attempt.record;
        record.residual = step->instant.deformation_rate / std::max(Scalar(1), scene_.velocity_scale());
        record.velocity = step->instant.velocity;
        if constexpr (has_estimate) {
            record.step_error = step->error;
            const Scalar motion = step->instant.deformation_rate * dt_;
            if (estimates_error() && !params_.time_step && !(step->error <= allowed_error(motion))) {
                cause = "the step's error is " + detail::text(step->error) + " R0";
                retry_ = dt_ * std::min(Scalar(0.5), step_factor(step->error, motion));
                return std::nullopt;
            }
        }
        Configuration<Scalar>& next = attempt.configuration;
        next.position = configuration_.position + step->displacement;
        next.shape = std::move(step->shape);
        if constexpr (Membrane::deformable) {
            attempt.motion = step->instant.solution.velocity;
            attempt.shear_rate = step->instant.shear_rate;
            attempt.motion.tail(next.shape.nodes()).array() -= record.velocity;
            next.tension = std::move(step->instant.solution.tension);
            const Scalar displacement = step->instant.deformation_rate * dt_;
            if (!estimates_error() && !params_.time_step && !(displacement <= 2 * params_.largest_displacement)) {
                cause = "the membrane would move by " + detail::text(displacement) + " R0";
                return std::nullopt;
            }
            if (!deform(next, record, cause)) {
                return std::nullopt;
            }
        }
        describe(next, record);
        if constexpr (SceneType::confined) {
            const FilmThickness<Scalar> film = scene_.film_thickness(next);
            record.film_thickness_min = film.min;
            record.film_thickness_mean = film.mean;
            if (Membrane::deformable && !clear_of_wall(record, cause)) {
                return std::nullopt;
            }
        }
        record.pressure_drop = step->instant.pressure_drop;
        return attempt;
    }

    /// Checks and corrects a displaced shape; false, with the cause, if it cannot be used.
    bool deform(Configuration<Scalar>& next, Record& record, std::string& cause) const {
        Meridian<Scalar>& shape = next.shape;
        if (!usable(shape, cause)) {
            return false;
        }
        const Discretization& discretization = scene_.discretization();
        const Measures<Scalar> raw = discretization.measures(shape);
        record.area_error = raw.area / area_ - 1;
        record.volume_error = raw.volume / volume_ - 1;
        if (!discretization.restore(shape, area_, volume_)) {
            cause = "area and volume drifted by " + detail::text(record.area_error) + " and " +
                    detail::text(record.volume_error) + " and could not be restored";
            return false;
        }
        record.redistributed = discretization.redistribute(shape);
        if (record.redistributed && !discretization.restore(shape, area_, volume_)) {
            cause = "area and volume could not be restored after the nodes were moved along the membrane, for which " +
                    std::to_string(shape.nodes()) + " of them are too few";
            return false;
        }
        return usable(shape, cause);
    }

    /// In one step the film may lose at most half of its thickness.
    bool clear_of_wall(const Record& record, std::string& cause) const {
        if (record.film_thickness_min > film_ / 2 || std::isinf(static_cast<double>(film_))) {
            return true;
        }
        cause = record.film_thickness_min > Scalar(0)
                    ? "the distance to the wall would shrink from " + detail::text(film_) + " to " +
                          detail::text(record.film_thickness_min)
                    : "the membrane would cross the wall";
        return false;
    }

    static bool usable(const Meridian<Scalar>& shape, std::string& cause) {
        cause = detail::fault(shape);
        return cause.empty();
    }

    void describe(Configuration<Scalar>& next, Record& record) const {
        const Discretization& discretization = scene_.discretization();
        const Measures<Scalar> measures = discretization.measures(next.shape);
        next.shape.z.array() -= measures.centroid;
        next.position += measures.centroid;
        record.step = static_cast<Index>(history_.size()) + 1;
        const std::optional<Scalar> landing = next_landing();
        record.time = landing && dt_ == *landing - time_ ? *landing : Scalar(time_ + dt_);
        record.dt = dt_;
        record.position = next.position;
        record.length = next.shape.z[next.shape.nodes() - 1] - next.shape.z[0];
        record.max_radius = discretization.max_radius(next.shape);
        record.area = measures.area;
        record.volume = measures.volume;
        record.area_drift = measures.area / area_ - 1;
        record.volume_drift = measures.volume / volume_ - 1;
        if constexpr (Membrane::deformable) {
            record.bending_energy = discretization.bending_energy(next.shape);
        }
    }

    /// `planned`: the step before it was cut short to land.
    void accept(Attempt attempt, const Scalar& planned) {
        using std::abs;
        const Scalar rate = attempt.record.residual * std::max(Scalar(1), scene_.velocity_scale());
        const bool accelerating = !history_.empty() && attempt.record.residual > history_.back().residual;
        // A step that is too long overshoots: the next one goes back. On moved nodes velocities cannot be compared.
        const bool reversed =
            motion_.size() > 0 && !history_.back().redistributed && attempt.motion.dot(motion_) < Scalar(0);
        motion_ = std::move(attempt.motion);
        time_ = attempt.record.time;
        configuration_ = std::move(attempt.configuration);
        film_ = attempt.record.film_thickness_min;
        history_.push_back(attempt.record);
        if (params_.time_step) {
            return;
        }
        if (estimates_error()) {
            const Scalar factor = step_factor(attempt.record.step_error, rate * dt_);
            dt_ = planned > dt_ ? std::max(planned, Scalar(factor * dt_))
                                : dt_ * (attempt.record.rejected > 0 ? std::min(Scalar(1), factor) : factor);
        } else {
            dt_ = planned;
            if (reversed) {
                dt_ /= 2;
            } else if (!accelerating || rate * dt_ < params_.largest_displacement / 10) {
                dt_ *= params_.growth;
            }
            if (rate * dt_ > params_.largest_displacement) {
                dt_ = params_.largest_displacement / rate;
            }
            const Scalar shear = std::max(attempt.shear_rate, Scalar(abs(history_.back().velocity) / (2 * film_)));
            if (shear * dt_ > params_.largest_strain) {
                dt_ = params_.largest_strain / shear;
            }
        }
        dt_ = std::min(dt_, params_.largest_time_step);
    }

    Params params_;
    SceneType scene_;
    Integrator integrator_;
    Configuration<Scalar> configuration_;
    std::vector<Record> history_;
    Vector<Scalar> motion_;  // of the last step
    Scalar area_{};
    Scalar volume_{};
    Scalar time_{};
    Scalar dt_{};
    Scalar retry_{};  // the step to try when dt_ fails
    Scalar film_{};
};

}  // namespace axistokes
