// SPDX-License-Identifier: MIT
// Bodies of layers.hpp, for the files that compile them.
#pragma once

#include "layers.hpp"

namespace examples {

template <class D>
axistokes::Matrix<double> Layers<D>::on(const Shape& shape, const OptionalTubeKernel& kernel) const {
    return discretization.single_layer(shape, kernel);
}

template <class D>
axistokes::Matrix<double> Layers<D>::on(const Shape& shape, const Free& kernel) const {
    return discretization.single_layer(shape, kernel);
}

template <class D>
axistokes::Matrix<double> Layers<D>::at(const Shape& targets, const Shape& shape,
                                        const OptionalTubeKernel& kernel) const {
    return discretization.single_layer_at(targets, shape, kernel);
}

template <class D>
axistokes::Matrix<double> Layers<D>::at(const Shape& targets, const Shape& shape, const Free& kernel) const {
    return discretization.single_layer_at(targets, shape, kernel);
}

}  // namespace examples
