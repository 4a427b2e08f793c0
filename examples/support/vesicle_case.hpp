// SPDX-License-Identifier: MIT
// A vesicle to simulate.
#pragma once

#include "options.hpp"
#include "surroundings.hpp"

#include <functional>
#include <vector>

namespace examples {

/// Where a vesicle has come to, and its length on the way.
struct VesicleEnd {
    axistokes::Meridian<double> shape;
    axistokes::Vector<double> tension;  // at the nodes; empty if unknown
    std::vector<double> times;
    std::vector<double> lengths;
};

struct VesicleCase {
    RunOptions run;
    std::function<axistokes::Meridian<double>(axistokes::Index)> initial;  // shape of so many elements
    double excess_area;
    Drive drive;
    Surroundings surroundings;
    double mean_velocity = 0;  // of the undisturbed flow in a tube
    nlohmann::ordered_json parameters;
    /// More keys of the summary.
    std::function<nlohmann::ordered_json(const VesicleEnd&)> details{};
};

int run_vesicle(const VesicleCase& c);

}  // namespace examples
