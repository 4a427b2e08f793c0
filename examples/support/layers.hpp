// SPDX-License-Identifier: MIT
// The single layers of both discretisations, each compiled in a file of its own.
#pragma once

#include "any_discretization.hpp"

namespace examples {

template <class Discretization>
struct Layers {
    using Shape = axistokes::Meridian<double>;
    using Matrix = axistokes::Matrix<double>;
    using Free = axistokes::FreeSpaceKernel<double>;

    const Discretization& discretization;

    Matrix on(const Shape& shape, const OptionalTubeKernel& kernel) const;
    Matrix on(const Shape& shape, const Free& kernel) const;
    Matrix at(const Shape& targets, const Shape& shape, const OptionalTubeKernel& kernel) const;
    Matrix at(const Shape& targets, const Shape& shape, const Free& kernel) const;
};

}  // namespace examples
