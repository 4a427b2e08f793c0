// expect: Background.*normal_load
// SPDX-License-Identifier: MIT
// A background that does not say what it loads the membrane with.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Flow {
    using Scalar = double;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;
    Point<double> velocity(const Point<double>&) const { return {}; }
    double velocity_scale() const { return 1; }
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, RigidBody<>, Flow, DenseLU<>>;
