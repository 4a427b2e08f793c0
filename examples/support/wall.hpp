// SPDX-License-Identifier: MIT
// What simulations in a tube by either method share: the tube's Green function, or a mesh on its wall.
#pragma once

#include "program.hpp"
#include <axistokes/wall/wall_params.hpp>

#include <optional>
#include <string>

namespace examples {

struct WallOptions {
    std::string method = "tube";
    std::optional<double> length;
    std::optional<axistokes::Index> elements;
    std::string grading = "adaptive";

    /// `filon_too`: offer the slow quadrature of the tube's Green function as well.
    void add_to(CLI::App& app, bool filon_too = false) {
        filon_too_ = filon_too;
        const std::string filon = filon_too ? "filon: the same by the paper's quadrature, slow;\n" : "";
        app.add_option("--method", method,
                       "tube: the tube's Green function; " + filon + "wall: the free-space one and a meshed wall")
            ->capture_default_str();
        add_number(app, "--wall-length", length,
                   "with --method wall: length of the wall beyond the particle at either end, in R0 (default: from the "
                   "tolerance)");
        add_number(app, "--wall-elements", elements,
                   "with --method wall: panels on the wall, without its ends (default: from the tolerance and the "
                   "film)");
        app.add_option("--wall-grading", grading,
                       "with --method wall: distribution of the panels, adaptive (to the film), or with "
                       "--wall-elements uniform or quadratic")
            ->capture_default_str();
    }

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
