// expect: TimeIntegratorFor.*order
// SPDX-License-Identifier: MIT
// A time integrator that does not tell its order.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/euler.hpp>

using namespace axistokes;

struct Integrator {
    template <class SceneType, class S>
    Step<S> step(SceneType&, const typename SceneType::Moment& start, const S&) const {
        return {start.bodies};
    }
};

using Wrong = Simulator<FreeSpaceKernel<>, LinearElements<>, RigidBody<>, Gravity<>, Integrator, DenseLU<>>;
