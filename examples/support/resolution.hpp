// SPDX-License-Identifier: MIT
// How many elements an accuracy takes.
#pragma once

#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace examples {

/// A discretisation that tells from one shape whether it is resolved.
template <class Discretization>
constexpr bool judges_itself = requires(const Discretization& d, const axistokes::Meridian<double>& shape) {
    { d.unresolved(shape) } -> std::convertible_to<double>;
};

/// First and largest number of elements that are tried.
template <class Discretization>
constexpr axistokes::Index first_elements = judges_itself<Discretization> ? 16 : 32;
template <class Discretization>
constexpr axistokes::Index most_elements = judges_itself<Discretization> ? 160 : 256;

/// The next number of modes when the share `now` of the last ones is to fall to `wanted`: they decay geometrically.
inline axistokes::Index more_modes(axistokes::Index elements, double now, double wanted, axistokes::Index most) {
    const double n = static_cast<double>(elements);
    const double needed = n * std::log(wanted / 3) / std::log(std::min(now, 0.5));
    const auto next = static_cast<axistokes::Index>(std::ceil(std::clamp(needed, 1.2 * n, 1.6 * n)));
    return std::min(next, most);
}

/// The next number of elements of second order that reduces an error to the one wanted.
inline axistokes::Index more_elements(axistokes::Index elements, double error, double wanted, axistokes::Index most) {
    const double n = static_cast<double>(elements);
    const double needed = 1.1 * n * std::sqrt(error / wanted);
    return std::min(static_cast<axistokes::Index>(std::ceil(std::clamp(needed, 1.3 * n, 2 * n))), most);
}

/// A series wants its nodes spaced by itself: the initial shapes' spacing has kinks that it would have to resolve.
template <class Discretization>
axistokes::Meridian<double> nodes_of(const Discretization& discretization,
                                     const std::function<axistokes::Meridian<double>(axistokes::Index)>& shape,
                                     axistokes::Index elements) {
    if constexpr (judges_itself<Discretization>) {
        return discretization.redistributed(shape(std::max<axistokes::Index>(128, 2 * elements)), elements);
    } else {
        return shape(elements);
    }
}

/// With `first` or more elements: as many as the share `wanted` of the last modes takes.
template <class Discretization>
axistokes::Meridian<double> resolved_nodes(const Discretization& discretization,
                                           const std::function<axistokes::Meridian<double>(axistokes::Index)>& shape,
                                           axistokes::Index first, double wanted) {
    axistokes::Meridian<double> nodes = nodes_of(discretization, shape, first);
    if constexpr (judges_itself<Discretization>) {
        constexpr axistokes::Index most = most_elements<Discretization>;
        for (double share = discretization.unresolved(nodes); share > wanted && nodes.elements() < most;
             share = discretization.unresolved(nodes)) {
            nodes = nodes_of(discretization, shape, more_modes(nodes.elements(), share, wanted, most));
        }
    }
    return nodes;
}

/// With integrals as accurate as that takes; without an accuracy the discretisation's own default.
template <class Discretization>
Discretization discretization_for(const std::optional<axistokes::Accuracy<double>>& accuracy) {
    typename Discretization::Params params;
    if (accuracy) {
        params.tolerance = accuracy->quadrature;
    }
    return Discretization(params);
}

/// What an accuracy is about: the relative errors of velocity and length.
struct Measured {
    double velocity;
    double length;
    axistokes::Index elements;
};

/// The error of the finer of two second-order results.
inline double second_order_error(const Measured& coarse, const Measured& fine) {
    const double ratio = static_cast<double>(fine.elements) / static_cast<double>(coarse.elements);
    const double velocity = std::abs(fine.velocity - coarse.velocity) / std::max(std::abs(fine.velocity), 1e-3);
    const double length = std::abs(fine.length - coarse.length) / fine.length;
    return std::max(velocity, length) / (ratio * ratio - 1);
}

}  // namespace examples
