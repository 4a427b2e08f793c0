// SPDX-License-Identifier: MIT
// The policy for a scene whose only walls, if any, are those of its kernel.
#pragma once

#include "../geometry/meridian.hpp"

#include <limits>
#include <vector>

namespace axistokes {

struct NoWall {
    static constexpr bool present = false;

    template <class Discretization, class Kernel, class S>
    Vector<S> confine(const Discretization&, const Kernel&, const std::vector<Meridian<S>>&, Matrix<S>&,
                      Vector<S>&) const {
        return {};
    }
    template <class S>
    S gap(const Point<S>&) const {
        return std::numeric_limits<S>::infinity();
    }
    int velocity_scale() const { return 0; }
    template <class S>
    S centreline_velocity(const S&) const {
        return S(0);
    }
};

}  // namespace axistokes
