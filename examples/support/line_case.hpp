// SPDX-License-Identifier: MIT
// Bodies in line to follow.
#pragma once

#include "options.hpp"
#include "surroundings.hpp"
#include "tube.hpp"

#include <nlohmann/json.hpp>

#include <functional>

namespace examples {

struct LineCase {
    RunOptions run;
    VesicleOptions vesicle;
    bool spheres = false;
    bool dragged = false;  // with velocity 1
    axistokes::Index count = 2;
    double distance = 3;
    axistokes::Index frames = 5;
    std::function<axistokes::Meridian<double>(axistokes::Index)> initial;
    Drive drive{axistokes::Quiescent<double>()};
    Surroundings surroundings;
    double mean_velocity = 0;
    nlohmann::ordered_json parameters;
};

int run_line(const LineCase& c);

}  // namespace examples
