// expect: DiscretizationFor.*(same_as|is_same)
// SPDX-License-Identifier: MIT
// A kernel and a discretisation of different scalars.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

using Wrong = Scene<FreeSpaceKernel<float>, LinearElements<double>, RigidBody<>, Gravity<>, DenseLU<>>;
