// SPDX-License-Identifier: MIT
// A vesicle's passage through a narrowing channel.
#pragma once

#include "channel.hpp"
#include "checkpoints.hpp"
#include "method.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace examples {

struct PassageOptions {
    MethodOptions method;
    std::string profile = "constriction";
    double throat = 0.8;
    double wide = 1.5;
    double length = 2;
    double transition = 2;
    double excess_area = 2;
    double flow_rate = 10;
    std::optional<double> wall_tolerance;
    std::optional<double> step_tolerance;
    double displacement = 0.01;
    std::optional<axistokes::Index> elements;
    axistokes::Index most_steps = 5000;
    axistokes::Index frames = 9;
    std::string directory;
    Checkpoints checkpoints;

    PassageOptions() { method.preset = "fast"; }

    void add_to(CommandLine& app);

    double tolerance() const { return wall_tolerance.value_or(method.accuracy()->wall); }

    Channel channel() const {
        if (profile == "pore") {
            return Channel(axistokes::Pore<double>(throat, wide, length, transition));
        }
        return Channel(axistokes::Constriction<double>(throat, wide, transition));
    }

    /// Throws InvalidArgument for a choice that is not offered or makes no sense here.
    void check() const {
        using axistokes::detail::require;
        require(profile == "constriction" || profile == "pore", "profile", profile, "constriction or pore");
        method.check();
        require(!method.newton(), "--stationary", method.stationary, "march: a passage is no stationary state");
        require(flow_rate > 0, "flow rate", flow_rate, "> 0");
        require(frames >= 2, "number of frames", frames, "at least 2");
    }

    nlohmann::ordered_json parameters() const {
        return {{"profile", profile},       {"throat", throat},           {"wide", wide},
                {"length", length},         {"transition", transition},   {"flow_rate", flow_rate},
                {"tolerance", tolerance()}, {"excess_area", excess_area}, {"displacement", displacement}};
    }
};

int pass(const PassageOptions& options);

}  // namespace examples
