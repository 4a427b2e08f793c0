// SPDX-License-Identifier: MIT
// A rigid body whose motion is to be found.
#pragma once

#include "options.hpp"
#include "surroundings.hpp"

#include <functional>

namespace examples {

/// What is known of a body that moves: at the nodes and in total.
struct BodyMotion {
    axistokes::Meridian<double> nodes;
    axistokes::Vector<double> weight;
    axistokes::Vector<double> force;  // density, stacked [r; z]
    double velocity;
};

struct BodyCase {
    RunOptions run;
    std::function<axistokes::Meridian<double>(axistokes::Index)> shape;  // of so many elements, where they belong
    axistokes::Index elements;                                           // unless they follow from the accuracy
    double tolerance;                                                    // of integrals and of the tube kernel
    Drive drive;
    Surroundings surroundings;
    double mean_velocity = 0;                                          // of the undisturbed flow in a tube
    std::function<nlohmann::ordered_json(const BodyMotion&)> details;  // further keys of the summary
    nlohmann::ordered_json parameters;
};

int run_body(const BodyCase& c);

}  // namespace examples
