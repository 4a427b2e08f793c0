// SPDX-License-Identifier: MIT
// Bodies of Compiled, for the files that compile them.
#pragma once

#include "compiled.hpp"

namespace examples {

template <class D>
typename D::Surface Compiled<D>::surface(const Shape& meridian, axistokes::SurfaceParts parts) const {
    return D::surface(meridian, parts);
}

template <class D>
axistokes::Matrix<double> Compiled<D>::single_layer(const Shape& meridian, const OptionalTubeKernel& kernel) const {
    return D::single_layer(meridian, kernel);
}

template <class D>
axistokes::Matrix<double> Compiled<D>::single_layer(const Shape& meridian, const Free& kernel) const {
    return D::single_layer(meridian, kernel);
}

template <class D>
axistokes::Matrix<double> Compiled<D>::single_layer_at(const Shape& targets, const Shape& meridian,
                                                       const OptionalTubeKernel& kernel) const {
    return D::single_layer_at(targets, meridian, kernel);
}

template <class D>
axistokes::Matrix<double> Compiled<D>::single_layer_at(const Shape& targets, const Shape& meridian,
                                                       const Free& kernel) const {
    return D::single_layer_at(targets, meridian, kernel);
}

}  // namespace examples
