// SPDX-License-Identifier: MIT
// Runs a vesicle to its end, whatever that is: command line in, progress and files out; the rest is the library's
// Driver.
#pragma once

#include "compiled.hpp"
#include "progress.hpp"
#include "run.hpp"
#include "tube.hpp"
#include "vesicle_case.hpp"
#include <axistokes/accuracy/driver.hpp>
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
    using Simulator = axistokes::Simulator<Kernel, Discretization, axistokes::Vesicle<double>, Drive,
                                           axistokes::ExtrapolatedEulerOfOrder, axistokes::DenseLU<double>, Wall>;
    using Driver = axistokes::Driver<Simulator, CompiledSolver<typename Simulator::SceneType>>;

  public:
    VesicleRun(const VesicleCase& c, Kernel kernel, Wall wall)
        : case_(c),
          run_(c.run.resolved()),
          params_(run_.params()),
          accuracy_(run_.method.accuracy()),
          discretization_(axistokes::discretization_for<Discretization>(accuracy_)),
          kernel_(std::move(kernel)),
          wall_(std::move(wall)),
          frames_(run_.frame_times) {}

    int operator()() {
        if (!run_.directory.empty()) {
            axistokes::create_output_directory(run_.directory);  // better now than after the run
        }
        const auto begin = std::chrono::steady_clock::now();
        const InterruptGuard guard;
        ProgressBar bar;
        Approach approach(params_.tolerance);
        Driver driver([&](Index elements) { return simulator(elements); }, run_.driver_params(),
                      [&](const Simulator& s) {
                          observe(s, approach, bar);
                          return !guard.interrupted();
                      });
        Ending<Simulator> ending;
        try {
            driver.run();
        } catch (const axistokes::SimulationFailure& failure) {
            ending.failure = failure.what();
        }
        bar.hide();
        ending.result = driver.result();
        ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return conclude(driver.simulator(), ending, run_, frames_.frames(), summary(driver.simulator(), ending));
    }

  private:
    static constexpr bool spectral = axistokes::JudgesItself<Discretization>;

    /// From the initial shape, of exact area and volume where they can be had.
    Simulator simulator(Index elements) {
        // What the initial shape lacks a run to a given time would never make up for.
        const double share = run_.transient() ? run_.driver_params().unresolved : 2e-2;
        Shape shape = spectral && run_.adapts()
                          ? axistokes::resolved_nodes(discretization_, case_.initial, elements, share)
                          : axistokes::nodes_of(discretization_, case_.initial, elements);
        Shape exact = shape;
        if (spectral && case_.excess_area > 0 &&
            discretization_.restore(exact, 4 * std::numbers::pi + case_.excess_area, 4 * std::numbers::pi / 3)) {
            shape = std::move(exact);
        }
        Simulator simulator(typename Simulator::SceneType(kernel_, discretization_, axistokes::Vesicle<double>(),
                                                          case_.drive, axistokes::DenseLU<double>(), wall_),
                            run_.method.steps(params_.step_tolerance), shape, params_);
        frames_ = FramesAt(run_.frame_times);
        frames_.visit(0, simulator);
        return simulator;
    }

    void observe(const Simulator& simulator, Approach& approach, ProgressBar& bar) {
        const auto& record = simulator.history().back();
        std::ostringstream text;
        text << "step " << record.step << "  time " << record.time << "  residual " << record.residual;
        frames_.visit(record.time, simulator);
        const double by_time = record.time / params_.longest_time;
        const double by_steps = static_cast<double>(record.step) / static_cast<double>(params_.most_steps);
        bar.show(std::max({approach.fraction(record.residual), by_time, by_steps}), text.str());
    }

    nlohmann::ordered_json summary(const Simulator& simulator, const Ending<Simulator>& ending) const {
        nlohmann::ordered_json summary = summarize(simulator, ending);
        run_.method.describe(summary);
        summary["method_stationary"] = run_.method.stationary;
        if (case_.surroundings.tube_radius) {
            summary.update(tube_summary(simulator, ending, case_.mean_velocity));
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
    FramesAt frames_;
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
