// SPDX-License-Identifier: MIT
// A background of your own: uniaxial extension along the axis.
#pragma once

#include <axistokes/core.hpp>

#include <cmath>

namespace write_your_own {

/// u = (-E r/2, E z), a flow without divergence; E < 0 is biaxial.
template <class S = double>
class UniaxialExtension {
  public:
    using Scalar = S;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;

    explicit UniaxialExtension(S rate) : rate_(rate) {}

    axistokes::Point<S> velocity(const axistokes::Point<S>& x) const { return {-rate_ * x.r / 2, rate_ * x.z}; }
    S normal_load(const axistokes::Point<S>&) const { return S(0); }
    /// At the distance R0 from the stagnation point.
    S velocity_scale() const {
        using std::abs;
        return abs(rate_);
    }

  private:
    S rate_;
};

}  // namespace write_your_own
