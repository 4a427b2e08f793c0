// SPDX-License-Identifier: MIT
// A scene with integrals as coarse as a first guess needs them.
#pragma once

#include "../scene.hpp"

#include <concepts>

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

}  // namespace axistokes::detail
