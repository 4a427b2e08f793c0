// SPDX-License-Identifier: MIT
// What can be chosen of a wall's mesh; the defaults follow from one tolerance.
#pragma once

#include "../core.hpp"

#include <cmath>
#include <optional>

namespace axistokes {

/// How the wall's panels are distributed along z: as the particle's distance and the wall's radius ask for, equal, or
/// as the square of the distance from the particle (Trozzo et al. 2015, section 3.2.2).
enum class WallGrading { automatic, uniform, quadratic };

template <class S>
struct WallMeshParams {
    /// Of the channel's flow, in R0^2 kappa/(eta R0^2). Leave it at 0 if the flow is the scene's background; that one
    /// must vanish on the wall then.
    S flow_rate = S(0);
    /// Relative error wanted of the particle's velocity and tractions, in [eps, 0.1].
    S tolerance = S(1e-5);
    /// Length of the wall beyond the particle and the profile's range at either end; default: from the tolerance.
    std::optional<S> length;
    /// Panels on the wall, without the ends; default: from the tolerance and the particle's distance.
    std::optional<Index> panels;
    std::optional<Index> nodes_per_panel;
    WallGrading grading = WallGrading::automatic;
};

namespace detail {

/// The slowest axisymmetric perturbation of Poiseuille flow decays like exp(-decay |z|/Rc): real part of the first root
/// with positive real part of J0(k)^2 + J1(k)^2 = 2 J0(k) J1(k)/k.
inline constexpr double tube_decay = 4.46630;

template <class S>
void validate(const WallMeshParams<S>& p) {
    using std::isfinite;
    require(isfinite(p.flow_rate), "flow rate", p.flow_rate, "finite");
    require_tolerance("wall tolerance", p.tolerance);
    if (p.length) {
        require_length("wall length", *p.length);
    }
    if (p.panels) {
        require(*p.panels >= 2, "number of wall panels", *p.panels, "at least 2");
    }
    if (p.nodes_per_panel) {
        require(*p.nodes_per_panel >= 2, "nodes per panel", *p.nodes_per_panel, "at least 2");
    }
    require(p.grading == WallGrading::automatic || p.panels.has_value(), "number of wall panels", 0,
            "given for a uniform or a quadratic grading");
}

}  // namespace detail

}  // namespace axistokes
