// SPDX-License-Identifier: MIT
// The options of the simulations on the command line. Only the programs include it, not what they share: the parser
// takes long to compile.
#pragma once

#include "options.hpp"
#include "program.hpp"
#include "tube.hpp"

namespace examples {

inline void MethodOptions::add_to(CLI::App& app, bool rigid) {
    const std::string idle = rigid ? "; a rigid body takes one solution in any case" : "";
    app.add_option("--discretization", discretization, "of the meridian: linear or spectral (default: spectral)");
    app.add_option("--integrator", integrator,
                   std::string("euler, order2, order3, or adaptive: third order, and up to sixth for tight tolerances\n"
                               "(default: euler to a stationary state; adaptive where the way matters, and with\n"
                               "--preset-accuracy)") +
                       idle);
    app.add_option(
           "--stationary", stationary,
           std::string("auto: march in time until the branch is settled, then Newton's method; or march, to the end;\n"
                       "or newton, after a few steps") +
               idle)
        ->capture_default_str();
    app.add_option("--preset-accuracy", preset,
                   "fast (1e-3), balanced (1e-6) or reference (1e-10): every tolerance and the number of elements" +
                       (preset ? " (default: " + *preset + ")" : std::string()));
}

inline void RunOptions::add_to(CLI::App& app) {
    add_number(app, "--elements", elements,
               "elements, or modes, on the meridian (default: as many as the accuracy takes, 1e-4 without "
               "--preset-accuracy)");
    add_number(app, "--tolerance", tolerance, "stationary when the residual is below this (default: 1e-5)");
    method.add_to(app);
    add_output_to(app);
    add_number(app, "--dt", time_step, "fixed time step (default: automatic)");
    add_number(app, "--step-tolerance", step_tolerance,
               "error allowed in a time step, in R0, by integrators that estimate it (default: 1e-4)");
    add_number(app, "--time", time, "stop at this time, stationary or not");
    add_number(app, "--max-steps", steps, "stop after this many steps, stationary or not");
    app.add_option(
           "--frame-times", frame_times,
           "t1,t2,...: also write frames.csv, the shapes at these times (with --dt the first ones at or after them)")
        ->delimiter(',')
        ->check(number_check<double>("--frame-times"));
}

inline void RunOptions::add_output_to(CLI::App& app) {
    app.add_option("--out", directory, "directory for summary.json, shape.csv and history.csv; created if missing");
    app.add_flag("--vtk", vtk, "also write surface.vtp, for ParaView");
    app.add_flag("--flow-field", flow_field, "also write flow.vts, the flow in a plane through the axis");
}

inline void VesicleOptions::add_to(CLI::App& app) {
    add_number(app, "--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2 (0: a sphere)");
    add_kind_to(app);
}

inline void VesicleOptions::add_kind_to(CLI::App& app) {
    app.add_option("--initial", kind, "initial shape: prolate or oblate spheroid")->capture_default_str();
}

inline void TubeOptions::add_to(CLI::App& app, const std::string& without) {
    add_number(app, "--confinement", confinement, "R0 over the tube's radius; without it " + without);
}

}  // namespace examples
