// expect: GreenKernel.*singular_split
// SPDX-License-Identifier: MIT
// A kernel without the logarithmic split.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Kernel {
    using Scalar = double;
    static constexpr bool has_images = false;
    static constexpr bool laboratory_frame = false;
    void singular(Point<double>, const double*, const double*, Index, KernelArrays<double>) const {}
};

using Wrong = Scene<Kernel, LinearElements<>, RigidBody<>, Gravity<>, DenseLU<>>;
