// SPDX-License-Identifier: MIT
// The parabolic flow in the middle of a wide tube (a policy for the background).
#pragma once

#include "../core.hpp"

#include <cmath>

namespace axistokes {

/// u_z = centreline - Ca r^2, the flow in the middle of a wide tube. Ca is the unbounded capillary number
/// eta u'' R0^4 / kappa; velocities are in kappa/(eta R0^2).
template <class S = double>
class UnboundedPoiseuille {
  public:
    using Scalar = S;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;

    /// Throws InvalidArgument unless both arguments are finite.
    explicit UnboundedPoiseuille(S capillary_number, S centreline_velocity = S(0))
        : capillary_number_(capillary_number), centreline_velocity_(centreline_velocity) {
        using std::isfinite;
        detail::require(isfinite(capillary_number), "unbounded capillary number", capillary_number, "finite");
        detail::require(isfinite(centreline_velocity), "centreline velocity", centreline_velocity, "finite");
    }
    Point<S> velocity(const Point<S>& x) const { return {S(0), centreline_velocity_ - capillary_number_ * x.r * x.r}; }
    S normal_load(const Point<S>&) const { return S(0); }
    S velocity_scale() const {
        using std::abs;
        return abs(capillary_number_);
    }

  private:
    S capillary_number_;
    S centreline_velocity_;
};

}  // namespace axistokes
