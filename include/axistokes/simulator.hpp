// SPDX-License-Identifier: MIT
// A simulation assembled at compile time from its policies; see concepts.hpp for what each must offer.
#pragma once

#include "geometry/conserved.hpp"
#include "referee.hpp"
#include "scene.hpp"
#include "step_control.hpp"
#include "step_record.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axistokes {

/// TimeIntegratorFor<Scene>: `step(scene, start, dt)` takes a Scene::Moment and returns the displaced `bodies`, each
/// meridian relative to the moved centroid, with their tensions. The result may have a member `error`, an estimate of
/// the step's error in R0: the automatic step then follows it, unless the integrator has a member `estimates_error()`
/// that says it is none.
template <class T, class SceneType>
concept TimeIntegratorFor = requires(const T& integrator, SceneType& scene, const typename SceneType::Moment& start,
                                     typename SceneType::Scalar dt) {
    { integrator.order } -> std::convertible_to<int>;
    { integrator.step(scene, start, dt).bodies } -> std::convertible_to<typename SceneType::State>;
};

/// Step control and stationarity of a Simulator.
template <class S>
struct SimulationParams : StepControlParams<S> {
    /// Stationary: residual below this, in [8 eps, 1). Velocity scale: the larger of 1 and the background's.
    S tolerance = S(1e-5);
    Index most_steps = 20000;
    /// The last step of the automatic ones ends there.
    S longest_time = std::numeric_limits<S>::max();
    /// Automatic steps end at each of these times too.
    std::vector<S> landing_times{};
    /// Whether each step's numbers are judged (Referee): one that cannot be true is a failure.
    bool referee = true;
    /// Of the scene (Scene::proceed_while): false ends a step, leaving the state as it was, with SimulationStopped.
    std::function<bool()> proceed{};
};

namespace detail {

template <class S>
void validate(const SimulationParams<S>& p) {
    const S least = 8 * std::numeric_limits<S>::epsilon();
    require(p.tolerance >= least && p.tolerance < S(1), "stationarity tolerance", p.tolerance, "in [8 eps, 1)");
    require(p.most_steps >= 1, "number of steps", p.most_steps, "at least 1");
    require(p.longest_time > S(0), "longest time", p.longest_time, "> 0");
    for (const S& time : p.landing_times) {
        require(time >= S(0) && time < std::numeric_limits<S>::infinity(), "landing time", time, ">= 0 and finite");
    }
}

}  // namespace detail

/// Bodies in a flow, from their initial shapes to any later time or to a stationary state.
///
/// Failures (a singular system, a self-intersection, a step below the smallest) throw SimulationFailure with the cause;
/// the configurations and the histories then are those of the last good step.
template <GreenKernel Kernel, DiscretizationFor<Kernel> Discretization, class Law, Background Flow, class Integrator,
          LinearSolver Solver, WallFor<Kernel, Discretization> Wall = NoWall,
          StepControlFor<typename Kernel::Scalar> Control = StepControl<typename Kernel::Scalar>>
requires UsesScalarOf<Law, Kernel> && UsesScalarOf<Flow, Kernel> && UsesScalarOf<Solver, Kernel> &&
    LawsFor<Law, typename Discretization::Surface> && CarriesAlong<Discretization, Law> &&
    TimeIntegratorFor<Integrator, Scene<Kernel, Discretization, Law, Flow, Solver, Wall>>
class Simulator {
  public:
    using Scalar = typename Kernel::Scalar;
    using SceneType = Scene<Kernel, Discretization, Law, Flow, Solver, Wall>;
    using InstantType = typename SceneType::InstantType;
    using Moment = typename SceneType::Moment;
    using State = typename SceneType::State;
    using Record = StepRecord<Scalar>;
    using Params = SimulationParams<Scalar>;

    /// `shapes` are in the laboratory frame, in the order in which they lie along the axis. Throws InvalidArgument when
    /// a shape is not a valid meridian, does not fit between the walls, or meets another one, or a parameter is out of
    /// range.
    Simulator(SceneType scene, Integrator integrator, const std::vector<Meridian<Scalar>>& shapes, Params params = {})
        : params_(completed(std::move(params), scene)),
          scene_(std::move(scene)),
          integrator_(std::move(integrator)),
          control_(params_) {
        detail::validate(params_);
        if (params_.proceed) {
            scene_.proceed_while(params_.proceed);
        }
        detail::require(!shapes.empty(), "number of bodies", shapes.size(), "at least 1");
        detail::require(scene_.laws().size() == 1 || scene_.laws().size() == shapes.size(), "number of laws",
                        scene_.laws().size(), "1, or that of the bodies");
        State state;
        for (std::size_t b = 0; b < shapes.size(); ++b) {
            validate(shapes[b]);
            const Measures<Scalar> measures = scene_.discretization().measures(shapes[b]);
            state.push_back({detail::shifted(shapes[b], Scalar(-measures.centroid)), measures.centroid, {}});
            measures_.push_back(measures);
            conserved_.emplace_back(measures, detail::keeps_area(scene_.law(b)));
            if (detail::is_carrying(scene_.law(b))) {
                state.back().reference = state.back().shape;
            }
        }
        histories_.resize(shapes.size());
        films_ = scene_.films(state);
        for (std::size_t b = 0; b < shapes.size(); ++b) {
            const Scalar& film = films_.bodies[b].min;
            detail::require(film > Scalar(0), "initial shape: its distance to the wall", film,
                            "> 0, that is the shape must fit between the walls");
            if (b > 0) {
                const Scalar below = state[b - 1].position + state[b - 1].shape.z[state[b - 1].shape.elements()];
                const Scalar apart = state[b].position + state[b].shape.z[0] - below;
                detail::require(state[b].position > state[b - 1].position &&
                                    films_.bodies[b].to_neighbour > 32 * std::numeric_limits<Scalar>::epsilon() &&
                                    !detail::meet(state[b - 1], state[b]),
                                "initial shapes: distance of a body to the one before it", apart,
                                "such that they do not meet, in the order in which they lie along the axis");
            }
        }
        moment_.bodies = std::move(state);
    }
    Simulator(SceneType scene, Integrator integrator, const Meridian<Scalar>& shape, Params params = {})
        : Simulator(std::move(scene), std::move(integrator), std::vector<Meridian<Scalar>>{shape}, std::move(params)) {}

    /// One body, and the policies that have no defaults first.
    explicit Simulator(const Meridian<Scalar>& shape, Flow flow, Params params = {}, Kernel kernel = Kernel{},
                       Discretization discretization = Discretization{}, Law law = Law{},
                       Integrator integrator = Integrator{}, Solver solver = Solver{}, Wall wall = Wall{})
        : Simulator(SceneType(std::move(kernel), std::move(discretization), std::move(law), std::move(flow),
                              std::move(solver), std::move(wall)),
                    std::move(integrator), shape, std::move(params)) {}

    const SceneType& scene() const { return scene_; }
    const Params& params() const { return params_; }
    std::size_t bodies() const { return moment_.bodies.size(); }
    const State& state() const { return moment_.bodies; }
    const Configuration<Scalar>& configuration(std::size_t body = 0) const { return moment_.bodies.at(body); }
    const Films<Scalar>& films() const { return films_; }
    const std::vector<Record>& history(std::size_t body = 0) const { return histories_.at(body); }
    Scalar initial_area(std::size_t body = 0) const { return measures_.at(body).area; }
    Scalar initial_volume(std::size_t body = 0) const { return measures_.at(body).volume; }

    /// Whether all bodies met the stationarity tolerance after the last step.
    bool stationary() const { return !histories_.front().empty() && residual() < params_.tolerance; }

    /// Largest residual of the bodies after the last step; infinite before the first.
    Scalar residual() const {
        Scalar largest = 0;
        for (const std::vector<Record>& history : histories_) {
            largest =
                std::max(largest, history.empty() ? std::numeric_limits<Scalar>::infinity() : history.back().residual);
        }
        return largest;
    }

    const Scalar& time() const { return time_; }

    /// Whether the longest time has passed; automatic steps end there exactly.
    bool finished() const { return !(time_ < params_.longest_time); }

    /// A body's shape in the laboratory frame.
    Meridian<Scalar> shape(std::size_t body = 0) const {
        return detail::shifted(configuration(body).shape, configuration(body).position);
    }

    /// Velocities and forces on the current shapes. Throws SimulationFailure.
    const Moment& moment() {
        if (moment_.instants.empty()) {
            moment_ = scene_.moment(moment_.bodies);
        }
        return moment_;
    }
    const InstantType& instant(std::size_t body = 0) { return moment().instants.at(body); }

    /// Of the current state, by the referee, whether it judges steps or not. Throws SimulationFailure.
    Verdict<Scalar> verdict() {
        const Moment& now = moment();
        return Referee<SceneType>(scene_).judge(now.bodies, now.instants);
    }

    /// Goes on with `elements` elements on the current curve of a body. Throws InvalidArgument for fewer than 8 and
    /// SimulationFailure, leaving the state as it was, if they cannot carry the shape.
    void refine(Index elements, std::size_t body = 0) {
        const Discretization& discretization = scene_.discretization();
        Configuration<Scalar> refined = scene_.redistributed(configuration(body), elements);
        std::string cause = scene_.fault(refined);
        if (cause.empty() && scene_.deforms(body)) {
            cause = conserved_[body].restore(discretization, refined.shape) ? scene_.fault(refined)
                                                                            : "area and volume could not be restored";
        }
        if (!cause.empty()) {
            fail(std::to_string(elements) + " elements cannot carry the shape: " + cause);
        }
        refined.shape.z.array() -= discretization.measures(refined.shape).centroid;
        moment_.bodies[body] = std::move(refined);
        moment_.instants.clear();
        motion_.resize(0);
        starts_ = true;
        refused_ = 0;
        creeping_since_ = steps();
        films_ = scene_.films(moment_.bodies);
    }

    /// From now on takes the steps, and failures, that the recorder has instead of computing them; those it does not
    /// have are recorded there. The states are the same, bit for bit, if the simulation is that of the run recorded and
    /// no policy but the wall keeps anything between steps.
    void record_in(std::shared_ptr<StepRecorder<Scalar>> recorder) { recorder_ = std::move(recorder); }

    /// One time step; the first body's record. Throws SimulationFailure, leaving the state as it was; InvalidArgument
    /// if the next recorded step is none of this simulation; and what the recorder throws, after the step.
    const Record& step() {
        if (!recorder_) {
            RecordedStep<Scalar> unrecorded;
            advance(unrecorded);
        } else if (const auto recorded = recorder_->next()) {
            repeat(*recorded);
        } else {
            advance_and_record();
        }
        return histories_.front().back();
    }

    /// Steps until stationary (true), or until most_steps or longest_time (false). `observe(record)` is called after
    /// every step; if it returns bool, false stops the run.
    template <class Observer>
    bool run(Observer observe) {
        const Index last = steps() + params_.most_steps;
        while (steps() < last && !finished()) {
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
    struct Attempt {
        Moment moment;
        std::vector<Record> records;
        Films<Scalar> films;
        Vector<Scalar> motion;  // displacements of the nodes of all bodies, stacked
        StepReport<Scalar> report;
        bool resolved = false;
    };

    /// A state whose numbers cannot be true. If shorter steps lead to one too the steps are not the cause, nor if they
    /// only come closer and closer to it.
    struct Untrue : StepRejected {
        explicit Untrue(const std::string& cause) : StepRejected(cause, 0.25) {}
    };
    static constexpr int good_steps = 10;  // that outweigh one

    /// So many steps that bring less than this share of the time so far, and no rest either, come to no end.
    static constexpr Index creeping_steps = 500;
    static Scalar least_progress() { return Scalar(1e-3); }

    Index steps() const { return static_cast<Index>(histories_.front().size()); }

    static Params completed(Params params, const SceneType& scene) {
        params.smallest_time_step = detail::smallest_step(params, scene.velocity_scale());
        return params;
    }

    bool deforms() const {
        bool any = false;
        for (std::size_t b = 0; b < bodies() && SceneType::deformable; ++b) {
            any = any || scene_.deforms(b);
        }
        return any;
    }

    [[noreturn]] void fail(const std::string& cause) const {
        throw SimulationFailure("step " + std::to_string(steps() + 1) + " at time " + detail::text(time_) + ": " +
                                cause);
    }

    /// The step as far as it is not in the state afterwards: what was planned, tried in vain and reported.
    void advance(RecordedStep<Scalar>& made) {
        require_progress();
        Scalar planned = control_.step();
        Scalar dt = planned;
        if (const auto landing = next_landing(); !control_.fixed() && landing) {
            dt = std::min(dt, Scalar(*landing - time_));
        }
        try {
            moment();
        } catch (const SimulationFailure& failure) {
            fail(failure.what());
        }
        for (;;) {
            try {
                Attempt next = attempt(dt);
                made.planned = planned;
                made.report = next.report;
                made.resolved = next.resolved;
                accept(std::move(next), made);
                return;
            } catch (const SimulationFailure& failure) {
                if (dynamic_cast<const Untrue*>(&failure)) {
                    ++made.refused;
                    refused_ += good_steps;
                    if (!control_.fixed() && refused_ > 3 * good_steps) {
                        fail(failure.what());
                    }
                }
                const auto* rejection = dynamic_cast<const StepRejected*>(&failure);
                if (control_.fixed()) {
                    fail("time step " + detail::text(dt) + " is too large: " + failure.what());
                }
                dt = planned = dt * Scalar(rejection ? rejection->factor() : 0.5);
                made.shortened.push_back(dt);
                if (!control_.shorten(dt)) {
                    fail("the time step fell below " + detail::text(*params_.smallest_time_step) + ": " +
                         failure.what());
                }
            }
        }
    }

    /// Automatic steps may follow something ever faster, or be at the limit of stability of a mode that the elements do
    /// not carry.
    void require_progress() const {
        if (control_.fixed() || steps() <= creeping_since_ + creeping_steps) {
            return;
        }
        const auto first = static_cast<std::size_t>(steps() - 1 - creeping_steps);
        Scalar rest = 0;
        for (const std::vector<Record>& history : histories_) {
            rest = std::max<Scalar>(rest, history[first].residual);
        }
        const Scalar& then = histories_.front()[first].time;
        if (time_ - then < least_progress() * time_ && residual() > rest / 2) {
            fail("the last " + std::to_string(creeping_steps) + " steps began at time " + detail::text(then) +
                 ": they are so short, the last one " + detail::text(histories_.front().back().dt) +
                 ", that there is no end; the elements may be too few");
        }
    }

    void advance_and_record() {
        RecordedStep<Scalar> made;
        made.step = steps() + 1;
        made.begin = time_;
        try {
            advance(made);
        } catch (const SimulationFailure& failure) {
            made.failure = failure.what();
            made.wall = scene_.memory();
            recorder_->append(std::move(made));
            throw;
        }
        made.bodies = moment_.bodies;
        for (const std::vector<Record>& history : histories_) {
            made.records.push_back(history.back());
        }
        made.motion = motion_;
        made.wall = scene_.memory();
        recorder_->append(std::move(made));
    }

    /// Arrives where the recorded step did.
    void repeat(const RecordedStep<Scalar>& recorded) {
        require_fitting(recorded);
        for (const Scalar& dt : recorded.shortened) {
            control_.shorten(dt);
        }
        refused_ += recorded.refused * good_steps;
        scene_.recall(recorded.wall);
        if (!recorded.failure.empty()) {
            throw SimulationFailure(recorded.failure);
        }
        Attempt attempt;
        attempt.moment.bodies = recorded.bodies;
        attempt.records = recorded.records;
        attempt.films = scene_.films(recorded.bodies);
        attempt.motion = recorded.motion;
        attempt.report = recorded.report;
        accept(std::move(attempt), recorded);
    }

    void require_fitting(const RecordedStep<Scalar>& recorded) const {
        const auto fits = [](const auto& a, const auto& b) { return a.shape.nodes() == b.shape.nodes(); };
        const bool made = recorded.failure.empty();
        const bool ok =
            recorded.step == steps() + 1 && recorded.begin == time_ &&
            (!made || std::equal(recorded.bodies.begin(), recorded.bodies.end(), state().begin(), state().end(), fits));
        detail::require(
            ok, "recorded step", recorded.step,
            ("step " + std::to_string(steps() + 1) + " of this simulation, at time " + detail::text(time_)).c_str());
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

    /// A step of length dt, as far as the state it would lead to. Throws SimulationFailure if it leads nowhere.
    Attempt attempt(const Scalar& dt) {
        using std::abs;
        Attempt attempt;
        auto step = integrator_.step(scene_, std::as_const(moment_), dt);
        State next = std::move(step.bodies);
        StepReport<Scalar>& report = attempt.report;
        report.dt = dt;
        report.order = integrator_.order;
        report.deformable = deforms();
        Scalar error = 0;
        if constexpr (requires { step.error; }) {
            error = step.error;
            report.error = step.error;
            if constexpr (requires { integrator_.estimates_error(); }) {
                if (!integrator_.estimates_error()) {
                    report.error.reset();
                }
            }
        }
        measure_motion(next, attempt);
        control_.judge(report);
        for (std::size_t b = 0; b < next.size(); ++b) {
            Record record;
            record.step_error = error;
            settle(next[b], b, record);
            attempt.records.push_back(record);
        }
        attempt.films = scene_.films(next);
        for (std::size_t b = 0; b < next.size(); ++b) {
            keep_apart(next, b, attempt.films.bodies[b]);
        }
        attempt.moment = scene_.moment(std::move(next));
        for (std::size_t b = 0; b < attempt.records.size(); ++b) {
            describe(attempt, b, dt);
        }
        if (params_.referee) {
            judge(attempt);
        }
        return attempt;
    }

    void judge(Attempt& attempt) const {
        const Moment& next = attempt.moment;
        const Verdict<Scalar> verdict = Referee<SceneType>(scene_).judge(next.bodies, next.instants, starts_);
        if (!verdict.fault.empty()) {
            throw Untrue(verdict.fault);
        }
        attempt.resolved = Referee<SceneType>::resolved(verdict);
        for (Record& record : attempt.records) {
            record.power_mismatch = verdict.power_mismatch;
        }
    }

    /// Displacements relative to the centroids, and what the step control wants to know of them.
    void measure_motion(const State& next, Attempt& attempt) const {
        using std::abs;
        Index size = 0;
        for (const Configuration<Scalar>& body : next) {
            size += 2 * body.shape.nodes();
        }
        attempt.motion.resize(size);
        Index begin = 0;
        StepReport<Scalar>& report = attempt.report;
        for (std::size_t b = 0; b < next.size(); ++b) {
            const Meridian<Scalar>& before = moment_.bodies[b].shape;
            const Index n = before.nodes();
            attempt.motion.segment(begin, n) = next[b].shape.r - before.r;
            attempt.motion.segment(begin + n, n) = next[b].shape.z - before.z;
            const auto& body = moment_.frozen.bodies[b];
            if (!scene_.deforms(b)) {
                // Its displacement relative to the centroid is rounding.
                attempt.motion.segment(begin, 2 * n).setZero();
            }
            const bool elastic = detail::is_carrying(scene_.law(b));
            for (Index i = 0; i < n && scene_.deforms(b); ++i) {
                const Scalar along_r = attempt.motion[begin + i];
                const Scalar along_z = attempt.motion[begin + n + i];
                const Scalar normal = body.surface.normal_r[i] * along_r + body.surface.normal_z[i] * along_z;
                // Material that moves along the interface stretches it.
                const Scalar moved = elastic ? std::max<Scalar>(abs(along_r), abs(along_z)) : Scalar(abs(normal));
                report.displacement = moved <= report.displacement ? report.displacement : moved;
            }
            report.shear_rate = std::max<Scalar>(
                {report.shear_rate, body.shear_rate,
                 Scalar(abs(moment_.instants[b].velocity) / (2 * films_.bodies[b].min)), closing_rate(b)});
            begin += 2 * n;
        }
        report.reversed = motion_.size() == attempt.motion.size() && attempt.motion.dot(motion_) < Scalar(0);
    }

    /// Relative velocity of a body and the next one over their distance.
    Scalar closing_rate(std::size_t b) const {
        using std::abs;
        const auto& instants = moment_.instants;
        return b + 1 < instants.size()
                   ? Scalar(abs(instants[b + 1].velocity - instants[b].velocity) / films_.bodies[b].to_neighbour)
                   : Scalar(0);
    }

    /// Checks a displaced body and gives it back what its law conserves.
    void settle(Configuration<Scalar>& next, std::size_t b, Record& record) const {
        if constexpr (SceneType::deformable) {
            if (scene_.deforms(b)) {
                const Discretization& discretization = scene_.discretization();
                require_usable(next);
                const Measures<Scalar> raw = discretization.measures(next.shape);
                const Conserved<Scalar>& kept = conserved_[b];
                record.area_error = kept.area ? Scalar(raw.area / *kept.area - 1) : Scalar(0);
                record.volume_error = raw.volume / kept.volume - 1;
                if (!kept.restore(discretization, next.shape)) {
                    throw SimulationFailure("area and volume drifted by " + detail::text(record.area_error) + " and " +
                                            detail::text(record.volume_error) + " and could not be restored");
                }
                record.redistributed = scene_.redistribute(next);
                if (record.redistributed && !kept.restore(discretization, next.shape)) {
                    throw SimulationFailure(
                        "area and volume could not be restored after the nodes were moved along the membrane, for "
                        "which " +
                        std::to_string(next.shape.nodes()) + " of them are too few");
                }
                require_usable(next);
            }
        }
        const Measures<Scalar> measures = scene_.discretization().measures(next.shape);
        next.shape.z.array() -= measures.centroid;
        next.position += measures.centroid;
        record.area = measures.area;
        record.volume = measures.volume;
        record.area_drift = measures.area / measures_[b].area - 1;
        record.volume_drift = measures.volume / measures_[b].volume - 1;
    }

    void require_usable(const Configuration<Scalar>& body) const {
        const std::string cause = scene_.fault(body);
        if (!cause.empty()) {
            throw SimulationFailure(cause);
        }
    }

    /// In one step the film, or the distance to a neighbour, may lose at most half of its thickness.
    void keep_apart(const State& next, std::size_t b, const FilmThickness<Scalar>& film) const {
        const auto guard = [](const Scalar& before, const Scalar& after, const char* of, const char* contact) {
            if (std::isinf(static_cast<double>(before)) || after > before / 2) {
                return;
            }
            throw SimulationFailure(after > Scalar(0)
                                        ? "the distance to the " + std::string(of) + " would shrink from " +
                                              detail::text(before) + " to " + detail::text(after)
                                        : std::string(contact));
        };
        guard(films_.bodies[b].min, film.min, "wall", "the membrane would cross the wall");
        if (b > 0 && detail::meet(next[b - 1], next[b])) {
            throw SimulationFailure("bodies " + std::to_string(b - 1) + " and " + std::to_string(b) + " would meet");
        }
        guard(films_.bodies[b].to_neighbour, film.to_neighbour, "next body", "two bodies would touch");
    }

    void describe(Attempt& attempt, std::size_t b, const Scalar& dt) const {
        using std::abs;
        const Configuration<Scalar>& body = attempt.moment.bodies[b];
        const InstantType& instant = attempt.moment.instants[b];
        Record& record = attempt.records[b];
        record.step = steps() + 1;
        const std::optional<Scalar> landing = next_landing();
        record.time = landing && dt == *landing - time_ ? *landing : Scalar(time_ + dt);
        record.dt = dt;
        record.position = body.position;
        record.velocity = instant.velocity;
        // Several bodies are at rest relative to each other only if they move alike.
        const Scalar apart = abs(instant.velocity - attempt.moment.instants.front().velocity);
        record.residual = std::max(instant.deformation_rate, apart) / std::max(Scalar(1), scene_.velocity_scale());
        record.pressure_drop = instant.pressure_drop;
        record.power = instant.power;
        record.length = body.shape.z[body.shape.nodes() - 1] - body.shape.z[0];
        record.max_radius = scene_.discretization().max_radius(body.shape);
        const FilmThickness<Scalar>& film = attempt.films.bodies[b];
        record.film_thickness_min = film.min;
        record.film_thickness_mean = film.mean;
        record.neighbour_distance = film.to_neighbour;
        if constexpr (SceneType::deformable) {
            if (scene_.deforms(b)) {
                record.bending_energy = scene_.discretization().bending_energy(body.shape);
            }
        }
    }

    void accept(Attempt attempt, const RecordedStep<Scalar>& made) {
        const auto rejected = static_cast<Index>(made.shortened.size());
        const Scalar before = residual();
        time_ = attempt.records.front().time;
        moment_ = std::move(attempt.moment);
        films_ = std::move(attempt.films);
        starts_ = starts_ && !made.resolved;
        refused_ = std::max(0, refused_ - 1);
        bool redistributed = false;
        for (std::size_t b = 0; b < histories_.size(); ++b) {
            attempt.records[b].rejected = rejected;
            redistributed = redistributed || attempt.records[b].redistributed;
            histories_[b].push_back(attempt.records[b]);
        }
        attempt.report.accelerating = steps() > 1 && residual() > before;
        control_.accept(attempt.report, made.planned, rejected > 0);
        // On moved nodes displacements cannot be compared.
        motion_ = redistributed ? Vector<Scalar>() : std::move(attempt.motion);
    }

    Params params_;
    SceneType scene_;
    Integrator integrator_;
    Control control_;
    Moment moment_;  // without instants if not known yet
    std::vector<std::vector<Record>> histories_;
    std::vector<Measures<Scalar>> measures_;  // initial
    std::vector<Conserved<Scalar>> conserved_;
    Films<Scalar> films_;
    Vector<Scalar> motion_;     // of the last step
    bool starts_ = true;        // whether the elements have not yet carried a shape
    int refused_ = 0;           // good_steps for every attempt that was untrue, less the steps since
    Index creeping_since_ = 0;  // steps that may count as creeping
    Scalar time_{};
    std::shared_ptr<StepRecorder<Scalar>> recorder_;
};

template <class Kernel, class Discretization, class Law, class Flow, class Solver, class Wall, class Integrator,
          class... ShapesAndParams>
Simulator(Scene<Kernel, Discretization, Law, Flow, Solver, Wall>, Integrator, ShapesAndParams...)
    -> Simulator<Kernel, Discretization, Law, Flow, Integrator, Solver, Wall>;

}  // namespace axistokes
