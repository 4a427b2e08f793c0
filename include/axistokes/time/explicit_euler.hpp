// SPDX-License-Identifier: MIT
// Forward Euler (a policy for the time integrator): x(t + dt) = x + dt u(x). A baseline: bending makes the problem
// stiff, and the step must stay below a multiple of h^3 (docs/time_stepping.md).
#pragma once

#include "euler.hpp"

namespace axistokes {

struct ExplicitEuler {
    static constexpr int order = 1;

    template <class S, class SceneType>
    auto step(SceneType& scene, const Configuration<S>& start, const S& dt) const {
        return detail::euler_step(scene, start, dt, S(0));
    }
};

}  // namespace axistokes
