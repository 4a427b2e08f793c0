// expect: a law that carries a reference has no StationarySolver
// SPDX-License-Identifier: MIT
// Newton's method for a law with memory.
#include "../../examples/write_your_own/capsule.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>

using namespace axistokes;

using Elastic = Scene<FreeSpaceKernel<>, LinearElements<>, write_your_own::Capsule<>, Gravity<>, DenseLU<>>;
const StationarySolver<Elastic>* wrong = nullptr;
const auto size = sizeof(*wrong);
