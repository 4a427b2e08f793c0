// SPDX-License-Identifier: MIT
// Runs a vesicle to its end, whatever that is: in time or by Newton's method, with as many elements as the accuracy
// takes.
#pragma once

#include "compiled.hpp"
#include "progress.hpp"
#include "resolution.hpp"
#include "run.hpp"
#include "tube.hpp"
#include "vesicle_case.hpp"
#include <axistokes/simulator.hpp>
#include <axistokes/wall/no_wall.hpp>

#include <chrono>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace examples {

template <class Discretization, class Kernel, class Wall>
class VesicleRun {
    using Index = axistokes::Index;
    using Shape = axistokes::Meridian<double>;
    using Simulator = axistokes::Simulator<Kernel, Discretization, Vesicle<Discretization>, Drive,
                                           axistokes::ExtrapolatedEulerOfOrder, axistokes::DenseLU<double>, Wall>;
    using Solver = CompiledSolver<typename Simulator::SceneType>;
    using Failure = axistokes::SimulationFailure;
    static constexpr bool spectral = judges_itself<Discretization>;
    static constexpr double unresolved_to_error = axistokes::Accuracy<double>::unresolved_to_error;

  public:
    VesicleRun(const VesicleCase& c, Kernel kernel, Wall wall)
        : case_(c),
          run_(c.run.resolved()),
          params_(run_.params()),
          accuracy_(run_.method.accuracy()),
          discretization_(discretization_for<Discretization>(accuracy_)),
          kernel_(std::move(kernel)),
          wall_(std::move(wall)),
          frames_(run_.frame_times),
          approach_(params_.tolerance) {
        // The solver for one more kind of scene would take a minute to compile.
        axistokes::detail::require(!Wall::present || !run_.method.newton(), "--stationary", run_.method.stationary,
                                   "march with --method wall");
        start(run_.adapts() ? first_elements<Discretization> : run_.elements_or(spectral ? 32 : 64));
    }

    int operator()() {
        if (!run_.directory.empty()) {
            axistokes::create_output_directory(run_.directory);  // better now than after the run
        }
        const auto begin = std::chrono::steady_clock::now();
        {
            const InterruptGuard guard;
            ProgressBar bar;
            guard_ = &guard;
            bar_ = &bar;
            try {
                solve();
            } catch (const Failure& failure) {
                ending_.take(*simulator_);
                ending_.failure = failure.what();
            }
            ending_.interrupted = guard.interrupted();
        }
        ending_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return conclude(*simulator_, ending_, run_, frames_.frames(), summary());
    }

  private:
    void solve() {
        if constexpr (!Wall::present) {
            if (run_.method.newton()) {
                newton();
                return;
            }
        }
        march_to_the_end();
    }

    double exact_area() const { return 4 * std::numbers::pi + case_.excess_area; }
    static double exact_volume() { return 4 * std::numbers::pi / 3; }

    /// (Re)starts from the initial shape, of exact area and volume where they can be had.
    void start(Index elements) {
        // What the initial shape lacks a run to a given time would never make up for.
        Shape shape = spectral && run_.adapts() && run_.transient()
                          ? resolved_nodes(discretization_, case_.initial, elements, accuracy_->unresolved)
                          : nodes_of(discretization_, case_.initial, elements);
        Shape exact = shape;
        if (spectral && case_.excess_area > 0 && discretization_.restore(exact, exact_area(), exact_volume())) {
            shape = std::move(exact);
        }
        simulator_.emplace(shape, case_.drive, params_, kernel_, discretization_, Vesicle<Discretization>{},
                           run_.method.steps(params_.step_tolerance), axistokes::DenseLU<double>{}, wall_);
        frames_ = FramesAt(run_.frame_times);
        frames_.visit(0, *simulator_);
    }

    Index elements() const { return simulator_->configuration().shape.elements(); }
    Index steps() const { return static_cast<Index>(simulator_->history().size()); }
    static constexpr Index most() { return most_elements<Discretization>; }

    /// Share of the last modes that may remain: on the way to a stationary state the residual's size will do.
    double allowed(double residual) const {
        const double least = accuracy_->unresolved;
        return run_.transient() ? least : std::max(least, std::min(5e-3, residual));
    }

    /// At least `first` steps, then until the residual is below `residual`, until `last` steps or the end of the run;
    /// with more modes as soon as the shape needs them.
    void march(double residual, Index first, Index last) {
        Simulator& s = *simulator_;
        bool going = true;
        const auto observe = [&](const auto& record) {
            std::ostringstream text;
            text << "step " << record.step << "  time " << record.time << "  residual " << record.residual;
            frames_.visit(record.time, s);
            const double by_time = record.time / params_.longest_time;
            const double by_steps = static_cast<double>(record.step) / static_cast<double>(params_.most_steps);
            bar_->show(std::max({approach_.fraction(record.residual), by_time, by_steps}), text.str());
            going = (record.step < first || !(record.residual < residual)) && record.step < last && !s.finished() &&
                    !guard_->interrupted();
            return going && !needs_modes(record.residual);
        };
        while (going) {
            s.run(observe);
            if (needs_modes(s.history().back().residual) && !guard_->interrupted()) {
                add_modes(s.history().back().residual);
                going = !s.finished() && steps() < last;
            } else {
                going = going && !s.stationary();
            }
        }
    }

    bool needs_modes(double residual) const {
        if constexpr (spectral) {
            return run_.adapts() && elements() < most() &&
                   discretization_.unresolved(simulator_->configuration().shape) > allowed(residual);
        } else {
            return false;
        }
    }
    void add_modes(double residual) {
        if constexpr (spectral) {
            const double now = discretization_.unresolved(simulator_->configuration().shape);
            simulator_->refine(more_modes(elements(), now, allowed(residual), most()));
        }
    }

    void march_to_the_end() {
        if (!finished_by_newton()) {
            march_all_the_way();
            ending_.take(*simulator_);
        }
    }

    /// The last digits of an accurate stationary state: slow modes make its error many times larger than the residual,
    /// and Newton's method ends with a much smaller one. The branch is settled by then.
    bool finished_by_newton() {
        if constexpr (spectral && !Wall::present) {
            constexpr double handover = 1e-6;
            if (accuracy_ && !run_.transient() && params_.tolerance < handover) {
                march(handover, 0, params_.most_steps);
                if (simulator_->history().back().residual < handover && !guard_->interrupted()) {
                    return converged();
                }
            }
        }
        return false;
    }

    void march_all_the_way() {
        const auto march_on = [&] { march(params_.tolerance, 0, params_.most_steps); };
        march_on();
        if constexpr (spectral) {
            judge(simulator_->configuration().shape);
        } else if (run_.adapts()) {
            Measured coarse = measured(simulator_->configuration().shape, simulator_->history().back().velocity);
            double error = 1;  // unknown
            while (!guard_->interrupted()) {
                const Index next = more_elements(coarse.elements, error, accuracy_->eps, most());
                run_.transient() ? start(next) : simulator_->refine(next);
                march_on();
                const Measured fine =
                    measured(simulator_->configuration().shape, simulator_->history().back().velocity);
                error = second_order_error(coarse, fine);
                coarse = fine;
                report_error(error);
                if (error <= accuracy_->eps || fine.elements >= most()) {
                    break;
                }
            }
        }
    }

    Measured measured(const Shape& shape, double velocity) const {
        // Nothing drives a vesicle at rest: its velocity is no result.
        const bool driven = simulator_->scene().velocity_scale() > 0;
        return {driven ? velocity : 0.0, shape.z[shape.nodes() - 1] - shape.z[0], shape.elements()};
    }

    void report_error(double error) {
        details_["error_estimate"] = error;
        if (accuracy_) {
            details_["error_met"] = error <= accuracy_->eps;
        }
    }
    void judge(const Shape& shape) {
        if constexpr (spectral) {
            report_error(discretization_.unresolved(shape) / unresolved_to_error);
        }
    }

    /// A few time steps until a Newton iteration converges; if none does, time steps to the end.
    void newton() {
        constexpr int attempts = 4;
        // In a strong flow the residual is small from the start, and says little about how far there is to go.
        constexpr Index least = 20;
        double handover = 3e-2;
        for (int attempt = 0; attempt < attempts && !guard_->interrupted(); ++attempt) {
            march(std::max(handover, params_.tolerance), least, std::min<Index>(steps() + 40, params_.most_steps));
            if (converged()) {
                return;
            }
            handover = std::min(handover, simulator_->history().back().residual) / 5;
        }
        march_to_the_end();
    }

    bool converged() {
        try {
            converge();
            details_.erase("newton_failure");
            return true;
        } catch (const Failure& failure) {
            details_["newton_failure"] = failure.what();
            return false;
        }
    }

    typename Solver::Params solver_params() const {
        typename Solver::Params params;
        params.tolerance = run_.tolerance ? *run_.tolerance : accuracy_ ? accuracy_->residual : params.tolerance;
        params.to_round_off = accuracy_.has_value();
        return params;
    }

    /// The stationary state near the simulator's, with more and more elements if these are to be chosen. What a finer
    /// one fails to improve stays.
    void converge() {
        Solver solver(simulator_->scene(), solver_params());
        const double area = simulator_->initial_area();
        const double volume = simulator_->initial_volume();
        auto state = solver.solve(simulator_->configuration().shape, area, volume);
        Index iterations = state.iterations;
        Index evaluations = state.evaluations;
        adopt(state);
        bool examined = !run_.adapts();
        double error = 1;
        while (run_.adapts() && !guard_->interrupted()) {
            const Shape& shape = state.configuration.shape;
            const Index now = shape.elements();
            Index next = 0;
            if constexpr (spectral) {
                error = discretization_.unresolved(shape) / unresolved_to_error;
                report_error(error);
                next = more_modes(now, unresolved_to_error * error, accuracy_->unresolved, most());
            } else {
                next = more_elements(now, error, accuracy_->eps, most());
            }
            // Growth rates need no more than a recognisable shape, and cost as much as many iterations.
            if (!examined && (!spectral || error < 1e-3 || now >= most())) {
                examine(solver, state);
                examined = true;
            }
            if (error <= accuracy_->eps || now >= most()) {
                break;
            }
            try {
                auto finer = solver.solve(discretization_.redistributed(shape, next), area, volume);
                iterations += finer.iterations;
                evaluations += finer.evaluations;
                if constexpr (!spectral) {
                    error = second_order_error(measured(shape, state.instant.velocity),
                                               measured(finer.configuration.shape, finer.instant.velocity));
                    report_error(error);
                }
                state = std::move(finer);
                adopt(state);
            } catch (const Failure& failure) {
                details_["refinement_failure"] = failure.what();
                break;
            }
        }
        if (!run_.adapts()) {
            judge(state.configuration.shape);
            examine(solver, state);
        } else if (!examined) {
            examine(solver, state);
        }
        details_["newton_iterations"] = iterations;
        details_["newton_evaluations"] = evaluations;
    }

    /// Of a coarser state near this one if there are many modes: growth rates need no accuracy, and one evaluation or
    /// two a mode.
    void examine(Solver& solver, const typename Solver::State& given) {
        constexpr Index enough = 64;
        typename Solver::State state = given;
        if (spectral && given.configuration.shape.elements() > enough) {
            try {
                state = solver.solve(discretization_.redistributed(given.configuration.shape, enough),
                                     simulator_->initial_area(), simulator_->initial_volume());
            } catch (const Failure&) {
                return;  // without them
            }
        }
        const double rate = solver.leading_growth_rate(state);
        details_["stable"] = rate < 0;
        details_["leading_growth_rate"] = rate;
        details_["stability_elements"] = state.configuration.shape.elements();
    }

    void adopt(const typename Solver::State& state) {
        ending_.configuration = state.configuration;
        ending_.configuration.position = simulator_->configuration().position;
        ending_.instant = state.instant;
        ending_.velocity = state.instant.velocity;
        ending_.residual = state.residual;
        ending_.pressure_drop = state.instant.pressure_drop;
        ending_.stationary = true;
    }

    nlohmann::ordered_json summary() const {
        nlohmann::ordered_json summary = summarize(*simulator_, ending_);
        run_.method.describe(summary);
        summary["method_stationary"] = run_.method.stationary;
        summary.update(details_);
        if (case_.surroundings.tube_radius) {
            summary.update(tube_summary(*simulator_, ending_, case_.mean_velocity));
        }
        summary["parameters"] = case_.parameters;
        return summary;
    }

    VesicleCase case_;
    RunOptions run_;
    axistokes::SimulationParams<double> params_;
    std::optional<axistokes::Accuracy<double>> accuracy_;
    Discretization discretization_;
    Kernel kernel_;
    Wall wall_;
    std::optional<Simulator> simulator_;
    FramesAt frames_;
    Approach approach_;
    Ending<Simulator> ending_;
    nlohmann::ordered_json details_ = nlohmann::ordered_json::object();
    const InterruptGuard* guard_ = nullptr;
    ProgressBar* bar_ = nullptr;
};

/// Without a meshed wall.
template <class Discretization>
int run_in(const VesicleCase& c) {
    const auto accuracy = c.run.method.accuracy();
    return VesicleRun<Discretization, OptionalTubeKernel, axistokes::NoWall>(
        c, c.surroundings.kernel(accuracy ? std::optional(accuracy->kernel) : std::nullopt), {})();
}

template <class Discretization>
int run_in_mesh(const VesicleCase& c) {
    return VesicleRun<Discretization, axistokes::FreeSpaceKernel<double>,
                      axistokes::WallMesh<axistokes::StraightTube<double>>>(c, {}, c.surroundings.mesh())();
}

}  // namespace examples
