// SPDX-License-Identifier: MIT
// The paper's scheme (a policy for the time integrator; Trozzo et al. 2015, eqs 15-17): the membrane's forces are those
// of x(t + dt) = x + dt u, linearised about the geometry at t, which is frozen.
#pragma once

#include "euler.hpp"

namespace axistokes {

struct SemiImplicitEuler {
    static constexpr int order = 1;

    template <class SceneType, class S>
    Step<S> step(SceneType& scene, const typename SceneType::Moment& start, const S& dt) const {
        return detail::semi_implicit_euler_step(scene, start, dt);
    }
};

}  // namespace axistokes
