// expect: WallFor.*confine
// SPDX-License-Identifier: MIT
// A wall that is present but confines nothing.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Wall {
    static constexpr bool present = true;
    double gap(const Point<double>& x) const { return 2 - x.r; }
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, RigidBody<>, Gravity<>, DenseLU<>, Wall>;
