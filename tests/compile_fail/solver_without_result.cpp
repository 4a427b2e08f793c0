// expect: LinearSolver.*solve
// SPDX-License-Identifier: MIT
// A solver whose solve() returns nothing.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Solver {
    using Scalar = double;
    void factorize(const Matrix<double>&) {}
    void solve(const Vector<double>&) {}
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, RigidBody<>, Gravity<>, Solver>;
