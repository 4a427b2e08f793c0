// SPDX-License-Identifier: MIT
// What the two first-order integrators share.
#pragma once

#include "../scene.hpp"

namespace axistokes {

/// Result of one step: the displaced meridian, relative to the moved centroid, and the instant that displaced it.
template <class S, class InstantType>
struct Step {
    Meridian<S> shape;
    S displacement{};  // of the centroid in the laboratory frame
    InstantType instant;
};

namespace detail {

template <class S, class SceneType>
Step<S, typename SceneType::InstantType> euler_step(SceneType& scene, const Configuration<S>& start, const S& dt,
                                                    const S& implicit_time) {
    const Index n = start.shape.nodes();
    auto instant = scene.evaluate(start, implicit_time);
    const Vector<S>& u = instant.solution.velocity;
    Meridian<S> shape = start.shape;
    shape.r += dt * u.head(n);
    shape.z += dt * (u.tail(n).array() - instant.velocity).matrix();
    shape.r[0] = shape.r[n - 1] = 0;
    const S displacement = dt * instant.velocity;
    return {std::move(shape), displacement, std::move(instant)};
}

}  // namespace detail
}  // namespace axistokes
