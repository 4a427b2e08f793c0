// SPDX-License-Identifier: MIT
// Sum of two backgrounds (a policy for the background).
#pragma once

#include "../core.hpp"

#include <algorithm>

namespace axistokes {

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
