// SPDX-License-Identifier: MIT
// From a simulation and an accuracy to a result with an error estimate: marching in time, stationary states by the best
// way there is, and as many elements as the accuracy takes (docs/accuracy.md).
#pragma once

#include "../geometry/distance.hpp"
#include "../simulator.hpp"
#include "../stationary/stationary_solver.hpp"
#include "driver_params.hpp"
#include "resolution.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace axistokes {

/// What a run came to, by whatever way.
template <class Simulator>
struct DriverResult {
    using S = typename Simulator::Scalar;

    Configuration<S> configuration;
    std::optional<typename Simulator::InstantType> instant;
    std::optional<S> velocity;
    std::optional<S> residual;
    bool stationary = false;
    bool interrupted = false;
    /// Relative, of velocity and length; infinite if there is no telling.
    S error_estimate = std::numeric_limits<S>::infinity();
    S eps{};
    /// Why Newton's method, or more elements, did not work; empty if they did, or were not tried.
    std::string newton_failure;
    std::string refinement_failure;
    Index newton_iterations = 0;
    Index newton_evaluations = 0;
    /// Growth rate of the fastest axisymmetric disturbance, found with so many elements; stable if negative.
    std::optional<S> growth_rate;
    Index stability_elements = 0;

    bool error_met() const { return error_estimate <= eps; }
};

namespace detail {

template <class SceneType>
struct UsualSolver {
    using type = void;
};
template <class SceneType>
requires(SceneType::deformable) struct UsualSolver<SceneType> {
    using type = StationarySolver<SceneType>;
};

}  // namespace detail

/// Runs simulations of one body, or, marching only, of several. Without a Solver (void) all states are marched to.
template <class Simulator, class Solver = typename detail::UsualSolver<typename Simulator::SceneType>::type>
class Driver {
  public:
    using S = typename Simulator::Scalar;
    using Discretization = std::remove_cvref_t<decltype(std::declval<Simulator>().scene().discretization())>;
    using Params = DriverParams<S>;
    using Result = DriverResult<Simulator>;
    /// The simulation from its initial shape, with so many elements at least: more if they could not carry it.
    using Make = std::function<Simulator(Index)>;
    /// Called after every step; false stops the run.
    using Observer = std::function<bool(const Simulator&)>;

    Driver(
        Make make, Params params, Observer observer = [](const Simulator&) { return true; })
        : make_(std::move(make)), params_(std::move(params)), observe_(std::move(observer)) {
        result_.eps = params_.eps;
        restart(params_.elements.value_or(params_.first_elements.value_or(first_elements<Discretization>)));
    }

    Simulator& simulator() { return *simulator_; }
    const Simulator& simulator() const { return *simulator_; }
    const Result& result() const { return result_; }

    /// Throws SimulationFailure where the simulation cannot go on; result() then is that of the last good state.
    const Result& run() {
        try {
            if (!moves()) {
                solve_rigid();
            } else if (params_.transient || !newton_possible() || params_.way == WayToStationary::march) {
                march_to_the_end();
            } else {
                find_stationary();
            }
        } catch (const SimulationFailure&) {
            take();
            throw;
        }
        result_.interrupted = stopped_;
        return result_;
    }

  private:
    static constexpr bool can_judge = JudgesItself<Discretization>;
    static constexpr bool deformable = Simulator::SceneType::deformable;

    void restart(Index elements) { simulator_.emplace(make_(elements)); }

    const Discretization& discretization() const { return simulator_->scene().discretization(); }
    bool spectral() const { return judges_itself(discretization()); }
    Index most() const { return most_elements(discretization()); }
    const Meridian<S>& shape(std::size_t body = 0) const { return simulator_->configuration(body).shape; }
    Index elements() const { return shape().elements(); }
    Index steps() const { return static_cast<Index>(simulator_->history().size()); }
    bool adapts() const { return !params_.elements; }

    /// Whether more than one instant matters: rigid bodies have no way to go unless asked for.
    bool moves() const {
        for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
            if (simulator_->scene().deforms(b)) {
                return true;
            }
        }
        return params_.transient;
    }

    /// One body, and not a sphere, which has nothing to solve for.
    bool newton_possible() const {
        if constexpr (deformable && !std::is_void_v<Solver>) {
            const Measures<S> m{simulator_->initial_area(), simulator_->initial_volume(), S(0)};
            return simulator_->bodies() == 1 && simulator_->scene().deforms(0) &&
                   (m.excess_area() > S(1e-5) || !detail::keeps_area(simulator_->scene().law()));
        } else {
            return false;
        }
    }

    /// Share of the last modes that may remain: on the way to a stationary state the residual's size will do.
    S allowed() const {
        const S residual = steps() > 0 ? simulator_->residual() : S(1);
        return params_.transient ? params_.unresolved : std::max(params_.unresolved, std::min(S(5e-3), residual));
    }

    /// The first body that needs more modes, or none.
    std::optional<std::size_t> needy() const {
        if constexpr (can_judge && deformable) {
            for (std::size_t b = 0; spectral() && adapts() && b < simulator_->bodies(); ++b) {
                if (simulator_->scene().deforms(b) && shape(b).elements() < most() &&
                    discretization().unresolved(shape(b)) > allowed()) {
                    return b;
                }
            }
        }
        return std::nullopt;
    }

    void add_elements(std::size_t body) {
        if constexpr (can_judge && deformable) {
            simulator_->refine(more_modes(shape(body).elements(), double(discretization().unresolved(shape(body))),
                                          double(allowed()), most()),
                               body);
        }
    }

    /// At least `first` steps, then until the residual is below `residual`, until `last` steps or the end of the run;
    /// with more elements as soon as a shape needs them, or if the simulation cannot go on with those it has.
    void march(const S& residual, Index first, Index last) {
        bool going = true;
        int rescues = 3;
        const auto observe = [&](const auto& record) {
            stopped_ = !observe_(*simulator_);
            going = (record.step < first || !(simulator_->residual() < residual)) && record.step < last &&
                    !simulator_->finished() && !stopped_;
            return going && !needy();
        };
        while (going && steps() < last && !simulator_->finished()) {
            try {
                simulator_->run(observe);
            } catch (const SimulationFailure&) {
                if (!adapts() || !deformable || elements() >= most() || rescues-- == 0) {
                    throw;
                }
                rescue();
                continue;
            }
            if (const auto body = needy(); body && !stopped_) {
                add_elements(*body);
                going = steps() < last;
            } else {
                going = going && !simulator_->stationary();
            }
        }
    }

    /// Goes on with half as many elements again: a shape that cannot move on may not be carried by those it has.
    void rescue() {
        if constexpr (deformable) {
            const Index next = std::min(most(), elements() + elements() / 2);
            if (steps() == 0) {
                restart(next);
            } else {
                for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                    if (simulator_->scene().deforms(b)) {
                        simulator_->refine(next, b);
                    }
                }
            }
        }
    }

    void march_on() { march(simulator_->params().tolerance, 0, simulator_->params().most_steps); }

    void march_to_the_end() {
        march_on();
        if (spectral()) {
            estimate_from_modes();
        } else if (adapts()) {
            refine_until_met();
        } else {
            estimate_from_coarser();
        }
        take();
    }

    /// Velocity and force of a rigid body. Its shape may be simple and its traction is not: two results tell the error
    /// of the coarser one, or, of second order, that of the finer.
    void solve_rigid() {
        const Index most_of_rigid = 2 * most();
        settle_rigid();
        auto now = velocity_and_force(*simulator_);
        if (!adapts()) {
            Simulator coarse = make_(std::max(minimum_elements, (2 * elements()) / 3));
            result_.error_estimate =
                rigid_error(velocity_and_force(coarse), now, coarse.configuration().shape.elements());
        }
        while (adapts() && !(result_.error_estimate <= params_.eps) && elements() < most_of_rigid && !stopped_) {
            const Index before = elements();
            const double error = std::min(1.0, double(result_.error_estimate));
            restart(spectral() ? std::min(most_of_rigid, before + before / 2)
                               : more_elements(before, error, double(params_.eps), most_of_rigid));
            settle_rigid();
            const auto finer = velocity_and_force(*simulator_);
            result_.error_estimate = rigid_error(now, finer, before);
            now = finer;
        }
        take();
    }

    /// One body is stationary at once; of several the instant they are given at is wanted.
    void settle_rigid() {
        if (simulator_->bodies() == 1) {
            march_on();
        }
    }

    /// Of all bodies.
    static std::pair<Vector<S>, Vector<S>> velocity_and_force(Simulator& simulator) {
        const auto count = static_cast<Index>(simulator.bodies());
        std::pair<Vector<S>, Vector<S>> result{Vector<S>(count), Vector<S>(count)};
        for (Index b = 0; b < count; ++b) {
            const auto& instant = simulator.instant(static_cast<std::size_t>(b));
            result.first[b] = instant.velocity;
            result.second[b] = instant.surface.weight.dot(instant.solution.force.tail(instant.surface.size()));
        }
        return result;
    }

    /// Of velocities; of forces, where nothing drives bodies of given velocities.
    S rigid_error(const std::pair<Vector<S>, Vector<S>>& coarse, const std::pair<Vector<S>, Vector<S>>& fine,
                  Index coarse_elements) const {
        const bool driven = simulator_->scene().velocity_scale() > S(0);
        const Vector<S>& a = driven ? coarse.first : coarse.second;
        const Vector<S>& b = driven ? fine.first : fine.second;
        const S difference = (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
        const S ratio = S(elements()) / S(coarse_elements);
        return spectral() ? difference : S(difference / (ratio * ratio - S(1)));
    }

    MeasuredState measured(const Simulator& simulator) const {
        const auto& configuration = simulator.configuration();
        const auto& history = simulator.history();
        // Nothing drives a body at rest: its velocity is no result.
        const bool driven = simulator.scene().velocity_scale() > S(0);
        return {driven && !history.empty() ? double(history.back().velocity) : 0.0, length(configuration),
                configuration.shape.elements()};
    }
    static double length(const Configuration<S>& c) {
        return static_cast<double>(c.shape.z[c.shape.nodes() - 1] - c.shape.z[0]);
    }

    void estimate_from_modes() {
        if constexpr (can_judge) {
            S share = 0;
            for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                share = std::max<S>(share, discretization().unresolved(shape(b)));
            }
            result_.error_estimate = share / S(Accuracy<S>::unresolved_to_error) + time_error();
        }
    }

    /// Of steps of first order to a given time: the sum of dt/2 times the change of the velocities, relative to the
    /// length. Steps that estimate their error keep to the accuracy.
    S time_error() const {
        using std::abs;
        const auto& history = simulator_->history();
        S sum = 0;
        if (!params_.transient || history.empty() || history.back().step_error > S(0)) {
            return sum;
        }
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        for (std::size_t i = 1; i < history.size(); ++i) {
            sum += history[i].dt / 2 *
                   (scale * abs(history[i].residual - history[i - 1].residual) +
                    abs(history[i].velocity - history[i - 1].velocity));
        }
        return sum / S(length(simulator_->configuration()));
    }

    /// P1: from the difference to a run with three quarters of the elements; half of them may not be in the range of
    /// second order.
    void estimate_from_coarser() {
        const MeasuredState fine = measured(*simulator_);
        const Index fewer = std::max(minimum_elements, (3 * fine.elements) / 4);
        if (fewer == fine.elements || stopped_) {
            return;
        }
        try {
            Simulator coarse = make_(fewer);
            coarse.run([&](const auto&) { return !coarse.finished(); });
            result_.error_estimate = S(second_order_error(measured(coarse), fine)) + time_error();
        } catch (const SimulationFailure&) {
            // Without a coarser result there is no telling.
        }
    }

    /// P1: more and more elements until two results agree.
    void refine_until_met() {
        MeasuredState coarse = measured(*simulator_);
        double error = 1;  // unknown
        while (!stopped_) {
            const Index next = more_elements(coarse.elements, error, double(params_.eps), most());
            if (params_.transient || !deformable) {
                restart(next);
            } else if constexpr (deformable) {
                simulator_->refine(next);
            }
            march_on();
            const MeasuredState fine = measured(*simulator_);
            error = second_order_error(coarse, fine);
            coarse = fine;
            result_.error_estimate = S(error) + time_error();
            if (error <= double(params_.eps) || fine.elements >= most()) {
                break;
            }
        }
    }

    /// Of the simulator's last step, its last good one if it failed.
    void take() {
        result_.configuration = simulator_->configuration();
        try {
            result_.instant = simulator_->instant();
            result_.velocity = result_.instant->velocity;
        } catch (const SimulationFailure&) {
            // Reported already: the run cannot have ended well on such a shape.
        }
        result_.stationary = simulator_->stationary();
        if (steps() > 0) {
            result_.residual = simulator_->residual();
            if (!result_.velocity) {
                result_.velocity = simulator_->history().back().velocity;
            }
        }
    }

    /// Marches until Newton's method converges on the branch that the march has settled on; to the end if it never
    /// does.
    ///
    /// A residual of 1e-2 (of the flow's velocity) may still be on the way from one branch to another, and in a strong
    /// flow it is small from the start: a solution far from the marched shape is not taken before the march has come
    /// much closer to rest, unless it does not get there at all (a limit cycle).
    void find_stationary() {
        const bool eager = params_.way == WayToStationary::newton;
        constexpr int attempts = 5;
        constexpr Index least = 20;
        const Index patience = eager ? 40 : 150;
        S handover = eager ? S(3e-2) : S(2e-3);
        for (int attempt = 0; attempt < attempts && !stopped_; ++attempt) {
            const S target = std::max(handover, simulator_->params().tolerance);
            march(target, least, std::min<Index>(steps() + patience, simulator_->params().most_steps));
            const bool arrived = simulator_->residual() < target;
            if (stopped_ || (simulator_->stationary() && !adapts() && !(params_.newton_tolerance < S(1e-7)))) {
                break;
            }
            if (converged(eager || !arrived || attempt + 1 == attempts)) {
                return;
            }
            handover = std::min(handover, simulator_->residual()) / 5;
        }
        march_to_the_end();
    }

    bool converged(bool anywhere) {
        const Result before = result_;
        try {
            converge(anywhere);
            result_.newton_failure.clear();
            return true;
        } catch (const SimulationFailure& failure) {
            result_ = before;
            result_.newton_failure = failure.what();
            return false;
        }
    }

    /// The stationary state near the simulator's, with more and more elements if these are to be chosen. What a finer
    /// one fails to improve stays.
    void converge(bool anywhere) {
        if constexpr (deformable && !std::is_void_v<Solver>) {
            typename Solver::Params solver_params;
            solver_params.tolerance = params_.newton_tolerance;
            solver_params.to_round_off = params_.to_round_off;
            Solver solver(simulator_->scene(), solver_params);
            const S area = simulator_->initial_area();
            const S volume = simulator_->initial_volume();
            auto state = solver.solve(shape(), area, volume);
            if (!anywhere) {
                constexpr double far = 0.05;
                if (distance(state.configuration.shape, shape()) > S(far)) {
                    throw SimulationFailure("stationary state: the solution is not near the shape marched to");
                }
            }
            result_.newton_iterations = state.iterations;
            result_.newton_evaluations = state.evaluations;
            bool examined = false;
            S error = std::numeric_limits<S>::infinity();
            if (!spectral()) {
                error = coarse_difference(solver, state, area, volume);
            }
            for (;;) {
                const Meridian<S>& now = state.configuration.shape;
                if constexpr (can_judge) {
                    error =
                        spectral() ? S(discretization().unresolved(now) / S(Accuracy<S>::unresolved_to_error)) : error;
                }
                adopt(state, error);
                const bool last = error <= params_.eps || !adapts() || now.elements() >= most() || stopped_;
                // Growth rates need no more than a recognisable shape, and cost as much as many iterations.
                if (!examined && (last || !spectral() || error < S(1e-3))) {
                    examine(solver, state);
                    examined = true;
                }
                if (last) {
                    return;
                }
                const Index next =
                    spectral() ? more_modes(now.elements(), 2 * double(error), double(params_.unresolved), most())
                               : more_elements(now.elements(), double(error), double(params_.eps), most());
                try {
                    auto finer = solver.solve(discretization().redistributed(now, next), area, volume);
                    result_.newton_iterations += finer.iterations;
                    result_.newton_evaluations += finer.evaluations;
                    if (!spectral()) {
                        error = S(second_order_error(measured_state(state), measured_state(finer)));
                    }
                    state = std::move(finer);
                } catch (const SimulationFailure& failure) {
                    result_.refinement_failure = failure.what();
                    return;
                }
            }
        }
    }

    template <class State>
    static MeasuredState measured_state(const State& state) {
        return {double(state.instant.velocity), length(state.configuration), state.configuration.shape.elements()};
    }

    /// P1: against three quarters of the elements.
    template <class Newton, class State>
    S coarse_difference(Newton& solver, const State& fine, const S& area, const S& volume) {
        const Index fewer = std::max(minimum_elements, (3 * fine.configuration.shape.elements()) / 4);
        try {
            const auto coarse =
                solver.solve(discretization().redistributed(fine.configuration.shape, fewer), area, volume);
            return S(second_order_error(measured_state(coarse), measured_state(fine)));
        } catch (const SimulationFailure&) {
            return std::numeric_limits<S>::infinity();
        }
    }

    /// Of a coarser state near this one if there are many modes: growth rates need no accuracy, and one evaluation or
    /// two a mode. An unstable state is no end of a march.
    template <class Newton, class State>
    void examine(Newton& solver, const State& given) {
        constexpr Index enough = 64;
        State state = given;
        if (spectral() && given.configuration.shape.elements() > enough) {
            try {
                state = solver.solve(discretization().redistributed(given.configuration.shape, enough),
                                     simulator_->initial_area(), simulator_->initial_volume());
            } catch (const SimulationFailure&) {
                return;  // without them
            }
        }
        const S rate = solver.growth_rates(state).front().real();
        result_.growth_rate = rate;
        result_.stability_elements = state.configuration.shape.elements();
        if (params_.way == WayToStationary::automatic && rate > S(0)) {
            throw SimulationFailure("stationary state: it is unstable, with a growth rate of " + detail::text(rate));
        }
    }

    template <class State>
    void adopt(const State& state, const S& error) {
        result_.configuration = state.configuration;
        result_.configuration.position = simulator_->configuration().position;
        result_.instant = state.instant;
        result_.velocity = state.instant.velocity;
        result_.residual = state.residual;
        result_.stationary = true;
        result_.error_estimate = error;
    }

    Make make_;
    Params params_;
    Observer observe_;
    std::optional<Simulator> simulator_;
    Result result_;
    bool stopped_ = false;
};

}  // namespace axistokes
