// expect: UsesScalarOf.*DenseLU<float>
// SPDX-License-Identifier: MIT
// A solver of another scalar than the kernel.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, RigidBody<>, Gravity<>, DenseLU<float>>;
