// SPDX-License-Identifier: MIT
// From a simulation and an accuracy to a result with an error estimate: marching in time, stationary states by the best
// way there is, and as many elements as the accuracy takes (docs/accuracy.md).
#pragma once

#include "../geometry/distance.hpp"
#include "../geometry/shapes.hpp"
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
#include <vector>

namespace axistokes {

/// What a run came to, by whatever way.
template <class Simulator>
struct DriverResult {
    using S = typename Simulator::Scalar;

    typename Simulator::State bodies;
    /// Empty if nothing could be computed on the bodies.
    typename Simulator::SceneType::Instants instants;
    std::optional<S> velocity;  // of the first body
    std::optional<S> residual;
    bool stationary = false;
    bool interrupted = false;
    /// Relative, of velocity and length; infinite if there is no telling.
    S error_estimate = std::numeric_limits<S>::infinity();
    S eps{};
    /// Of the last step, or of the state Newton's method found (Verdict): what energy says of the forces' error; and
    /// the largest of all steps.
    S power_mismatch{};
    S largest_power_mismatch{};
    /// Why Newton's method, or more elements, did not work; empty if they did, or were not tried.
    std::string newton_failure;
    std::string refinement_failure;
    Index newton_iterations = 0;
    Index newton_evaluations = 0;
    /// Growth rate of the fastest axisymmetric disturbance, found with so many elements; stable if negative. None where
    /// these do not resolve a film.
    std::optional<S> growth_rate;
    Index stability_elements = 0;

    bool error_met() const { return error_estimate <= eps; }
    const Configuration<S>& configuration(std::size_t body = 0) const { return bodies.at(body); }
    /// None if nothing could be computed on the bodies.
    const typename Simulator::InstantType* instant(std::size_t body = 0) const {
        return body < instants.size() ? &instants[body] : nullptr;
    }
};

namespace detail {

template <class SceneType>
struct UsualSolver {
    using type = void;
};
template <class SceneType>
requires(SceneType::deformable && !SceneType::carries_reference) struct UsualSolver<SceneType> {
    using type = StationarySolver<SceneType>;
};

}  // namespace detail

/// Runs simulations of any bodies. Without a Solver (void) all states are marched to.
template <class Simulator, class Solver = typename detail::UsualSolver<typename Simulator::SceneType>::type>
class Driver {
  public:
    using S = typename Simulator::Scalar;
    using Discretization = std::remove_cvref_t<decltype(std::declval<Simulator>().scene().discretization())>;
    using State = typename Simulator::State;
    using Params = DriverParams<S>;
    using Result = DriverResult<Simulator>;
    /// The simulation from its initial shape, with so many elements at least: more if they could not carry it.
    using Make = std::function<Simulator(Index)>;
    /// Called after every step, and before every iteration of Newton's method; false stops the run.
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

    /// Throws SimulationFailure where the simulation cannot go on, and OutputError where a step cannot be recorded;
    /// result() then is that of the last good state. A stop is no failure: result().interrupted.
    const Result& run() {
        try {
            if (!moves()) {
                solve_rigid();
            } else if (params_.transient || !newton_possible() || params_.way == WayToStationary::march) {
                march_to_the_end();
            } else {
                find_stationary();
            }
        } catch (const SimulationStopped&) {
            stopped_ = true;
            take();
        } catch (...) {
            take();
            throw;
        }
        result_.interrupted = stopped_;
        return result_;
    }

  private:
    using TheReferee = Referee<typename Simulator::SceneType>;
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

    /// Rigid bodies cost less.
    Index most(std::size_t body) const { return simulator_->scene().deforms(body) ? most() : 2 * most(); }

    /// Whether more than one instant matters: rigid bodies have no way to go unless asked for.
    bool moves() const { return params_.transient || !all_rigid(); }

    /// Not of spheres, which have nothing to solve for.
    bool newton_possible() const {
        if constexpr (deformable && !std::is_void_v<Solver>) {
            for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                if (simulator_->scene().deforms(b) && initial_measures(b).excess_area() <= S(1e-5) &&
                    detail::keeps_area(simulator_->scene().law(b))) {
                    return false;
                }
            }
            return !all_rigid();
        } else {
            return false;
        }
    }
    Measures<S> initial_measures(std::size_t body) const {
        return {simulator_->initial_area(body), simulator_->initial_volume(body), S(0)};
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
            const auto share = double(discretization().unresolved(shape(body)));
            simulator_->refine(
                more_elements_of(discretization(), shape(body).elements(), share, double(allowed()), most()), body);
        }
    }

    /// Whether there are films: the bodies are several, or between walls.
    bool has_films() const {
        using std::isfinite;
        return simulator_->bodies() > 1 ||
               isfinite(simulator_->scene().gap({S(0), simulator_->configuration().position}));
    }

    /// The error that films leave in a result, and how many elements each body needs for it to be allowed.
    struct FilmNeeds {
        double error = 0;
        std::vector<Index> elements;
        /// The narrowest gap that even the most elements do not resolve, and how many it has.
        std::optional<S> hopeless;
        Index hopeless_elements = 0;
    };
    /// `share(b)`: how much of the result depends on the force in the gap above a body.
    template <class Share>
    FilmNeeds film_needs(const Films<S>& films, const State& bodies, const double wanted, const Share& share) const {
        using std::isfinite;
        const FilmResolution resolution{spectral()};
        FilmNeeds needs;
        for (const auto& body : bodies) {
            needs.elements.push_back(body.shape.elements());
        }
        const auto ask = [&](std::size_t body, const S& now, const double nodes) {
            if (double(now) < nodes) {
                const Index more = elements_for_film(bodies[body].shape.elements(), double(now), nodes, most(body));
                needs.elements[body] = std::max(needs.elements[body], more);
            }
        };
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const FilmThickness<S>& film = films.bodies[b];
            if (isfinite(film.wall_nodes)) {
                const double error = resolution.wall(double(film.wall_nodes), double(film.wall_slenderness));
                needs.error = std::max(needs.error, error);
                if (error > wanted) {
                    ask(b, film.wall_nodes, resolution.nodes_for_wall(double(film.wall_slenderness), wanted));
                }
            }
        }
        for (std::size_t b = 0; b < films.gaps.size(); ++b) {
            const Gap<S>& gap = films.gaps[b];
            if (!(gap.slenderness > S(0))) {
                continue;
            }
            const auto thin = double(gap.slenderness);
            const double nodes = double(std::min(gap.lower_nodes, gap.upper_nodes));
            const double part = share(b);
            const double error = resolution.gap(nodes, thin, part);
            needs.error = std::max(needs.error, error);
            if (error <= wanted) {
                continue;
            }
            const double least =
                resolution.nodes_for_gap(thin, std::min(FilmResolution::unresolved, spectral() ? wanted / part : 1.0));
            ask(b, gap.lower_nodes, least);
            ask(b + 1, gap.upper_nodes, least);
            const Index lower = bodies[b].shape.elements();
            const Index upper = bodies[b + 1].shape.elements();
            const bool more = needs.elements[b] > lower || needs.elements[b + 1] > upper;
            if (resolution.gap(nodes, thin) > FilmResolution::unresolved && !more &&
                (!needs.hopeless || gap.width < *needs.hopeless)) {
                needs.hopeless = gap.width;
                needs.hopeless_elements = std::min(lower, upper);
            }
        }
        return needs;
    }

    /// How much of the result depends on the force in a gap: the velocities at which it closes and drains, relative to
    /// that of the bodies. Of bodies moved at given velocities the forces are the result.
    double gap_share(std::size_t lower) {
        using std::abs;
        if (!(simulator_->scene().velocity_scale() > S(0))) {
            return 1;
        }
        const auto& a = simulator_->instant(lower);
        const auto& b = simulator_->instant(lower + 1);
        S fastest = 0;
        for (std::size_t k = 0; k < simulator_->bodies(); ++k) {
            fastest = std::max<S>(fastest, abs(simulator_->instant(k).velocity));
        }
        const S closing = abs(a.velocity - b.velocity) + a.deformation_rate + b.deformation_rate;
        return std::min(1.0, double(closing / fastest));
    }

    double allowed_of_films() const {
        return params_.transient ? double(params_.eps) / 2 : double(allowed()) / Accuracy<S>::unresolved_to_error;
    }

    /// Of the present instant.
    FilmNeeds film_needs(const double wanted) {
        return film_needs(simulator_->films(), simulator_->state(), wanted,
                          [&](std::size_t b) { return gap_share(b); });
    }

    /// What films need and do not have.
    std::optional<FilmNeeds> unmet_needs() {
        if (!has_films()) {
            return std::nullopt;
        }
        FilmNeeds now = film_needs(allowed_of_films());
        for (std::size_t b = 0; b < now.elements.size(); ++b) {
            if (adapts() && now.elements[b] > shape(b).elements()) {
                return now;
            }
        }
        film_error_ = params_.transient ? std::max(film_error_, now.error) : now.error;
        return adapts() && now.hopeless ? std::optional(std::move(now)) : std::nullopt;
    }

    /// More elements where films need them. Throws SimulationFailure where the most are not enough.
    void resolve_films() {
        while (const auto now = unmet_needs()) {
            bool added = false;
            for (std::size_t b = 0; b < now->elements.size(); ++b) {
                if (now->elements[b] > shape(b).elements()) {
                    simulator_->refine(now->elements[b], b);
                    added = true;
                }
            }
            if (!added) {
                throw SimulationFailure("the distance to the next body, " + detail::text(*now->hopeless) +
                                        ", is less than " + std::to_string(now->hopeless_elements) +
                                        " elements can resolve");
            }
        }
    }

    S film_error() const {
        return film_error_ <= FilmResolution::unresolved ? S(film_error_) : std::numeric_limits<S>::infinity();
    }

    /// At least `first` steps, then until the residual is below `residual`, until `last` steps or the end of the run;
    /// with more elements as soon as a shape needs them, or if the simulation cannot go on with those it has.
    void march(const S& residual, Index first, Index last) {
        bool going = true;
        int rescues = 3;
        const auto observe = [&](const auto& record) {
            stopped_ = !observe_(*simulator_);
            const bool rests = record.step >= first && simulator_->residual() < residual && rest_ends();
            going = !rests && record.step < last && !simulator_->finished() && !stopped_;
            return going && !needy() && !unmet_needs();
        };
        while (going && !stopped_ && steps() < last && !simulator_->finished()) {
            try {
                resolve_films();
                simulator_->run(observe);
            } catch (const SimulationFailure&) {
                if (!adapts() || rescues-- == 0 || !rescue()) {
                    throw;
                }
                continue;
            }
            if (const auto body = needy(); body && !stopped_) {
                add_elements(*body);
                going = steps() < last;
            } else {
                going = going && !(simulator_->stationary() && rest_ends());
            }
            going = going || (!stopped_ && unmet_needs());
        }
        if (!stopped_) {
            resolve_films();
        }
    }

    /// Whether nothing is left to follow once the bodies have come to rest. To a given time they move on.
    bool rest_ends() const {
        const bool lone_shape = simulator_->bodies() == 1 && simulator_->scene().deforms(0);
        return !params_.transient || lone_shape || !(simulator_->params().longest_time < std::numeric_limits<S>::max());
    }

    /// Goes on with half as many elements again, if there are any to add: a shape that cannot move on may not be
    /// carried by those it has.
    bool rescue() {
        bool added = false;
        if constexpr (deformable) {
            for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                const Index now = shape(b).elements();
                const Index next = std::min(most(), now + now / 2);
                if (!simulator_->scene().deforms(b) || next <= now) {
                    continue;
                }
                added = true;
                if (steps() == 0) {
                    restart(next);
                    break;
                }
                simulator_->refine(next, b);
            }
        }
        return added;
    }

    void march_on() { march(simulator_->params().tolerance, 0, simulator_->params().most_steps); }

    void march_to_the_end() {
        resolve_rigid();
        march_on();
        if (spectral()) {
            estimate_from_modes();
        } else if (adapts()) {
            refine_until_met();
        } else {
            estimate_from_coarser();
        }
        take();
        if (result_.power_mismatch > S(TheReferee::largest_mismatch)) {
            result_.error_estimate = std::numeric_limits<S>::infinity();
            result_.refinement_failure = "the elements do not carry the last shape: its power mismatch is " +
                                         detail::text(result_.power_mismatch);
        }
    }

    std::size_t rigid_bodies() const {
        std::size_t count = 0;
        for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
            count += simulator_->scene().deforms(b) ? 0 : 1;
        }
        return count;
    }
    bool any_rigid() const { return rigid_bodies() > 0; }
    bool all_rigid() const { return rigid_bodies() == simulator_->bodies(); }

    /// Of rigid bodies the first instant tells how many elements their tractions need; gaps may need more later.
    void resolve_rigid() {
        while (spectral() && adapts() && all_rigid() && elements() < 2 * most() &&
               !(finer_difference() <= params_.eps)) {
            restart(std::min(2 * most(), elements() + elements() / 2));
        }
    }

    /// From the velocities, or forces, that a quarter more elements give rigid bodies at the present instant.
    S finer_difference() {
        auto state = simulator_->state();
        for (auto& body : state) {
            const Index n = body.shape.elements();
            body = simulator_->scene().redistributed(body, n + std::max<Index>(4, n / 4));
        }
        try {
            auto scene = simulator_->scene();
            const S difference = rigid_difference(velocity_and_force(simulator_->moment().instants),
                                                  velocity_and_force(scene.evaluate(state, S(0))));
            const S ratio = S(state.front().shape.elements()) / S(elements());
            return spectral() ? difference : second_order(difference, ratio * ratio / (ratio * ratio - S(1)));
        } catch (const SimulationFailure&) {
            return std::numeric_limits<S>::infinity();
        }
    }

    S error_of_rigid() { return any_rigid() ? finer_difference() : S(0); }

    /// Velocity and force of a rigid body. Its shape may be simple and its traction is not: two results tell the error
    /// of the coarser one, or, of second order, that of the finer.
    void solve_rigid() {
        const Index most_of_rigid = 2 * most();
        auto now = velocity_and_force(simulator_->moment().instants);
        if (!adapts() && spectral() && (2 * elements()) / 3 < minimum_elements) {
            // There are too few to compare with fewer.
            Simulator fine = make_(2 * elements());
            judge_rigid(now, velocity_and_force(fine.moment().instants), elements());
        } else if (!adapts()) {
            Simulator coarse = make_(std::max(minimum_elements, (2 * elements()) / 3));
            judge_rigid(velocity_and_force(coarse.moment().instants), now, coarse.configuration().shape.elements());
        }
        while (adapts() && !(result_.error_estimate <= params_.eps) && elements() < most_of_rigid && !stopped_) {
            const Index before = elements();
            const double error = std::min(1.0, double(result_.error_estimate));
            restart(spectral() ? std::min(most_of_rigid, before + before / 2)
                               : more_elements(before, error, double(params_.eps), most_of_rigid));
            const auto finer = velocity_and_force(simulator_->moment().instants);
            judge_rigid(now, finer, before);
            now = finer;
        }
        take();
        const S error = std::exchange(result_.error_estimate, std::numeric_limits<S>::infinity());
        require_true(result_.bodies, result_.instants);
        result_.error_estimate = error;
        // Stationary at once, if they move alike.
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        result_.residual = (now.first.array() - now.first[0]).abs().maxCoeff() / scale;
        result_.stationary = *result_.residual < simulator_->params().tolerance;
    }

    /// Throws SimulationFailure if the numbers cannot be true; else what they are out by.
    S require_true(const State& bodies, const typename Simulator::SceneType::Instants& instants) const {
        if (!simulator_->params().referee) {
            return S(0);
        }
        const auto verdict = TheReferee(simulator_->scene()).judge(bodies, instants);
        if (!verdict.fault.empty()) {
            throw SimulationFailure(verdict.fault);
        }
        return verdict.power_mismatch;
    }

    /// Two results may agree by chance, for instance where a gap is hardly resolved.
    void judge_rigid(const std::pair<Vector<S>, Vector<S>>& coarse, const std::pair<Vector<S>, Vector<S>>& fine,
                     Index coarse_elements) {
        result_.error_estimate = rigid_error(coarse, fine, coarse_elements) + params_.integrals / 10;
        if constexpr (can_judge) {
            // Or before either of them carries the shape.
            result_.error_estimate = std::max(result_.error_estimate, unresolved_error(simulator_->state()));
        }
        if (has_films()) {
            film_error_ = film_needs(double(params_.eps)).error;
            result_.error_estimate = std::max(result_.error_estimate, film_error());
        }
    }

    /// Of all bodies.
    template <class Instants>
    static std::pair<Vector<S>, Vector<S>> velocity_and_force(const Instants& instants) {
        const auto count = static_cast<Index>(instants.size());
        std::pair<Vector<S>, Vector<S>> result{Vector<S>(count), Vector<S>(count)};
        for (Index b = 0; b < count; ++b) {
            const auto& instant = instants[static_cast<std::size_t>(b)];
            result.first[b] = instant.velocity;
            result.second[b] = instant.surface.weight.dot(instant.solution.force.tail(instant.surface.size()));
        }
        return result;
    }

    /// Of velocities; of forces, where nothing drives bodies of given velocities.
    S rigid_difference(const std::pair<Vector<S>, Vector<S>>& coarse,
                       const std::pair<Vector<S>, Vector<S>>& fine) const {
        const bool driven = simulator_->scene().velocity_scale() > S(0);
        const Vector<S>& a = driven ? coarse.first : coarse.second;
        const Vector<S>& b = driven ? fine.first : fine.second;
        return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
    }

    /// Of P1 elements: what second order makes of a difference, by the factor given, and no less than what the chords
    /// of a sphere leave, 4e-3 (pi/N)^2: errors of other signs may hide that.
    S second_order(const S& difference, const S& factor) const {
        const S spacing = detail::pi_value<S>() / S(elements());
        return std::max<S>(difference * factor, S(5e-3) * spacing * spacing);
    }

    S rigid_error(const std::pair<Vector<S>, Vector<S>>& coarse, const std::pair<Vector<S>, Vector<S>>& fine,
                  Index coarse_elements) const {
        const S difference = rigid_difference(coarse, fine);
        const S ratio = S(elements()) / S(coarse_elements);
        return spectral() ? difference : second_order(difference, 1 / (ratio * ratio - S(1)));
    }

    /// Of all bodies.
    std::vector<MeasuredState> measured(const Simulator& simulator) const {
        std::vector<MeasuredState> states;
        for (std::size_t b = 0; b < simulator.bodies(); ++b) {
            const auto& history = simulator.history(b);
            states.push_back(measured(simulator.configuration(b), history.empty() ? S(0) : history.back().velocity));
        }
        return states;
    }
    template <class Found>
    std::vector<MeasuredState> measured(const Found& state) const {
        std::vector<MeasuredState> states;
        for (std::size_t b = 0; b < state.bodies.size(); ++b) {
            states.push_back(measured(state.bodies[b], state.instants[b].velocity));
        }
        return states;
    }
    MeasuredState measured(const Configuration<S>& body, const S& velocity) const {
        return {measured_velocity(velocity), length(body), body.shape.elements()};
    }
    MeasuredState measured(const typename Simulator::Record& record) const {
        return {measured_velocity(record.velocity), double(record.length), 0};
    }
    /// Nothing drives a body at rest: its velocity is no result.
    double measured_velocity(const S& velocity) const {
        return simulator_->scene().velocity_scale() > S(0) ? double(velocity) : 0.0;
    }
    static double largest_error(const std::vector<MeasuredState>& coarse, const std::vector<MeasuredState>& fine) {
        double error = 0;
        for (std::size_t b = 0; b < fine.size(); ++b) {
            error = std::max(error, second_order_error(coarse[b], fine[b]));
        }
        return error;
    }
    static double length(const Configuration<S>& c) {
        return static_cast<double>(c.shape.z[c.shape.nodes() - 1] - c.shape.z[0]);
    }

    void estimate_from_modes() {
        if constexpr (can_judge) {
            const State state = simulator_->state();
            result_.error_estimate = unresolved_error(state) + time_error() + other_errors(state);
            try {
                result_.error_estimate += resultant_error(state, simulator_->moment().instants);
            } catch (const SimulationFailure&) {
                result_.error_estimate = std::numeric_limits<S>::infinity();
            }
            result_.error_estimate += error_of_rigid();
        }
    }

    /// Of the steps to a given time. Where they estimate their error a lone deformable body keeps to the accuracy; of
    /// others the sum of these is an error of their places, on which velocities depend. On the way to a stationary
    /// state: what is left of it.
    S time_error() const {
        S largest = 0;
        for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
            const auto& history = simulator_->history(b);
            if (history.empty()) {
                continue;
            }
            if (!params_.transient) {
                largest = std::max<S>(largest, settling_error(history));
                continue;
            }
            const bool lone_shape = simulator_->bodies() == 1 && simulator_->scene().deforms(0);
            if (!(history.back().step_error > S(0))) {
                largest = std::max<S>(largest, first_order_error(b));
            } else if (!lone_shape) {
                largest = std::max<S>(largest, place_error(b));
            }
        }
        return largest;
    }

    /// The rest of a geometric sequence of which the last ten steps are a part. Infinite if there is no end to it.
    S settling_error(const std::vector<typename Simulator::Record>& history) const {
        if (!simulator_->stationary()) {
            return std::numeric_limits<S>::infinity();
        }
        const std::size_t size = history.size();
        const std::size_t back = std::min<std::size_t>(size - 1, 10);
        const auto around = [&](std::size_t last) {
            // Residuals oscillate: the largest of four.
            double largest = 0;
            for (std::size_t k = 0; k < 4 && k <= last; ++k) {
                largest = std::max(largest, double(history[last - k].residual));
            }
            return largest;
        };
        const double late = around(size - 1);
        const double early = around(size - 1 - back);
        double change = 0;
        for (std::size_t k = 1; k <= back; ++k) {
            change = std::max(change, relative_difference(measured(history[size - 1 - k]), measured(history.back())));
        }
        if (change == 0) {
            return S(0);
        }
        return late < early ? S(change * late / (early - late)) : std::numeric_limits<S>::infinity();
    }

    /// The sum of dt/2 times the change of the velocities, relative to the length.
    S first_order_error(std::size_t body) const {
        using std::abs;
        const auto& history = simulator_->history(body);
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        S sum = 0;
        for (std::size_t i = 1; i < history.size(); ++i) {
            sum += history[i].dt / 2 *
                   (scale * abs(history[i].residual - history[i - 1].residual) +
                    abs(history[i].velocity - history[i - 1].velocity));
        }
        return sum / S(length(simulator_->configuration(body)));
    }

    /// The sum of the errors of all steps times the most that the velocity has changed by while bodies moved relative
    /// to each other, or deformed, by as much.
    S place_error(std::size_t body) const {
        using std::abs;
        const auto& history = simulator_->history(body);
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        S sum = history.front().step_error;
        S slope = 0;
        S before = scale * simulator_->history(0).front().residual;
        for (std::size_t i = 1; i < history.size(); ++i) {
            S rate = 0;
            for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                rate = std::max<S>(rate, scale * simulator_->history(b)[i].residual);
            }
            const bool lone = simulator_->bodies() == 1;
            const S moved =
                lone ? S(abs(history[i].position - history[i - 1].position)) : S(history[i].dt * (rate + before) / 2);
            if (moved > S(1e-6 * length(simulator_->configuration(body)))) {
                slope = std::max<S>(slope, abs(history[i].velocity - history[i - 1].velocity) / moved);
            }
            sum += history[i].step_error;
            before = rate;
        }
        return sum * slope / std::max(S(abs(history.back().velocity)), S(1e-3));
    }

    /// P1: from the difference to a run with three quarters of the elements; half of them may not be in the range of
    /// second order.
    void estimate_from_coarser() {
        const auto fine = measured(*simulator_);
        const Index fewer = std::max(minimum_elements, (3 * elements()) / 4);
        if (fewer == elements() || stopped_) {
            return;
        }
        try {
            Simulator coarse = make_(fewer);
            const auto observe = [&](const auto&) {
                stopped_ = !observe_(*simulator_);
                return !coarse.finished() && !stopped_;
            };
            const auto left = [&] { return coarse.params().most_steps - static_cast<Index>(coarse.history().size()); };
            do {
                coarse.run(observe);
            } while (!coarse.finished() && !stopped_ && left() > 0 && !rest_ends());
            if (!stopped_) {
                result_.error_estimate = S(largest_error(measured(coarse), fine)) + time_error() +
                                         other_errors(simulator_->state()) + error_of_rigid();
            }
        } catch (const SimulationFailure&) {
            // Without a coarser result there is no telling.
        }
    }

    /// P1: more and more elements until two results agree.
    void refine_until_met() {
        auto coarse = measured(*simulator_);
        double error = 1;  // unknown
        while (!stopped_) {
            const Index next = more_elements(elements(), error, double(params_.eps), most(0));
            if (params_.transient || !deformable) {
                restart(next);
            } else {
                for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
                    simulator_->refine(next, b);
                }
            }
            film_error_ = 0;
            march_on();
            const auto fine = measured(*simulator_);
            error = largest_error(coarse, fine);
            coarse = fine;
            result_.error_estimate = S(error) + time_error() + other_errors(simulator_->state()) + error_of_rigid();
            if (error <= double(params_.eps) || elements() >= most(0)) {
                break;
            }
        }
    }

    /// Of the simulator's last step, its last good one if it failed.
    void take() {
        result_.bodies = simulator_->state();
        result_.instants.clear();
        try {
            result_.instants = simulator_->moment().instants;
            result_.velocity = result_.instants.front().velocity;
        } catch (const SimulationFailure&) {
            // Reported already: the run cannot have ended well on such a shape.
        } catch (const SimulationStopped&) {
            // Neither does it go on with this.
        }
        result_.stationary = simulator_->stationary();
        result_.largest_power_mismatch = 0;
        for (const auto& record : simulator_->history()) {
            result_.power_mismatch = record.power_mismatch;
            result_.largest_power_mismatch = std::max<S>(result_.largest_power_mismatch, record.power_mismatch);
        }
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
        if (fills_tube()) {
            march(simulator_->params().tolerance, 1, std::min<Index>(steps() + 1, simulator_->params().most_steps));
            if (stopped_ || converged(true, film_elements(simulator_->configuration()))) {
                return;
            }
        }
        const bool eager = params_.way == WayToStationary::newton;
        const int attempts = simulator_->bodies() > 1 ? 3 : 5;
        constexpr Index least = 20;
        const Index patience = eager ? 40 : 150;
        S handover = eager ? S(3e-2) : S(2e-3);
        for (int attempt = 0; attempt < attempts && !stopped_; ++attempt) {
            const S target = std::max(handover, simulator_->params().tolerance);
            march(target, least, std::min<Index>(steps() + patience, simulator_->params().most_steps));
            const bool arrived = simulator_->residual() < target;
            if (arrived && !eager && settles()) {
                march(std::max(near(), simulator_->params().tolerance), 0,
                      std::min<Index>(steps() + patience / 2, simulator_->params().most_steps));
            }
            if (stopped_) {
                break;
            }
            if (!arrived && !eager && simulator_->bodies() > 1) {
                break;  // bodies on their way to each other
            }
            if (converged(eager || !arrived || attempt + 1 == attempts)) {
                return;
            }
            handover = std::min(handover, simulator_->residual()) / 5;
        }
        if (eager && simulator_->bodies() > 1) {
            // Bodies that push each other apart never arrive by themselves.
            take();
            result_.stationary = false;
            return;
        }
        march_to_the_end();
    }

    /// Of a lone vesicle, longer than wide, with a thin film around it: it has hardly another shape to go to, and a
    /// march through the film is slow.
    bool fills_tube() const {
        if constexpr (Simulator::SceneType::confined) {
            const Configuration<S>& body = simulator_->configuration();
            return simulator_->bodies() == 1 && detail::keeps_area(simulator_->scene().law(0)) && spectral() &&
                   length(body) > 2 * body.shape.r.maxCoeff() &&
                   simulator_->scene().film_thickness(body).min < S(0.1) * body.shape.r.maxCoeff();
        } else {
            return false;
        }
    }

    /// Elements that carry the forces along a body's film.
    Index film_elements(const Configuration<S>& body) const {
        if constexpr (Simulator::SceneType::confined) {
            const S film = simulator_->scene().film_thickness(body).min;
            return static_cast<Index>(detail::length_in_film(body.shape, film) / S(0.4));
        } else {
            return 0;
        }
    }

    /// Whether the elements carry the waves of the films, for growth rates.
    bool films_resolved(const State& bodies) const {
        const double needed = spectral() ? 0.9 : 2;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (simulator_->scene().deforms(b) &&
                double(bodies[b].shape.elements()) < needed * double(film_elements(bodies[b]))) {
                return false;
            }
        }
        return true;
    }

    /// A residual from which Newton's method takes a few evaluations, without coarser solutions first.
    static S near() { return S(1e-5); }

    /// Whether marching on to there is cheap: it gains a factor of 3 in ten steps.
    bool settles() const {
        S before = 0;
        for (std::size_t b = 0; b < simulator_->bodies(); ++b) {
            const auto& history = simulator_->history(b);
            before = std::max<S>(before, history.size() > 10 ? history[history.size() - 11].residual : S(0));
        }
        return simulator_->residual() < before / 3;
    }

    bool converged(bool anywhere, Index least = 0) {
        const Result before = result_;
        try {
            converge(anywhere, least);
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
    void converge(bool anywhere, Index least) {
        if constexpr (deformable && !std::is_void_v<Solver>) {
            typename Solver::Params solver_params;
            solver_params.tolerance = params_.newton_tolerance;
            solver_params.to_round_off = params_.to_round_off;
            solver_params.coarse_start = !(simulator_->residual() <= 2 * near());
            solver_params.proceed = [this] {
                stopped_ = stopped_ || !observe_(*simulator_);
                return !stopped_;
            };
            Solver solver(simulator_->scene(), solver_params);
            State start = centred();
            if (adapts() && least > elements()) {
                start.front() = simulator_->scene().redistributed(start.front(), std::min(least, most()));
            }
            const bool several = start.size() > 1;
            std::vector<Measures<S>> measures;
            for (std::size_t b = 0; b < start.size(); ++b) {
                measures.push_back(initial_measures(b));
            }
            auto state = solver.solve(start, measures);
            // From a coarser solution few iterations lead to the finer one, or none do.
            solver_params.most_iterations = several ? 20 : solver_params.most_iterations;
            Solver refining(simulator_->scene(), solver_params);
            if (!anywhere && far(state.bodies, start)) {
                throw SimulationFailure("stationary state: the solution is not near the shape marched to");
            }
            result_.newton_iterations = state.iterations;
            result_.newton_evaluations = state.evaluations;
            slowest_.reset();
            bool examined = false;
            S error = std::numeric_limits<S>::infinity();
            if (!spectral()) {
                error = coarse_difference(solver, state, measures);
            }
            for (;;) {
                if constexpr (can_judge) {
                    error = spectral() ? unresolved_error(state.bodies) : error;
                }
                const FilmNeeds needs = film_needs(simulator_->scene().films(state.bodies), state.bodies,
                                                   double(params_.eps) / 2, [](std::size_t) { return 1.0; });
                film_error_ = needs.error;
                error += other_errors(state.bodies) + resultant_error(state.bodies, state.instants);
                adopt(state, error);
                const bool last = error <= params_.eps || !adapts() || stopped_ || nothing_to_add(state.bodies);
                // Growth rates need no more than a recognisable shape, and cost as much as many iterations. Those of
                // distances need the most accurate state there is.
                if (!examined &&
                    (last || (!several && (!spectral() || error < S(1e-3)) && films_resolved(state.bodies)))) {
                    examine(solver, state, measures, error);
                    examined = true;
                }
                if (last) {
                    settle<Solver>(state, measures, solver_params, error);
                    return;
                }
                try {
                    auto finer = refining.solve(refined(state.bodies, needs, error), measures);
                    result_.newton_iterations += finer.iterations;
                    result_.newton_evaluations += finer.evaluations;
                    if constexpr (can_judge) {
                        if (spectral() && unresolved_error(finer.bodies) > std::max(params_.eps, S(error / 10))) {
                            // Nodes placed on a coarser curve remember its errors.
                            finer = refining.solve(evened(finer.bodies), measures);
                            result_.newton_iterations += finer.iterations;
                            result_.newton_evaluations += finer.evaluations;
                        }
                    }
                    require_true(finer.bodies, finer.instants);
                    if (!spectral()) {
                        error = S(largest_error(measured(state), measured(finer)));
                    }
                    state = std::move(finer);
                } catch (const SimulationFailure& failure) {
                    result_.refinement_failure = failure.what();
                    if (!examined) {
                        examine(solver, state, measures, error);
                    }
                    settle<Solver>(state, measures, solver_params, error);
                    return;
                }
            }
        }
    }

    /// What the residual leaves of the slowest disturbance of a body that is alone, over its length.
    template <class Found>
    S residual_error(const Found& state) const {
        using std::abs;
        if (!slowest_ || state.bodies.size() > 1) {
            return S(0);
        }
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        return state.residual * scale / (abs(*slowest_) * S(length(state.bodies.front())));
    }

    /// Goes on for as long as the accuracy takes, now that the slowest disturbance is known.
    template <class Newton, class Found>
    void settle(const Found& state, const std::vector<Measures<S>>& measures, typename Newton::Params params,
                const S& error) {
        S rest = residual_error(state);
        if (rest > params_.eps / 2) {
            params.tolerance =
                std::max<S>(state.residual * params_.eps / (4 * rest), S(64 * std::numeric_limits<S>::epsilon()));
            try {
                auto closer = Newton(simulator_->scene(), params).solve(state.bodies, measures);
                result_.newton_iterations += closer.iterations;
                result_.newton_evaluations += closer.evaluations;
                adopt(closer, error);
                rest = residual_error(closer);
            } catch (const SimulationFailure& failure) {
                result_.refinement_failure = failure.what();
            }
        }
        result_.error_estimate = error + rest;
    }

    /// Of Newton's method: the Jacobian of several bodies costs more.
    Index most_in_newton() const { return simulator_->bodies() > 1 ? std::min<Index>(most(), 96) : most(); }

    /// The simulator's bodies, in the middle of the axis: a meshed wall is about there.
    State centred() const {
        State bodies = simulator_->state();
        const S middle = (bodies.front().position + bodies.back().position) / 2;
        for (auto& body : bodies) {
            body.position -= middle;
        }
        return bodies;
    }

    /// Whether a body has another shape, or place among the others.
    static bool far(const State& a, const State& b) {
        using std::abs;
        const S most = S(0.05);
        for (std::size_t k = 0; k < a.size(); ++k) {
            const S moved = (a[k].position - a[0].position) - (b[k].position - b[0].position);
            if (abs(moved) > most || distance(a[k].shape, b[k].shape) > most) {
                return true;
            }
        }
        return false;
    }

    /// From the share of the last modes, the largest of all bodies.
    S unresolved_error(const State& bodies) const {
        S share = 0;
        for (const auto& body : bodies) {
            share = std::max<S>(share, discretization().unresolved(body.shape));
        }
        return share / S(Accuracy<S>::unresolved_to_error);
    }

    /// Those that the resolution of the shape does not show.
    S other_errors(const State& bodies) const { return film_error() + area_error(bodies) + params_.integrals / 10; }

    /// A membrane's own forces have no resultant. That of the discrete ones moves the body like a weight: as fast as a
    /// sphere of its volume in an unbounded fluid, at most.
    template <class Instants>
    S resultant_error(const State& bodies, const Instants& instants) const {
        using std::abs;
        using std::cbrt;
        const S pi = detail::pi_value<S>();
        S error = 0;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const auto& instant = instants[b];
            if (!simulator_->scene().deforms(b) || !(simulator_->scene().velocity_scale() > S(0))) {
                continue;
            }
            Vector<S> force = instant.solution.elastic;
            if (instant.solution.tension.size() > 0) {
                force += detail::applied(instant.surface.tension_force, instant.solution.tension);
            }
            const S resultant = instant.surface.weight.dot(force.tail(instant.surface.size()));
            const S radius = cbrt(3 * initial_measures(b).volume / (4 * pi));
            const S drift = abs(resultant) / (6 * pi * radius);
            error = std::max<S>(
                error, drift / std::max(S(abs(instant.velocity)), S(simulator_->scene().velocity_scale() / 1000)));
        }
        return error;
    }

    /// With the excess area D a nearly spherical body is as long as the sphere but for a share e that grows like
    /// sqrt(D), so that an error dD of the area changes the length by e (sqrt(1 + dD/D) - 1). dD is taken from a sphere
    /// of as many elements, whose excess area is zero; its area and volume have errors of their own.
    S area_error(const State& bodies) const {
        using std::abs;
        using std::cbrt;
        using std::sqrt;
        const S pi = detail::pi_value<S>();
        const auto excess = [&](const S& area, const S& volume) { return area - cbrt(36 * pi * volume * volume); };
        S error = 0;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const Measures<S> whole = initial_measures(b);
            const S wanted = excess(whole.area, whole.volume);
            if (!simulator_->scene().deforms(b) || !detail::keeps_area(simulator_->scene().law(b)) ||
                !(wanted > S(0))) {
                continue;
            }
            const S diameter = cbrt(6 * whole.volume / pi);
            const S deviation = abs(S(length(bodies[b])) / diameter - S(1));
            const auto of_sphere = discretization().measures(sphere<S>(bodies[b].shape.elements(), diameter / 2));
            error = std::max<S>(
                {error, deviation * (sqrt(1 + abs(excess(of_sphere.area, of_sphere.volume)) / wanted) - 1),
                 abs(of_sphere.area / (pi * diameter * diameter) - 1), abs(of_sphere.volume / whole.volume - 1)});
        }
        return error;
    }

    bool nothing_to_add(const State& bodies) const {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (simulator_->scene().deforms(b) && bodies[b].shape.elements() < most_in_newton()) {
                return false;
            }
        }
        return true;
    }

    /// With more elements where they are missing.
    State refined(State bodies, const FilmNeeds& needs, const S& error) const {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const Index now = bodies[b].shape.elements();
            Index next = needs.elements[b];
            if (!simulator_->scene().deforms(b)) {
                next = std::max(now, next);
            } else if (!spectral()) {
                next = more_elements(now, double(error), double(params_.eps), most());
            } else if constexpr (can_judge) {
                const auto share = double(std::max<S>(discretization().unresolved(bodies[b].shape),
                                                      S(Accuracy<S>::unresolved_to_error) * error));
                if (bodies.size() == 1 || share > double(params_.unresolved)) {
                    next = std::max(next,
                                    more_elements_of(discretization(), now, share, double(params_.unresolved), most()));
                }
            }
            next = std::min(next, std::max(now, most_in_newton()));
            if (next > now) {
                bodies[b] = simulator_->scene().redistributed(bodies[b], next);
            }
        }
        return bodies;
    }

    /// The same numbers of elements, spaced anew.
    State evened(State bodies) const {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (simulator_->scene().deforms(b)) {
                bodies[b] = simulator_->scene().redistributed(bodies[b], bodies[b].shape.elements());
            }
        }
        return bodies;
    }

    /// P1: against three quarters of the elements. The error depends on where they are: in the same places.
    template <class Newton, class Found>
    S coarse_difference(Newton& solver, const Found& fine, const std::vector<Measures<S>>& measures) {
        State fewer = fine.bodies;
        for (auto& body : fewer) {
            body.shape = detail::resampled(body.shape, std::max(minimum_elements, (3 * body.shape.elements()) / 4));
            body.tension.resize(0);
        }
        try {
            return S(largest_error(measured(solver.solve(fewer, measures)), measured(fine)));
        } catch (const SimulationFailure&) {
            return std::numeric_limits<S>::infinity();
        }
    }

    /// Of a coarser state near this one if there are many modes: growth rates need no accuracy, and one evaluation or
    /// two a mode. An unstable state is no end of a march.
    template <class Newton, class Found>
    void examine(Newton& solver, const Found& given, const std::vector<Measures<S>>& measures, const S& error) {
        using std::abs;
        const bool several = given.bodies.size() > 1;
        if (several && !(error < std::numeric_limits<S>::infinity())) {
            throw SimulationFailure("stationary state: the films between the bodies are not resolved");
        }
        Found state = given;
        Index elements = 0;
        bool fewer = false;
        for (std::size_t b = 0; b < state.bodies.size(); ++b) {
            auto& body = state.bodies[b];
            // Round-off grows like the fourth power of the elements.
            const Index enough = std::max<Index>(64, film_elements(body));
            if (spectral() && simulator_->scene().deforms(b) && body.shape.elements() > enough) {
                body = simulator_->scene().redistributed(body, enough);
                fewer = true;
            }
            elements = std::max(elements, body.shape.elements());
        }
        if (fewer) {
            try {
                state = solver.solve(state.bodies, measures);
            } catch (const SimulationFailure&) {
                return;  // without them
            }
        }
        const S rate = solver.growth_rates(state).front().real();
        slowest_ = rate;
        if (films_resolved(state.bodies)) {
            result_.growth_rate = rate;
            result_.stability_elements = elements;
        }
        // The error of a distance is that of the velocities over the rate at which they change with it.
        const S scale = std::max(S(1), simulator_->scene().velocity_scale());
        const S velocity_error = error * abs(given.instants.front().velocity) + params_.newton_tolerance * scale;
        if (several && abs(rate) < 5 * velocity_error) {
            throw SimulationFailure("stationary state: it does not tell the bodies' distances, for the growth rate " +
                                    detail::text(rate) + " is not large against the velocities' errors of " +
                                    detail::text(velocity_error) + "; bodies closer, or a finer accuracy, may");
        }
        if (params_.way == WayToStationary::automatic && rate > S(0)) {
            throw SimulationFailure("stationary state: it is unstable, with a growth rate of " + detail::text(rate));
        }
    }

    template <class Found>
    void adopt(const Found& state, const S& error) {
        result_.power_mismatch = require_true(state.bodies, state.instants);
        result_.bodies = state.bodies;
        const S along = simulator_->configuration().position - state.bodies.front().position;
        for (auto& body : result_.bodies) {
            body.position += along;
        }
        result_.instants = state.instants;
        result_.velocity = state.instants.front().velocity;
        result_.residual = state.residual;
        result_.stationary = true;
        result_.error_estimate = error;
    }

    Make make_;
    Params params_;
    Observer observe_;
    std::optional<Simulator> simulator_;
    Result result_;
    std::optional<S> slowest_;  // growth rate, resolved or not
    double film_error_ = 0;     // of the last step; if the way matters, the largest of all
    bool stopped_ = false;
};

}  // namespace axistokes
