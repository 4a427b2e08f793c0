// SPDX-License-Identifier: MIT
// A time integrator of your own: the explicit midpoint rule, x(t + dt) = x + dt u(x + (dt/2) u(x)).
#pragma once

#include <axistokes/time/euler.hpp>

namespace write_your_own {

struct ExplicitMidpoint {
    static constexpr int order = 2;

    /// The velocities at the start are known; one more evaluation.
    template <class Scene, class S>
    axistokes::Step<S> step(Scene& scene, const typename Scene::Moment& start, const S& dt) const {
        const auto middle = moved(start.bodies, start.instants, S(dt / 2));
        return {moved(start.bodies, scene.evaluate(middle, S(0)), dt)};
    }

  private:
    /// All bodies displaced by dt v. A meridian is relative to its centroid, which moves with the velocity U, and so is
    /// the velocity v of its nodes: x += dt v, z_c += dt U.
    template <class S, class Instants>
    static std::vector<axistokes::Configuration<S>> moved(std::vector<axistokes::Configuration<S>> bodies,
                                                          const Instants& instants, const S& dt) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            axistokes::Configuration<S>& body = bodies[b];
            const axistokes::Index n = body.shape.nodes();
            body.shape.r += dt * instants[b].node_velocity.head(n);
            body.shape.z += dt * instants[b].node_velocity.tail(n);
            // The poles stay on the axis, to the last digit.
            body.shape.r[0] = body.shape.r[n - 1] = 0;
            body.position += dt * instants[b].velocity;
        }
        return bodies;
    }
};

}  // namespace write_your_own
