// expect: KernelWithImages.*gap
// SPDX-License-Identifier: MIT
// A kernel that claims to have images and does not say how far they are.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Kernel : FreeSpaceKernel<> {
    static constexpr bool has_images = true;
};

using Wrong = Scene<Kernel, LinearElements<>, RigidBody<>, Gravity<>, DenseLU<>>;
