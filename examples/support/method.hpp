// SPDX-License-Identifier: MIT
// How accurately and by which numerical methods a simulation runs: options common to the examples.
#pragma once

#include <axistokes/accuracy.hpp>
#include <axistokes/accuracy/driver_params.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace examples {

class CommandLine;

/// The library's discretisations.
enum class DiscretizationKind { linear, spectral, adaptive };

struct MethodOptions {
    std::optional<std::string> discretization;
    std::optional<std::string> integrator;
    /// Without --discretization.
    std::string usual_discretization = "spectral";
    /// Without --integrator and --preset-accuracy.
    std::string usual_integrator = "euler";
    std::string stationary = "auto";
    std::optional<std::string> preset;
    bool no_referee = false;

    /// `rigid`: the integrator and the way to the stationary state are accepted, and make no difference.
    void add_to(CommandLine& app, bool rigid = false);

    /// Throws InvalidArgument for a value that is none of those offered.
    void check() const {
        using axistokes::detail::require;
        if (discretization) {
            require(*discretization == "linear" || *discretization == "spectral" || *discretization == "adaptive",
                    "--discretization", *discretization, "linear, spectral or adaptive");
        }
        if (integrator) {
            require(*integrator == "euler" || *integrator == "order2" || *integrator == "order3" ||
                        *integrator == "adaptive",
                    "--integrator", *integrator, "euler, order2, order3 or adaptive");
        }
        require(stationary == "auto" || stationary == "march" || stationary == "newton", "--stationary", stationary,
                "auto, march or newton");
        if (preset) {
            require(*preset == "fast" || *preset == "balanced" || *preset == "reference", "--preset-accuracy", *preset,
                    "fast, balanced or reference");
        }
    }

    std::string discretization_name() const { return discretization.value_or(usual_discretization); }
    DiscretizationKind kind() const {
        const std::string name = discretization_name();
        return name == "linear"     ? DiscretizationKind::linear
               : name == "spectral" ? DiscretizationKind::spectral
                                    : DiscretizationKind::adaptive;
    }
    bool high_order() const { return kind() != DiscretizationKind::linear; }
    bool newton() const { return stationary == "newton"; }
    axistokes::WayToStationary way() const {
        return newton()                ? axistokes::WayToStationary::newton
               : stationary == "march" ? axistokes::WayToStationary::march
                                       : axistokes::WayToStationary::automatic;
    }
    std::string integrator_name() const { return integrator.value_or(preset ? "adaptive" : usual_integrator); }

    /// `tolerance`: the error allowed in a step.
    axistokes::ExtrapolatedEulerOfOrder steps(double tolerance) const {
        const std::string name = integrator_name();
        if (name == "adaptive") {
            return axistokes::ExtrapolatedEulerOfOrder::for_tolerance(tolerance);
        }
        return axistokes::ExtrapolatedEulerOfOrder(name == "euler" ? 1 : name == "order2" ? 2 : 3);
    }

    std::optional<axistokes::Accuracy<double>> accuracy() const {
        return preset ? std::optional(axistokes::Accuracy<double>::preset(*preset)) : std::nullopt;
    }

    void describe(nlohmann::ordered_json& summary) const {
        summary["discretization"] = discretization_name();
        summary["integrator"] = integrator_name();
        if (preset) {
            summary["preset_accuracy"] = *preset;
        }
    }
};

}  // namespace examples
