// SPDX-License-Identifier: MIT
// A scene with integrals as coarse as a first guess or a derivative needs them.
#pragma once

#include "../scene.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace axistokes::detail {

/// `part` with integrals as coarse as `tolerance`, if it knows one.
template <class Part, class S>
Part loosened(const Part& part, const S& tolerance) {
    if constexpr (requires {
                      { part.loosened(tolerance) } -> std::same_as<Part>;
                  }) {
        return part.loosened(tolerance);
    } else {
        return part;
    }
}

template <class SceneType, class S>
SceneType loosened_scene(const SceneType& scene, const S& tolerance) {
    SceneType loose(loosened(scene.kernel(), tolerance), loosened(scene.discretization(), tolerance), scene.laws(),
                    scene.flow(), scene.solver(), scene.wall());
    loose.proceed_while(scene.proceed());
    return loose;
}

/// For differences of integrals that are correct to a few digits: the error made is about the step itself.
template <class S>
S coarse_difference_step() {
    using std::sqrt;
    return std::max(S(3e-4), S(sqrt(std::numeric_limits<S>::epsilon())));
}

}  // namespace axistokes::detail
