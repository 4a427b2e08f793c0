// SPDX-License-Identifier: MIT
// A vesicle to simulate, and the programs that do: one a discretisation and kind of wall, each compiled by itself.
#pragma once

#include "options.hpp"
#include "surroundings.hpp"

#include <functional>

namespace examples {

struct VesicleCase {
    RunOptions run;
    std::function<axistokes::Meridian<double>(axistokes::Index)> initial;  // shape of so many elements
    double excess_area;
    Drive drive;
    Surroundings surroundings;
    double mean_velocity = 0;  // of the undisturbed flow in a tube
    nlohmann::ordered_json parameters;
};

int run_linear(const VesicleCase& c);
int run_spectral(const VesicleCase& c);
int run_linear_in_mesh(const VesicleCase& c);
int run_spectral_in_mesh(const VesicleCase& c);

/// Without a meshed wall.
inline int run_vesicle(const VesicleCase& c) {
    return c.run.method.spectral() ? run_spectral(c) : run_linear(c);
}
inline int run_vesicle_in_mesh(const VesicleCase& c) {
    return c.run.method.spectral() ? run_spectral_in_mesh(c) : run_linear_in_mesh(c);
}

}  // namespace examples
