// SPDX-License-Identifier: MIT
// Runs a vesicle to its end, whatever that is: command line in, progress and files out; the rest is the library's
// Driver.
#include "../support/results.hpp"
#include "../support/thin_film.hpp"
#include "../support/vesicle_case.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <chrono>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace examples {

namespace {

/// So many elements cannot carry it.
struct InitialShapeFailure : axistokes::SimulationFailure {
    using SimulationFailure::SimulationFailure;
};

class VesicleRun {
    using Index = axistokes::Index;
    using Shape = axistokes::Meridian<double>;

  public:
    explicit VesicleRun(const VesicleCase& c)
        : case_(c),
          run_(c.run.resolved()),
          params_(run_.params()),
          tolerance_(tolerance_for(case_, run_)),
          discretization_(AnyDiscretization::of(run_.method.kind(), tolerance_)),
          frames_(run_.frame_times) {
        // With as many elements as that takes Newton's method does not get below round-off.
        axistokes::detail::require(!(run_.method.kind() == DiscretizationKind::adaptive && run_.adapts() &&
                                     !run_.transient() && run_.driver_params().eps < 1e-8),
                                   "--preset-accuracy", run_.method.preset.value_or(""),
                                   "fast or balanced with --discretization adaptive, unless --elements is given");
    }

    int operator()() {
        std::optional<int> code;
        while (!(code = attempt())) {
            run_.method.usual_discretization = "adaptive";
            discretization_ = AnyDiscretization::of(run_.method.kind(), tolerance_);
        }
        return *code;
    }

  private:
    /// The exit code; none if another discretisation is to be tried.
    std::optional<int> attempt() {
        ProgressBar bar;
        Approach approach(params_.tolerance);
        try {
            Driver driver([&](Index elements) { return simulation(elements); }, run_.driver_params(),
                          [&](const Simulation& s) {
                              observe(s, approach, bar);
                              return !InterruptGuard::interrupted() && !overtaxed(s);
                          });
            if (!journal_) {
                journal_ = run_.checkpoints.journal(run_.directory);
                driver.simulation().record_in(journal_);
            }
            Ending ending = run_to_the_end(driver, begin_);
            bar.hide();
            const bool failed = !ending.failure.empty() && !ending.result.interrupted;
            if (may_change() && (failed || overtaxed(driver.simulation()))) {
                given_up_ = ending.failure.empty() ? "the forces' power is not that of weight and elastic energy"
                                                   : ending.failure;
                return std::nullopt;
            }
            ending.result.error_estimate += wall_error(driver.simulation(), ending.result, case_.surroundings);
            return conclude(driver.simulation(), ending, run_, frames_.frames(), summary(driver.simulation(), ending),
                            journal_.get());
        } catch (const InitialShapeFailure& failure) {
            if (!may_change()) {
                throw;
            }
            given_up_ = failure.what();
            return std::nullopt;
        }
    }

    /// Whether a series was neither asked for nor the last resort.
    bool may_change() const {
        const auto& method = run_.method;
        return !method.discretization && method.kind() == DiscretizationKind::spectral && run_.adapts() &&
               (run_.transient() || run_.driver_params().eps >= 1e-8) && !InterruptGuard::interrupted();
    }

    /// Whether the largest number of modes does not carry the shape.
    bool overtaxed(const Simulation& simulation) const {
        constexpr double mismatch = 1e-2;
        return may_change() && !simulation.history().empty() &&
               simulation.configuration().shape.elements() >= axistokes::most_elements(discretization_) &&
               simulation.history().back().power_mismatch > mismatch;
    }

    /// Of integrals and of the tube's kernel: that of the preset, if any, relative to what the wall leaves of a force
    /// in the film of the roundest shape that fits.
    static std::optional<double> tolerance_for(VesicleCase& c, const RunOptions& run) {
        const auto accuracy = run.method.accuracy();
        if (!accuracy || !c.surroundings.tube_radius) {
            return accuracy ? std::optional(accuracy->quadrature) : std::nullopt;
        }
        const double volume = 4 * std::numbers::pi / 3;
        const double narrowest = axistokes::critical_tube_radius(3 * volume + c.excess_area, volume);
        // Vesicles have no such drag: they deform, and are carried along by the fluid.
        const double left = 100 * remainder(std::max(0.0, 1 - narrowest / *c.surroundings.tube_radius));
        if (c.surroundings.wall) {
            c.surroundings.wall->tolerance = tightened(c.surroundings.wall->tolerance, left, 1e-11);
        }
        return tightened(accuracy->quadrature, left);
    }

    /// From the initial shape, of exact area and volume where they can be had.
    Simulation simulation(Index elements) {
        // What the initial shape lacks a run to a given time would never make up for.
        const double share = run_.transient() ? run_.driver_params().unresolved : 2e-2;
        Shape shape = discretization_.judges_itself() && run_.adapts()
                          ? axistokes::resolved_nodes(discretization_, case_.initial, elements, share)
                          : axistokes::nodes_of(discretization_, case_.initial, elements);
        std::string fault = restored(shape);
        for (const Index most = axistokes::most_elements(discretization_);
             !fault.empty() && run_.adapts() && shape.elements() < most; fault = restored(shape)) {
            const Index more = std::min(most, shape.elements() + shape.elements() / 2);
            shape = axistokes::nodes_of(discretization_, case_.initial, more);
        }
        if (!fault.empty()) {
            throw InitialShapeFailure(fault + ": " + std::to_string(shape.elements()) + " elements cannot carry it");
        }
        Simulation simulation(Scene(kernel_for(case_.surroundings, tolerance_), discretization_, Law(Vesicle()),
                                    case_.drive, Solver(), wall_for(case_.surroundings)),
                              run_.method.steps(params_.step_tolerance), shape, params_);
        simulation.record_in(journal_);
        frames_ = FramesAt(run_.frame_times);
        frames_.visit(0, simulation);
        return simulation;
    }

    /// Gives the initial shape its exact area and volume, where they can be had; why it is none, or an empty text.
    std::string restored(Shape& shape) const {
        Shape exact = shape;
        const double area = 4 * std::numbers::pi + case_.excess_area;
        if (discretization_.judges_itself() && case_.excess_area > 0 &&
            discretization_.restore(exact, area, 4 * std::numbers::pi / 3)) {
            shape = std::move(exact);
        }
        const double off = discretization_.measures(shape).area / area - 1;
        if (std::abs(off) > 0.05) {
            return "the initial shape's area is off by " + axistokes::detail::text(off);
        }
        const auto& tube = case_.surroundings.tube_radius;
        if (const double widest = discretization_.max_radius(shape); tube && !(widest < *tube)) {
            return "the initial shape's largest radius is " + axistokes::detail::text(widest) + ", the tube's " +
                   axistokes::detail::text(*tube);
        }
        return "";
    }

    void observe(const Simulation& simulation, Approach& approach, ProgressBar& bar) {
        const auto& record = simulation.history().back();
        std::ostringstream text;
        text << "step " << record.step << "  time " << record.time << "  residual " << record.residual;
        frames_.visit(record.time, simulation);
        const double by_time = record.time / params_.longest_time;
        const double by_steps = static_cast<double>(record.step) / static_cast<double>(params_.most_steps);
        bar.show(std::max({approach.fraction(record.residual), by_time, by_steps}), text.str());
    }

    nlohmann::ordered_json summary(const Simulation& simulation, const Ending& ending) const {
        nlohmann::ordered_json summary = summarize(simulation, ending);
        run_.method.describe(summary);
        if (!given_up_.empty()) {
            summary["spectral_failure"] = given_up_;
        }
        summary["method_stationary"] = run_.method.stationary;
        if (case_.surroundings.tube_radius) {
            summary.update(tube_summary(simulation, ending, case_.mean_velocity));
        }
        if (case_.details) {
            summary.update(case_.details(end(simulation, ending)));
        }
        summary["parameters"] = case_.parameters;
        return summary;
    }

    static VesicleEnd end(const Simulation& simulation, const Ending& ending) {
        VesicleEnd end{ending.result.configuration().shape, {}, {}, {}};
        if (const auto* instant = ending.result.instant(); instant && instant->solution.tension.size() > 0) {
            end.tension = instant->surface.at_nodes(instant->solution.tension);
        }
        for (const auto& record : simulation.history()) {
            end.times.push_back(record.time);
            end.lengths.push_back(record.length);
        }
        return end;
    }

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    InterruptGuard guard_;
    VesicleCase case_;
    RunOptions run_;
    axistokes::SimulationParams<double> params_;
    std::optional<double> tolerance_;
    AnyDiscretization discretization_;
    FramesAt frames_;
    std::string given_up_;              // why series were, if they were
    std::shared_ptr<Journal> journal_;  // from the first step on
};

}  // namespace

int run_vesicle(const VesicleCase& c) {
    return VesicleRun(c)();
}

}  // namespace examples
