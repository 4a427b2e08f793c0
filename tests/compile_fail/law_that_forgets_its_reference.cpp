// expect: CarryingLaw|law\.force\(surface, reference\)
// SPDX-License-Identifier: MIT
// An elastic law whose force does not take the reference that it says it carries.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

using namespace axistokes;

struct Elastic {
    using Scalar = double;
    static constexpr Constraint constraint = Constraint::none;
    static constexpr bool conserves_area = false;
    static constexpr bool carries_reference = true;
    template <class Surface>
    Vector<double> force(const Surface&) const;
    template <class Surface>
    typename Surface::Operator linearisation(const Surface&, const Surface&, const Vector<double>&) const;
};

using Wrong = Scene<FreeSpaceKernel<>, LinearElements<>, Elastic, Gravity<>, DenseLU<>>;
