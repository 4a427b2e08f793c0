// SPDX-License-Identifier: MIT
// A heavy vesicle settles and pulls a thin tube out of its rear (Trozzo et al. 2015, Fig. 8).
#include "support/command_line.hpp"
#include "support/neck.hpp"
#include "support/vesicle_case.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace {

/// From when on the height keeps within `share` of its last value, if that is so for the last quarter of the time.
std::optional<double> plateau(const examples::VesicleEnd& end, double share) {
    for (std::size_t i = end.times.size(); i-- > 0;) {
        if (std::abs(end.lengths[i] / end.lengths.back() - 1) > share) {
            const double from = i + 1 < end.times.size() ? end.times[i + 1] : end.times.back();
            return from <= 0.75 * end.times.back() ? std::optional(from) : std::nullopt;
        }
    }
    return std::nullopt;
}

nlohmann::ordered_json describe(const examples::VesicleEnd& end) {
    const auto& shape = end.shape;
    const double top = shape.z[shape.nodes() - 1];
    nlohmann::ordered_json keys{{"height", top - shape.z[0]}, {"tether_length", 0.0}};
    if (const auto neck = examples::tube_neck(shape)) {
        keys["tether_length"] = top - shape.z[*neck];
        keys["tether_radius"] = shape.r[*neck];
        if (end.tension.size() > 0 && end.tension[*neck] > 0) {
            // A tube that bends and is under tension, in equilibrium.
            keys["tether_radius_of_tension"] = 1 / std::sqrt(2 * end.tension[*neck]);
            keys["tether_tension"] = end.tension[*neck];
        }
        const axistokes::Index pearls = examples::pearls_above(shape, *neck, 1.2);
        keys["pearls"] = pearls;
        if (end.tension.size() > 0 && pearls == 0) {
            keys["tension_over_bending"] = examples::tension_over_bending(shape, end.tension, *neck);
        }
    }
    if (const auto time = plateau(end, 0.01)) {
        keys["plateau_time"] = *time;
    }
    return keys;
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "tether",
        "A heavy vesicle settles and pulls a thin tube out of its rear (Fig. 8); until\ntime 20, if no other is given"};
    examples::VesicleOptions vesicle;
    vesicle.excess_area = 0.93;
    examples::RunOptions run;
    run.method.usual_discretization = "adaptive";
    run.method.preset = "fast";
    double bond = 392;
    vesicle.add_to(app);
    app.number("--bond", bond, "Bond number B0 = (rho_in - rho_out) g R0^4 / kappa");
    run.add_to(app);

    return app.run(argc, argv, [&] {
        run.method.check();
        if (!run.time && !run.method.newton()) {
            run.time = 20;
        }
        const auto initial = [&](axistokes::Index elements) { return vesicle.shape(elements); };
        examples::VesicleCase c{
            run, initial, vesicle.excess_area, examples::Drive(axistokes::Gravity<double>(bond)), {}, 0, {}, describe};
        c.parameters = {{"excess_area", vesicle.excess_area}, {"bond", bond}};
        return examples::run_vesicle(c);
    });
}
