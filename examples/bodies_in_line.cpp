// SPDX-License-Identifier: MIT
// Spheres or vesicles in line along the axis: settling, in a Poiseuille flow or, spheres, dragged with equal
// velocities; in an unbounded fluid or in a tube.
#include "support/command_line.hpp"
#include "support/line_case.hpp"

int main(int argc, char** argv) {
    examples::CommandLine app{"bodies_in_line", "Equal bodies in line along the axis of an unbounded fluid or a tube"};
    examples::LineCase c;
    std::string kind = "vesicle";
    examples::TubeOptions tube;
    double bond = 0;
    double capillary_number = 0;
    double unbounded_capillary_number = 0;
    std::optional<double> time;
    app.text("--kind", kind, "sphere (rigid) or vesicle");
    app.number("--count", c.count, "number of bodies");
    app.number("--distance", c.distance, "from centre to centre, in R0");
    c.vesicle.add_to(app);
    tube.add_to(app, "the fluid is unbounded");
    examples::Option by_bond = app.number("--bond", bond, "Bond number: the bodies settle along -z");
    examples::Option bounded = app.number("--capillary-number", capillary_number,
                                          "Ca of the Poiseuille flow in the tube (with --confinement)");
    examples::Option unbounded = app.number("--unbounded-capillary-number", unbounded_capillary_number,
                                            "Ca_unb of the flow -c r^2 without walls");
    by_bond.excludes(bounded).excludes(unbounded);
    bounded.excludes(unbounded).needs("--confinement");
    unbounded.excludes("--confinement");
    app.number("--elements", c.run.elements,
               "elements, or modes, on each meridian (default: as many as the accuracy takes)");
    app.number("--time", time,
               "how long to follow the bodies (default: vesicles 1, unless --stationary is given; spheres 0)");
    app.number("--step-tolerance", c.run.step_tolerance, "error allowed in a time step, in R0");
    app.number("--max-steps", c.run.steps, "stop after this many steps");
    app.number("--frames", c.frames, "shapes kept in frames.csv, equally spaced in time");
    c.run.method.add_to(app);
    c.run.add_output_to(app);
    app.resumable(c.run.directory, c.run.checkpoints);

    return app.run(argc, argv, [&] {
        using axistokes::detail::require;
        require(kind == "sphere" || kind == "vesicle", "kind", kind, "sphere or vesicle");
        require(c.count >= 1 && c.count <= 100, "count", c.count, "in [1, 100]");
        require(c.distance > 0 && std::isfinite(c.distance), "distance", c.distance, "> 0 and finite");
        require(c.frames >= 2 && c.frames <= 1000, "frames", c.frames, "in [2, 1000]");
        c.spheres = kind == "sphere";
        for (const char* shape : {"--excess-area", "--initial"}) {
            require(!c.spheres || !app.given(shape), shape, "given", "absent with --kind sphere");
        }
        c.run.method.check();
        const bool stationary = app.given("--stationary");
        require(!stationary || !c.spheres, "--stationary", "given", "absent with --kind sphere");
        require(!stationary || !time, "--stationary", "given", "absent with --time");
        if (time) {
            require(*time >= 0 && std::isfinite(*time), "--time", *time, ">= 0 and finite");
        }
        const double duration = time.value_or(c.spheres ? 0.0 : 1.0);
        require(c.spheres || duration > 0, "--time", duration, "> 0 for vesicles");
        if (duration > 0 && !stationary) {
            c.run.time = duration;
        }
        if (tube.confinement) {
            c.surroundings.tube_radius = tube.radius();
        }
        c.dragged = c.spheres && !by_bond.given() && !bounded.given() && !unbounded.given();
        if (by_bond.given()) {
            c.drive = examples::Drive(axistokes::Gravity<double>(bond));
        } else if (bounded.given()) {
            const axistokes::Poiseuille<double> flow(capillary_number, tube.radius());
            c.drive = examples::Drive(flow);
            c.mean_velocity = flow.mean_velocity();
        } else if (unbounded.given()) {
            c.drive = examples::Drive(axistokes::UnboundedPoiseuille<double>(unbounded_capillary_number));
        }
        const auto shape = [&](axistokes::Index elements) {
            return c.spheres          ? axistokes::sphere<double>(elements)
                   : tube.confinement ? tube.shape(c.vesicle, elements)
                                      : c.vesicle.shape(elements);
        };
        c.initial = shape;
        c.parameters = {{"kind", kind}, {"count", c.count}, {"distance", c.distance}};
        if (!c.spheres) {
            c.parameters["excess_area"] = c.vesicle.excess_area;
            c.parameters["initial"] = c.vesicle.kind;
        }
        if (tube.confinement) {
            c.parameters["confinement"] = *tube.confinement;
        }
        if (by_bond.given()) {
            c.parameters["bond"] = bond;
        } else if (bounded.given()) {
            c.parameters["capillary_number"] = capillary_number;
        } else if (unbounded.given()) {
            c.parameters["unbounded_capillary_number"] = unbounded_capillary_number;
        }
        if (!stationary) {
            c.parameters["time"] = duration;
        }
        return examples::run_line(c);
    });
}
