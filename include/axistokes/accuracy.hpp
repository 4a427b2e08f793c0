// SPDX-License-Identifier: MIT
// One relative error for a whole simulation, and what it asks of every policy (docs/accuracy.md).
#pragma once

#include "core.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace axistokes {

/// Parameters for a relative error of about `eps` in the velocity and the length of what a simulation ends with. No
/// tolerance falls below what the type can resolve.
template <class S = double>
struct Accuracy {
    /// That share over the error of velocity and length it goes with, at most (docs/accuracy.md).
    static constexpr double unresolved_to_error = 2;

    S eps;
    /// Of the discretisation's integrals, of the tube's Green function, of a meshed wall.
    S quadrature;
    S kernel;
    S wall;
    /// Error allowed in a time step, in R0: of a run whose path matters (the errors of many steps add up to a few times
    /// this), and of one to a stationary state, whose path does not.
    S step;
    S step_to_stationary;
    /// Residual of a stationary state. Slow modes make its error many times larger than the residual.
    S residual;
    /// Largest SpectralMeridian::unresolved, the share of a shape's last modes in its slope.
    S unresolved;

    /// Throws InvalidArgument unless eps is in [1e-12, 0.1].
    explicit Accuracy(const S& wanted) : eps(wanted) {
        detail::require(wanted >= S(1e-12) && wanted <= S(0.1), "accuracy", wanted, "in [1e-12, 0.1]");
        const S least = 64 * std::numeric_limits<S>::epsilon();
        quadrature = std::max<S>(eps / 10, least);
        kernel = quadrature;
        wall = std::max<S>(eps, least);
        step = std::max<S>(eps / 4, least);
        step_to_stationary = S(1e-3);
        // Four derivatives in the bending force leave round-off of this size at a hundred modes.
        residual = std::max<S>(eps / 100, 7000 * least);
        unresolved = std::max<S>(S(unresolved_to_error) * eps, 1000 * least);
    }

    /// The presets: fast (1e-3), balanced (1e-6), reference (1e-10). Throws InvalidArgument for another name.
    static Accuracy preset(const std::string& name) {
        detail::require(name == "fast" || name == "balanced" || name == "reference", "accuracy preset", name,
                        "fast, balanced or reference");
        return Accuracy(name == "fast" ? S(1e-3) : name == "balanced" ? S(1e-6) : S(1e-10));
    }
};

}  // namespace axistokes
