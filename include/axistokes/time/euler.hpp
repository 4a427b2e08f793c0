// SPDX-License-Identifier: MIT
// What the integrators built on Euler's step share.
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

/// x += dt (u - U e_z), z_c += dt U.
template <class S, class InstantType>
void euler_move(Configuration<S>& now, const InstantType& instant, const S& dt) {
    const Index n = now.shape.nodes();
    const Vector<S>& u = instant.solution.velocity;
    now.shape.r += dt * u.head(n);
    now.shape.z += dt * (u.tail(n).array() - instant.velocity).matrix();
    now.shape.r[0] = now.shape.r[n - 1] = 0;
    now.position += dt * instant.velocity;
}

template <class S, class SceneType>
Step<S, typename SceneType::InstantType> euler_step(SceneType& scene, const Configuration<S>& start, const S& dt,
                                                    const S& implicit_time) {
    auto instant = scene.evaluate(start, implicit_time);
    Configuration<S> end = start;
    euler_move(end, instant, dt);
    const S displacement = dt * instant.velocity;
    return {std::move(end.shape), displacement, std::move(instant)};
}

}  // namespace detail
}  // namespace axistokes
