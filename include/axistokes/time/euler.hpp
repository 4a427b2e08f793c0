// SPDX-License-Identifier: MIT
// What the integrators built on Euler's step share.
#pragma once

#include "../scene.hpp"

#include <utility>
#include <vector>

namespace axistokes {

/// Result of one step: the displaced bodies, each meridian relative to its moved centroid, with their tensions.
template <class S>
struct Step {
    std::vector<Configuration<S>> bodies;
};

namespace detail {

/// x += dt v, z_c += dt U, v the velocity of the nodes relative to the centroid.
template <class S, class InstantType>
void euler_move(Configuration<S>& now, const InstantType& instant, const S& dt) {
    const Index n = now.shape.nodes();
    now.shape.r += dt * instant.node_velocity.head(n);
    now.shape.z += dt * instant.node_velocity.tail(n);
    now.shape.r[0] = now.shape.r[n - 1] = 0;
    now.position += dt * instant.velocity;
}

/// The same for all bodies; with the tensions that moved them.
template <class S, class Instants>
void euler_move(std::vector<Configuration<S>>& now, const Instants& instants, const S& dt) {
    for (std::size_t b = 0; b < now.size(); ++b) {
        euler_move(now[b], instants[b], dt);
    }
}

template <class S, class Instants>
void take_tensions(std::vector<Configuration<S>>& now, const Instants& instants) {
    for (std::size_t b = 0; b < now.size(); ++b) {
        now[b].tension = instants[b].solution.tension;
    }
}

template <class SceneType, class S>
Step<S> semi_implicit_euler_step(SceneType& scene, const typename SceneType::Moment& start, const S& dt) {
    const auto instants = scene.evaluate(start.frozen, start.bodies, dt);
    Step<S> step{start.bodies};
    euler_move(step.bodies, instants, dt);
    take_tensions(step.bodies, instants);
    return step;
}

}  // namespace detail
}  // namespace axistokes
