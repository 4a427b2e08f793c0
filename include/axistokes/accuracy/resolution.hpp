// SPDX-License-Identifier: MIT
// How many elements an accuracy takes, and how large the error of a result is (docs/accuracy.md).
#pragma once

#include "../accuracy.hpp"
#include "../geometry/meridian.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

namespace axistokes {

/// A discretisation that tells from one shape whether it is resolved: `unresolved(shape)` is the share of the last
/// modes.
template <class Discretization>
concept JudgesItself = requires(const Discretization& d, const Meridian<typename Discretization::Scalar>& shape) {
    { d.unresolved(shape) } -> std::convertible_to<typename Discretization::Scalar>;
};

/// Whether this one does. One that is chosen at run time says so itself.
template <class Discretization>
bool judges_itself(const Discretization& discretization) {
    if constexpr (requires {
                      { discretization.judges_itself() } -> std::convertible_to<bool>;
                  }) {
        return discretization.judges_itself();
    } else {
        return JudgesItself<Discretization>;
    }
}

/// First and largest number of elements that are tried.
template <class Discretization>
constexpr Index first_elements = JudgesItself<Discretization> ? 16 : 32;
template <class Discretization>
Index most_elements(const Discretization& discretization) {
    if constexpr (requires {
                      { discretization.most_elements() } -> std::convertible_to<Index>;
                  }) {
        return discretization.most_elements();
    }
    return judges_itself(discretization) ? 160 : 256;
}

/// The next number of modes when the share `now` of the last ones is to fall to `wanted`: they decay geometrically.
inline Index more_modes(Index elements, double now, double wanted, Index most) {
    const auto n = static_cast<double>(elements);
    const double needed = n * std::log(wanted / 3) / std::log(std::min(now, 0.5));
    return std::min(static_cast<Index>(std::ceil(std::clamp(needed, 1.2 * n, 1.6 * n))), most);
}

/// The same of a discretisation that knows better, by `finer(elements, now, wanted)`.
template <class Discretization>
Index more_elements_of(const Discretization& discretization, Index elements, double now, double wanted, Index most) {
    using S = typename Discretization::Scalar;
    if constexpr (requires {
                      { discretization.finer(elements, S(now), S(wanted)) } -> std::convertible_to<Index>;
                  }) {
        return std::min(discretization.finer(elements, S(now), S(wanted)), most);
    }
    return more_modes(elements, now, wanted, most);
}

/// The next number of elements of second order that reduces an error to the one wanted.
inline Index more_elements(Index elements, double error, double wanted, Index most) {
    const auto n = static_cast<double>(elements);
    const double needed = 1.1 * n * std::sqrt(error / wanted);
    return std::min(static_cast<Index>(std::ceil(std::clamp(needed, 1.3 * n, 2 * n))), most);
}

/// What a film does to the error of a result when forces in it vary over n nodes (FilmThickness::wall_nodes, Gap), as
/// fitted to spheres (docs/accuracy.md, "Gaps"). Of its own force, relative; beyond `unresolved` it is no estimate.
struct FilmResolution {
    static constexpr double unresolved = 0.1;
    /// With what factor the error of an unresolved gap's width changes its force.
    static constexpr double unresolved_factor = 30;

    bool spectral = true;

    /// Bodies that slide along a wall. Of P1 elements two meshes tell more as long as this is small: it then is 0.
    double wall(double n, double slenderness) const {
        if (spectral) {
            return 150 * std::exp(-1.7 * n);
        }
        const double error = (2.6 + 15 / (slenderness * slenderness * n)) / (n * n);
        return error > unresolved ? error : 0;
    }
    /// Bodies that approach each other.
    double gap(double n, double slenderness) const {
        const double thin = slenderness * slenderness;
        return spectral ? 0.6 / thin * std::exp(-1.2 * n) : (1.5 + 4e-4 / (thin * thin)) / (n * n);
    }
    /// The same of the result when the gap's force is about `share` of what moves the bodies.
    double gap(double n, double slenderness, double share) const {
        const double error = gap(n, slenderness);
        return share * (error <= unresolved ? error : std::max(error, unresolved_factor));
    }

    /// How many nodes bring `wall`, or `gap`, down to `wanted`; forces in films of that slenderness.
    double nodes_for_wall(double slenderness, double wanted) const {
        return spectral
                   ? std::log(150 / wanted) / 1.7
                   : std::max(std::sqrt(5.2 / unresolved), std::cbrt(30 / (slenderness * slenderness * unresolved)));
    }
    double nodes_for_gap(double slenderness, double wanted) const {
        const double thin = slenderness * slenderness;
        return spectral ? std::log(0.6 / (thin * wanted)) / 1.2 : std::sqrt((1.5 + 4e-4 / (thin * thin)) / wanted);
    }
};

/// The number of elements that has `wanted` nodes where there are `now`, and some to spare: films get thinner.
inline Index elements_for_film(Index elements, double now, double wanted, Index most) {
    const double needed = static_cast<double>(elements) * std::max(1.15, 1.1 * wanted / now);
    return needed < static_cast<double>(most) ? static_cast<Index>(std::ceil(needed)) : most;
}

/// `elements` elements on the curve that `shape(count)` gives any number of nodes on. A series wants its nodes spaced
/// by itself: the initial shapes' spacing has kinks that it would have to resolve.
template <class Discretization, class Shape>
Meridian<typename Discretization::Scalar> nodes_of(const Discretization& discretization, const Shape& shape,
                                                   Index elements) {
    if constexpr (JudgesItself<Discretization>) {
        if (judges_itself(discretization)) {
            return discretization.redistributed(shape(std::max<Index>(128, 2 * elements)), elements);
        }
    }
    return shape(elements);
}

/// With `first` or more elements: as many as the share `wanted` of the last modes takes.
template <class Discretization, class Shape>
Meridian<typename Discretization::Scalar> resolved_nodes(const Discretization& discretization, const Shape& shape,
                                                         Index first, double wanted) {
    auto nodes = nodes_of(discretization, shape, first);
    if constexpr (JudgesItself<Discretization>) {
        const Index most = most_elements(discretization);
        for (auto share = static_cast<double>(discretization.unresolved(nodes));
             judges_itself(discretization) && share > wanted && nodes.elements() < most;
             share = static_cast<double>(discretization.unresolved(nodes))) {
            nodes = nodes_of(discretization, shape,
                             more_elements_of(discretization, nodes.elements(), share, wanted, most));
        }
    }
    return nodes;
}

/// With integrals as accurate as that takes; without an accuracy the discretisation's own default.
template <class Discretization, class S>
Discretization discretization_for(const std::optional<Accuracy<S>>& accuracy) {
    typename Discretization::Params params;
    if (accuracy) {
        params.tolerance = accuracy->quadrature;
    }
    return Discretization(params);
}

/// What an accuracy is about: the relative errors of velocity and length.
struct MeasuredState {
    double velocity;
    double length;
    Index elements;
};

/// The relative difference of two results: of velocities, unless they are next to nothing, and of lengths.
inline double relative_difference(const MeasuredState& a, const MeasuredState& b) {
    const double velocity = std::abs(a.velocity - b.velocity) / std::max(std::abs(b.velocity), 1e-3);
    return std::max(velocity, std::abs(a.length - b.length) / b.length);
}

/// The error of the finer of two second-order results.
inline double second_order_error(const MeasuredState& coarse, const MeasuredState& fine) {
    const double ratio = static_cast<double>(fine.elements) / static_cast<double>(coarse.elements);
    return relative_difference(coarse, fine) / (ratio * ratio - 1);
}

}  // namespace axistokes
