// SPDX-License-Identifier: MIT
// Gravity on a particle heavier than the fluid around it (a policy for the background).
#pragma once

#include "../core.hpp"

#include <cmath>

namespace axistokes {

/// Gravity along -z with an interior heavier than the exterior: the pressure jump -B0 z acts on the membrane along its
/// outward normal (Trozzo et al. 2015, eq. 8). Bond number B0 = (rho_in - rho_out) g R0^4 / kappa.
template <class S = double>
class Gravity {
  public:
    using Scalar = S;
    static constexpr bool has_flow = false;
    static constexpr bool has_load = true;

    /// Throws InvalidArgument unless the Bond number is finite (negative: the interior is lighter and rises).
    explicit Gravity(S bond) : bond_(bond) {
        using std::isfinite;
        detail::require(isfinite(bond), "Bond number", bond, "finite");
    }
    Point<S> velocity(const Point<S>&) const { return {}; }
    S normal_load(const Point<S>& x) const { return -bond_ * x.z; }
    /// Settling speed of a rigid sphere.
    S velocity_scale() const {
        using std::abs;
        return abs(bond_) * 2 / 9;
    }

  private:
    S bond_;
};

}  // namespace axistokes
