// SPDX-License-Identifier: MIT
// A vesicle to simulate.
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

int run_vesicle(const VesicleCase& c);

}  // namespace examples
