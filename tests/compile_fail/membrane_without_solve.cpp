// expect: MembraneFor.*solve
// SPDX-License-Identifier: MIT
// A membrane that solves nothing.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Membrane {
    using Scalar = double;
    static constexpr bool deformable = false;
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, Membrane, Gravity<>, DenseLU<>>;
