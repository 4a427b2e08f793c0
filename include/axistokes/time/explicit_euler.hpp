// SPDX-License-Identifier: MIT
// Forward Euler (a policy for the time integrator): x(t + dt) = x + dt u(x). A baseline: bending makes the problem
// stiff, and the step must stay below a multiple of h^3 (docs/time_stepping.md).
#pragma once

#include "euler.hpp"

namespace axistokes {

struct ExplicitEuler {
    static constexpr int order = 1;

    template <class SceneType, class S>
    Step<S> step(SceneType&, const typename SceneType::Moment& start, const S& dt) const {
        Step<S> step{start.bodies};
        detail::euler_move(step.bodies, start.instants, dt);
        detail::take_tensions(step.bodies, start.instants);
        return step;
    }
};

}  // namespace axistokes
