// SPDX-License-Identifier: MIT
// The options of the simulations on the command line.
#include "options.hpp"

#include "command_line.hpp"
#include "tube.hpp"
#include "wall.hpp"

namespace examples {

void MethodOptions::add_to(CommandLine& app, bool rigid) {
    const std::string idle = rigid ? "; a rigid body takes one solution in any case" : "";
    app.text("--discretization", discretization,
             "of the meridian: linear, spectral or adaptive (default: " + usual_discretization + ")");
    app.text("--integrator", integrator,
             std::string("euler, order2, order3, or adaptive: third order, and up to sixth for tight tolerances\n"
                         "(default: euler to a stationary state; adaptive where the way matters, and with\n"
                         "--preset-accuracy)") +
                 idle);
    app.text(
        "--stationary", stationary,
        std::string("auto: march in time until the branch is settled, then Newton's method; or march, to the end;\n"
                    "or newton, after a few steps") +
            idle);
    app.text("--preset-accuracy", preset,
             "fast (1e-3), balanced (1e-6) or reference (1e-10): every tolerance and the number of elements" +
                 (preset ? " (default: " + *preset + ")" : std::string()));
    app.flag("--no-referee", no_referee, "go on with numbers that cannot be true (docs/referee.md)");
}

void RunOptions::add_to(CommandLine& app) {
    app.number("--elements", elements,
               "elements, or modes, on the meridian (default: as many as the accuracy takes, 1e-4 without "
               "--preset-accuracy)");
    app.number("--tolerance", tolerance, "stationary when the residual is below this (default: 1e-5)");
    method.add_to(app);
    add_output_to(app);
    app.resumable(directory, checkpoints);
    app.number("--dt", time_step, "fixed time step (default: automatic)");
    app.number("--step-tolerance", step_tolerance,
               "error allowed in a time step, in R0, by integrators that estimate it (default: 1e-4)");
    app.number("--time", time, "stop at this time, stationary or not");
    app.number("--max-steps", steps, "stop after this many steps, stationary or not");
    app.numbers(
        "--frame-times", frame_times,
        "t1,t2,...: also write frames.csv, the shapes at these times (with --dt the first ones at or after them)");
}

void RunOptions::add_output_to(CommandLine& app) {
    app.text("--out", directory, "directory for summary.json, shape.csv and history.csv; created if missing");
    app.flag("--vtk", vtk, "also write surface.vtp, for ParaView");
    app.flag("--flow-field", flow_field, "also write flow.vts, the flow in a plane through the axis");
}

void VesicleOptions::add_to(CommandLine& app) {
    app.number("--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2 (0: a sphere)");
    add_kind_to(app);
}

void VesicleOptions::add_kind_to(CommandLine& app) {
    app.text("--initial", kind, "initial shape: prolate or oblate spheroid");
}

void TubeOptions::add_to(CommandLine& app, const std::string& without) {
    app.number("--confinement", confinement, "R0 over the tube's radius; without it " + without);
}

void WallOptions::add_to(CommandLine& app, bool filon_too) {
    filon_too_ = filon_too;
    const std::string filon = filon_too ? "filon: the same by the paper's quadrature, slow;\n" : "";
    app.text("--method", method,
             "tube: the tube's Green function; " + filon + "wall: the free-space one and a meshed wall");
    app.number("--wall-length", length,
               "with --method wall: length of the wall beyond the particle at either end, in R0 (default: from the "
               "tolerance)");
    app.number("--wall-elements", elements,
               "with --method wall: panels on the wall, without its ends (default: from the tolerance and the "
               "film)");
    app.text("--wall-grading", grading,
             "with --method wall: distribution of the panels, adaptive (to the film), or with "
             "--wall-elements uniform or quadratic");
}

}  // namespace examples
