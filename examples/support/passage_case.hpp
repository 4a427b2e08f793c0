// SPDX-License-Identifier: MIT
// A vesicle's passage through a narrowing channel, and the programs that simulate it: one a discretisation.
#pragma once

#include "method.hpp"
#include <axistokes/wall/profile.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace examples {

/// One of the library's narrowing channels, chosen at run time.
class Channel {
  public:
    using Scalar = double;
    static constexpr bool uniform = false;
    using Choice = std::variant<axistokes::Constriction<double>, axistokes::Pore<double>>;

    explicit Channel(Choice choice) : choice_(std::move(choice)) {}

    double radius(const double& z) const {
        return std::visit([&](const auto& profile) { return profile.radius(z); }, choice_);
    }
    double slope(const double& z) const {
        return std::visit([&](const auto& profile) { return profile.slope(z); }, choice_);
    }
    double begin() const {
        return std::visit([](const auto& profile) { return profile.begin(); }, choice_);
    }
    double end() const {
        return std::visit([](const auto& profile) { return profile.end(); }, choice_);
    }

  private:
    Choice choice_;
};

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

    void add_to(CLI::App& app) {
        app.add_option("--profile", profile, "constriction (smooth) or pore (a straight throat)")
            ->capture_default_str();
        add_number(app, "--throat", throat, "radius of the throat, in R0");
        add_number(app, "--wide", wide, "radius of the channel on either side");
        add_number(app, "--length", length, "length of a pore's throat");
        add_number(app, "--transition", transition, "length of the narrowing, and of the widening behind");
        add_number(app, "--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2");
        add_number(app, "--flow-rate", flow_rate, "flow rate, in R0 kappa/eta, > 0");
        add_number(app, "--tolerance", wall_tolerance, "relative error allowed of the wall (default: 1e-4)");
        add_number(app, "--displacement", displacement,
                   "largest normal displacement in a time step, in R0, by integrators without an error estimate");
        add_number(app, "--step-tolerance", step_tolerance,
                   "error allowed in a time step, in R0, by integrators with one (default: 1e-4)");
        add_number(app, "--elements", elements,
                   "elements, or modes, on the meridian (default: 80, spectral 48; with --preset-accuracy spectral as "
                   "many as it takes)");
        method.add_to(app);
        add_number(app, "--max-steps", most_steps, "give up after this many steps");
        add_number(app, "--frames", frames, "shapes to keep, evenly along the way");
        app.add_option("--out", directory, "directory for summary.json, history.csv, frames.csv and wall.csv");
    }

    double tolerance() const {
        const auto accuracy = method.accuracy();
        return wall_tolerance.value_or(accuracy ? accuracy->wall : 1e-4);
    }

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

int pass_linear(const PassageOptions& options);
int pass_spectral(const PassageOptions& options);

}  // namespace examples
