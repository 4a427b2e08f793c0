// expect: UsesScalarOf.*Vesicle<float>
// SPDX-License-Identifier: MIT
// A law of another scalar than the kernel.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, Vesicle<float>, Gravity<>, DenseLU<>>;
