// SPDX-License-Identifier: MIT
// What simulations in a tube by either method share: the tube's Green function, or a mesh on its wall.
#pragma once

#include <axistokes/wall/wall_params.hpp>

#include <optional>
#include <string>

namespace examples {

class CommandLine;

struct WallOptions {
    std::string method = "tube";
    std::optional<double> length;
    std::optional<axistokes::Index> elements;
    std::string grading = "adaptive";

    /// `filon_too`: offer the slow quadrature of the tube's Green function as well.
    void add_to(CommandLine& app, bool filon_too = false);

    /// Whether the wall is to be meshed. Throws InvalidArgument for an unknown method.
    bool meshed() const {
        const bool filon = filon_too_ && method == "filon";
        axistokes::detail::require(method == "tube" || method == "wall" || filon, "method", method,
                                   filon_too_ ? "tube, filon or wall" : "tube or wall");
        if (method != "wall") {
            const char* needed = "given only with --method wall";
            axistokes::detail::require(!length, "wall length", length.value_or(0), needed);
            axistokes::detail::require(!elements, "number of wall elements", elements.value_or(0), needed);
            axistokes::detail::require(grading == "adaptive", "wall grading", grading, needed);
        }
        return method == "wall";
    }

    axistokes::WallMeshParams<double> params(double tolerance) const {
        axistokes::detail::require(grading == "adaptive" || grading == "uniform" || grading == "quadratic",
                                   "wall grading", grading, "adaptive, uniform or quadratic");
        axistokes::detail::require(grading == "adaptive" || elements.has_value(), "wall grading", grading,
                                   "given together with --wall-elements, unless it is adaptive");
        axistokes::detail::require(elements.value_or(2) <= 1000, "number of wall elements", elements.value_or(2),
                                   "at most 1000 (the matrices are dense)");
        axistokes::WallMeshParams<double> params;
        params.tolerance = tolerance;
        params.length = length;
        params.panels = elements;
        params.grading = grading == "uniform"     ? axistokes::WallGrading::uniform
                         : grading == "quadratic" ? axistokes::WallGrading::quadratic
                                                  : axistokes::WallGrading::automatic;
        return params;
    }

  private:
    bool filon_too_ = false;
};

}  // namespace examples
