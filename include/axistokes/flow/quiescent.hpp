// SPDX-License-Identifier: MIT
// No flow and no body force (a policy for the background).
#pragma once

#include "../core.hpp"

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

}  // namespace axistokes
