// SPDX-License-Identifier: MIT
// A vesicle in a fluid at rest relaxes to a minimum of its bending energy.
#include "support/command_line.hpp"
#include "support/vesicle_case.hpp"

#include <cmath>
#include <numbers>

int main(int argc, char** argv) {
    using axistokes::detail::require;
    examples::CommandLine app{
        "relaxing_vesicle",
        "An axisymmetric vesicle relaxes, without flow, to the shape of least bending energy near its own"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    double reduced_volume = 0.8;
    vesicle.add_kind_to(app);
    examples::Option by_volume =
        app.number("--reduced-volume", reduced_volume, "volume over that of the sphere of equal area");
    examples::Option by_area = app.number("--excess-area", vesicle.excess_area, "instead: area minus 4 pi, in R0^2");
    by_area.excludes(by_volume).without_default();
    run.add_to(app);

    return app.run(argc, argv, [&] {
        run.method.check();
        if (!by_area.given()) {
            require(reduced_volume > 0 && reduced_volume <= 1, "reduced volume", reduced_volume, "in (0, 1]");
            vesicle.excess_area = 4 * std::numbers::pi * (std::pow(reduced_volume, -2.0 / 3) - 1);
        }
        const auto initial = [&](axistokes::Index elements) { return vesicle.shape(elements); };
        examples::VesicleCase c{run, initial, vesicle.excess_area, examples::Drive(axistokes::Quiescent<double>{}), {},
                                0,   {}};
        c.parameters = {{"excess_area", vesicle.excess_area}, {"initial", vesicle.kind}};
        return examples::run_vesicle(c);
    });
}
