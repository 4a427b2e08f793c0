// SPDX-License-Identifier: MIT
// Flow through a tube (a policy for the background).
#pragma once

#include "../core.hpp"

#include <cmath>

namespace axistokes {

/// u_z = Ca (1 - (r/Rc)^2), the undisturbed flow in a tube of radius Rc (in R0). Its peak velocity in units of
/// kappa/(eta R0^2) is the bending capillary number Ca = eta u_P R0^2/kappa (Trozzo et al. 2015, eqs 47, 49).
template <class S = double>
class Poiseuille {
  public:
    using Scalar = S;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;

    /// Throws InvalidArgument unless the capillary number is finite and the tube radius positive and finite.
    Poiseuille(S capillary_number, S tube_radius) : capillary_number_(capillary_number), tube_radius_(tube_radius) {
        using std::isfinite;
        detail::require(isfinite(capillary_number), "capillary number", capillary_number, "finite");
        detail::require_length("tube radius", tube_radius);
    }
    /// In the tube of a kernel, or of a wall that is one.
    template <HasGap<S> Tube>
    Poiseuille(S capillary_number, const Tube& tube) : Poiseuille(capillary_number, S(tube.gap({S(0), S(0)}))) {}

    Point<S> velocity(const Point<S>& x) const {
        return {S(0),
                capillary_number_ * ((tube_radius_ - x.r) * (tube_radius_ + x.r) / (tube_radius_ * tube_radius_))};
    }
    S normal_load(const Point<S>&) const { return S(0); }
    S velocity_scale() const {
        using std::abs;
        return abs(capillary_number_);
    }
    S mean_velocity() const { return capillary_number_ / 2; }

  private:
    S capillary_number_;
    S tube_radius_;
};

}  // namespace axistokes
