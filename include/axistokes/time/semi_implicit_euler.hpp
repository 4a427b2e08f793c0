// SPDX-License-Identifier: MIT
// The paper's scheme (a policy for the time integrator; Trozzo et al. 2015, eqs 15-17): the membrane's forces are those
// of x(t + dt) = x + dt u, linearised about the geometry at t, which is frozen.
#pragma once

#include "euler.hpp"

namespace axistokes {

struct SemiImplicitEuler {
    static constexpr int order = 1;

    template <class S, class SceneType>
    auto step(SceneType& scene, const Configuration<S>& start, const S& dt) const {
        return detail::euler_step(scene, start, dt, dt);
    }
};

}  // namespace axistokes
