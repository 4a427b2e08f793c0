// expect: LawFor.*force
// SPDX-License-Identifier: MIT
// A law that does not say what force its interface exerts.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Law {
    using Scalar = double;
    static constexpr Constraint constraint = Constraint::none;
    static constexpr bool conserves_area = false;
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, Law, Gravity<>, DenseLU<>>;
