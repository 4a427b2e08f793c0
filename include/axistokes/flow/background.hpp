// SPDX-License-Identifier: MIT
// What drives a scene (policies for the background): nothing, gravity, an imposed flow, or a sum of two of them.
#pragma once

#include "../core.hpp"

#include <algorithm>
#include <cmath>

namespace axistokes {

/// Fluid at rest, no body force.
template <class S = double>
struct Quiescent {
    using Scalar = S;
    static constexpr bool has_flow = false;
    static constexpr bool has_load = false;

    Point<S> velocity(const Point<S>&) const { return {}; }
    S normal_load(const Point<S>&) const { return S(0); }
    S velocity_scale() const { return S(0); }
};

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

/// Two backgrounds at once.
template <class First, class Second>
class Sum {
  public:
    using Scalar = typename First::Scalar;
    static constexpr bool has_flow = First::has_flow || Second::has_flow;
    static constexpr bool has_load = First::has_load || Second::has_load;

    Sum(First first, Second second) : first_(first), second_(second) {}
    Point<Scalar> velocity(const Point<Scalar>& x) const {
        const Point<Scalar> a = first_.velocity(x);
        const Point<Scalar> b = second_.velocity(x);
        return {a.r + b.r, a.z + b.z};
    }
    Scalar normal_load(const Point<Scalar>& x) const { return first_.normal_load(x) + second_.normal_load(x); }
    Scalar velocity_scale() const { return std::max(first_.velocity_scale(), second_.velocity_scale()); }

  private:
    First first_;
    Second second_;
};

}  // namespace axistokes
