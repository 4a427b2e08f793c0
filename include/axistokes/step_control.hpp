// SPDX-License-Identifier: MIT
// How long a time step is (a policy of the Simulator): fixed, by an estimate of its error, or by how far the interface
// moves.
#pragma once

#include "core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace axistokes {

/// What a step control is told of an attempted step.
template <class S>
struct StepReport {
    S dt{};
    std::optional<S> error;  // estimated, in R0
    int order = 1;
    bool deformable = true;
    /// Largest normal displacement relative to the centroids, in R0; of a law that carries a reference, the largest
    /// one.
    S displacement{};
    /// Largest shear rate: of the undisturbed flow, or half of the velocity over the film.
    S shear_rate{};
    /// Whether the normal motion is directed against that of the step before.
    bool reversed = false;
    /// Whether the residual has grown.
    bool accelerating = false;
};

/// A step that is too long; `retry` may be better.
class StepRejected : public SimulationFailure {
  public:
    StepRejected(const std::string& cause, double factor) : SimulationFailure(cause), factor_(factor) {}
    double factor() const { return factor_; }

  private:
    double factor_;
};

/// StepControl: `step()` is the step to try next. `judge(report)` throws StepRejected when an attempt was too long,
/// `shorten(factor)` plans a shorter one, or returns false if there is none, and `accept(report, planned, retried)`
/// plans the next; `planned` is the step before it was cut short to end at a given time. `fixed()` tells whether steps
/// are never changed.
template <class C, class S>
concept StepControlFor = requires(C& control, const C& constant, const StepReport<S>& report, S dt) {
    { constant.step() } -> std::convertible_to<S>;
    { constant.fixed() } -> std::convertible_to<bool>;
    constant.judge(report);
    { control.shorten(dt) } -> std::convertible_to<bool>;
    control.accept(report, dt, false);
};

template <class S>
struct StepControlParams {
    /// A fixed step if given; then nothing is retried.
    std::optional<S> time_step;
    S first_time_step = S(1e-3);
    S largest_time_step = S(1);
    /// If not given 1e-9, of a Simulator over the larger of 1 and the scene's velocity scale.
    std::optional<S> smallest_time_step;
    /// Error allowed in a step, in R0, for integrators that estimate it; never more than a tenth of the motion.
    S step_tolerance = S(1e-4);
    /// Largest normal displacement in a step, in R0, for the other ones.
    S largest_displacement = S(0.02);
    /// Largest automatic step times the shear rate, of the undisturbed flow or half of that across the film: both are
    /// explicit in the position. For integrators without an estimate.
    S largest_strain = S(0.5);
    /// Growth of the automatic step from one step to the next, likewise.
    S growth = S(1.3);
};

namespace detail {

template <class S>
S smallest_step(const StepControlParams<S>& p, const S& velocity_scale = S(1)) {
    return p.smallest_time_step.value_or(S(1e-9) / std::max(S(1), velocity_scale));
}

template <class S>
void validate_steps(const StepControlParams<S>& p) {
    using std::isfinite;
    if (p.time_step) {
        require(*p.time_step > S(0) && isfinite(*p.time_step), "time step", *p.time_step, "> 0 and finite");
    }
    require(smallest_step(p) > S(0), "smallest time step", smallest_step(p), "> 0");
    require(p.first_time_step >= smallest_step(p), "first time step", p.first_time_step,
            "at least the smallest time step");
    require(p.largest_time_step >= p.first_time_step && isfinite(p.largest_time_step), "largest time step",
            p.largest_time_step, "at least the first time step, and finite");
    const S least = 8 * std::numeric_limits<S>::epsilon();
    require(p.step_tolerance >= least && isfinite(p.step_tolerance), "error allowed in a step", p.step_tolerance,
            "at least 8 eps, and finite");
    require(p.largest_displacement > S(0) && isfinite(p.largest_displacement), "largest displacement",
            p.largest_displacement, "> 0 and finite");
    require(p.largest_strain > S(0) && isfinite(p.largest_strain), "largest strain", p.largest_strain,
            "> 0 and finite");
    require(p.growth > S(1) && isfinite(p.growth), "growth of the time step", p.growth, "> 1 and finite");
}

}  // namespace detail

/// The default control.
template <class S>
class StepControl {
  public:
    using Params = StepControlParams<S>;
    using Report = StepReport<S>;

    /// Throws InvalidArgument when a parameter is out of range.
    explicit StepControl(const Params& params)
        : params_(params), dt_(params.time_step.value_or(params.first_time_step)) {
        detail::validate_steps(params);
    }

    const S& step() const { return dt_; }
    bool fixed() const { return params_.time_step.has_value(); }

    void judge(const Report& report) const {
        if (fixed()) {
            return;
        }
        if (report.error) {
            if (!(*report.error <= allowed_error(report))) {
                throw StepRejected("the step's error is " + detail::text(*report.error) + " R0",
                                   static_cast<double>(std::min(S(0.5), step_factor(report))));
            }
        } else if (report.deformable && !(report.displacement <= 2 * params_.largest_displacement)) {
            throw StepRejected("the membrane would move by " + detail::text(report.displacement) + " R0", 0.5);
        }
    }

    bool shorten(const S& dt) {
        dt_ = dt;
        return !fixed() && !(dt < detail::smallest_step(params_));
    }

    void accept(const Report& report, const S& planned, bool retried) {
        if (fixed()) {
            return;
        }
        if (report.error) {
            const S factor = step_factor(report);
            dt_ = planned > report.dt ? std::max(planned, S(factor * report.dt))
                                      : report.dt * (retried ? std::min(S(1), factor) : factor);
        } else {
            const S rate = report.displacement / report.dt;
            dt_ = planned;
            if (report.reversed) {
                // A step that is too long overshoots: the next one goes back.
                dt_ /= 2;
            } else if (!report.accelerating || rate * dt_ < params_.largest_displacement / 10) {
                dt_ *= params_.growth;
            }
            if (rate * dt_ > params_.largest_displacement) {
                dt_ = params_.largest_displacement / rate;
            }
            if (report.shear_rate * dt_ > params_.largest_strain) {
                dt_ = params_.largest_strain / report.shear_rate;
            }
        }
        dt_ = std::min(dt_, params_.largest_time_step);
    }

  private:
    /// The error may be `step_tolerance`, and a tenth of the interface's motion: close to a stationary state steps at
    /// the limit of stability would otherwise keep it in motion for ever.
    S allowed_error(const Report& report) const {
        if (!report.deformable) {
            return params_.step_tolerance;
        }
        const S rounding = 1000 * std::numeric_limits<S>::epsilon();
        return std::min(params_.step_tolerance, std::max(S(report.displacement / 10), rounding));
    }

    /// From a step to the longest one that should meet the tolerance: the estimate, the error of the order below, grows
    /// like dt^order, and its ratio to the motion like dt^(order - 1).
    S step_factor(const Report& report) const {
        using std::pow;
        const S& error = *report.error;
        S wanted = pow(params_.step_tolerance / error, S(1) / S(report.order));
        const S allowed = allowed_error(report);
        if (report.order > 1 && allowed < params_.step_tolerance) {
            wanted = std::min(wanted, S(pow(allowed / error, S(1) / S(report.order - 1))));
        }
        // NaN and infinite errors end up at the lower bound.
        return wanted > S(0.2) ? std::min(S(S(0.9) * wanted), S(3)) : S(0.2);
    }

    Params params_;
    S dt_;
};

}  // namespace axistokes
