// SPDX-License-Identifier: MIT
// What is kept of a step: a row of the history; and all that takes its place when a run is repeated.
#pragma once

#include "scene.hpp"
#include "step_control.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace axistokes {

/// One line of a body's history: the state a step arrived at, all of it at that one instant. Dimensionless: lengths in
/// R0, times in eta R0^3/kappa, velocities in kappa/(eta R0^2), energies in kappa.
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
    S bending_energy{};  // 2 Int H^2 dA; 0 for a rigid body
    S residual{};  // largest normal velocity relative to the centroid, or of it relative to the first body's, over the
                   // velocity scale
    S film_thickness_min = std::numeric_limits<S>::infinity();  // distance to the wall, along the curve
    S film_thickness_mean = std::numeric_limits<S>::infinity();
    S neighbour_distance = std::numeric_limits<S>::infinity();  // to the nearest other body
    S step_error{};                                             // estimated, in R0; integrators with an estimate only
    S pressure_drop{};                                          // added by the body, in kappa/R0^3; 0 without walls
    S power{};           // of the body's forces in the flow that the bodies add, in kappa^2/(eta R0^3)
    S power_mismatch{};  // of all bodies: Verdict; 0 without a referee
    Index rejected = 0;  // attempts with larger steps before this one
    bool redistributed = false;
};

/// A step as a Simulator made it, or why there was none: what it needs to go on from there without computing it.
template <class S>
struct RecordedStep {
    Index step = 0;            // its number, from 1 on
    S begin{};                 // time
    std::vector<S> shortened;  // the steps planned after each attempt in vain
    int refused = 0;           // of these attempts by the referee
    /// Why the simulation could not go on; empty if it could, and only then there is what follows but for the wall.
    std::string failure;
    S planned{};            // before it was cut short to land on a time
    bool resolved = false;  // Referee::resolved
    StepReport<S> report;
    std::vector<Configuration<S>> bodies;
    std::vector<StepRecord<S>> records;
    Vector<S> motion;
    Vector<S> wall;  // its memory, after the step
};

/// Steps of an earlier run, in the order in which they were made, and of this one. Simulators that take turns in a run
/// share one.
template <class S>
class StepRecorder {
  public:
    virtual ~StepRecorder() = default;
    /// The next step of the earlier run; none when all have been repeated.
    virtual std::optional<RecordedStep<S>> next() = 0;
    virtual void append(RecordedStep<S> step) = 0;
};

}  // namespace axistokes
