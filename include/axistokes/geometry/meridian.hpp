// SPDX-License-Identifier: MIT
// The generating curve of a closed axisymmetric surface, and the checks a curve must pass before anything is computed
// on it.
#pragma once

#include "../core.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace axistokes {

/// Nodes of a meridian from the lower pole (smallest z on the axis) to the upper one, in units of R0. r is 0 at the two
/// ends and positive between them, so that the outward normal is (dz/ds, -dr/ds).
template <class S>
struct Meridian {
    Vector<S> r;
    Vector<S> z;

    Index nodes() const { return r.size(); }
    Index elements() const { return r.size() - 1; }
};

/// What is wanted of a surface: weights and normals, or curvatures and operators too.
enum class SurfaceParts { metric, all };

/// The fewest elements on which every operator of the library is defined.
inline constexpr Index minimum_elements = 8;

namespace detail {

template <class S>
S cross(const Point<S>& a, const Point<S>& b, const Point<S>& c) {
    return (b.r - a.r) * (c.z - a.z) - (b.z - a.z) * (c.r - a.r);
}

template <class S>
bool segments_cross(const Point<S>& a, const Point<S>& b, const Point<S>& c, const Point<S>& d) {
    const bool c_and_d_apart = (cross(a, b, c) > S(0)) != (cross(a, b, d) > S(0));
    const bool a_and_b_apart = (cross(c, d, a) > S(0)) != (cross(c, d, b) > S(0));
    return c_and_d_apart && a_and_b_apart;
}

/// The curve's length, from node to node, over sqrt(h Rc) with Rc = h + max r: along a film of thickness h in a tube of
/// radius Rc forces vary over that.
template <class S>
S length_in_film(const Meridian<S>& m, const S& film) {
    using std::sqrt;
    const Index n = m.elements();
    const Vector<S> dr = m.r.tail(n) - m.r.head(n);
    const Vector<S> dz = m.z.tail(n) - m.z.head(n);
    return (dr.cwiseAbs2() + dz.cwiseAbs2()).cwiseSqrt().sum() / sqrt(film * (film + m.r.maxCoeff()));
}

inline void require_elements(Index elements) {
    require(elements >= minimum_elements, "number of elements", elements, "at least 8");
}

}  // namespace detail

/// The first pair of elements that cross each other, if any; each element is named by its lower node.
template <class S>
std::optional<std::pair<Index, Index>> self_intersection(const Meridian<S>& meridian) {
    const auto point = [&](Index i) { return Point<S>{meridian.r[i], meridian.z[i]}; };
    for (Index i = 0; i + 1 < meridian.elements(); ++i) {
        const auto [z_low, z_high] = std::minmax(meridian.z[i], meridian.z[i + 1]);
        const auto [r_low, r_high] = std::minmax(meridian.r[i], meridian.r[i + 1]);
        for (Index j = i + 2; j < meridian.elements(); ++j) {
            const bool apart = std::min(meridian.z[j], meridian.z[j + 1]) > z_high ||
                               std::max(meridian.z[j], meridian.z[j + 1]) < z_low ||
                               std::min(meridian.r[j], meridian.r[j + 1]) > r_high ||
                               std::max(meridian.r[j], meridian.r[j + 1]) < r_low;
            if (!apart && detail::segments_cross(point(i), point(i + 1), point(j), point(j + 1))) {
                return std::pair{i, j};
            }
        }
    }
    return std::nullopt;
}

namespace detail {

/// Why nothing can be computed on a shape that was valid and has been deformed; empty if it is valid still.
template <class S>
std::string fault(const Meridian<S>& shape) {
    if (!shape.r.allFinite() || !shape.z.allFinite()) {
        return "a node's position is not finite";
    }
    if (!(shape.r.segment(1, shape.nodes() - 2).minCoeff() > S(0))) {
        return "a node crossed the axis";
    }
    if (const auto crossing = self_intersection(shape)) {
        return "the membrane intersects itself at nodes " + std::to_string(crossing->first) + " and " +
               std::to_string(crossing->second);
    }
    return "";
}

}  // namespace detail

/// Throws InvalidArgument unless the nodes describe a closed surface without self-intersection: at least 8 elements,
/// finite coordinates, r = 0 at both ends and r > 0 between, distinct consecutive nodes, lower pole first.
template <class S>
void validate(const Meridian<S>& meridian) {
    using std::isfinite;
    const Index n = meridian.nodes();
    if (meridian.z.size() != n) {
        throw InvalidArgument("meridian: " + std::to_string(n) + " values of r but " +
                              std::to_string(meridian.z.size()) + " of z: must be equally many");
    }
    detail::require_elements(meridian.elements());
    for (Index i = 0; i < n; ++i) {
        const std::string node = " of meridian node " + std::to_string(i);
        detail::require(isfinite(meridian.r[i]), ("r" + node).c_str(), meridian.r[i], "finite");
        detail::require(isfinite(meridian.z[i]), ("z" + node).c_str(), meridian.z[i], "finite");
        if (i == 0 || i == n - 1) {
            detail::require(meridian.r[i] == S(0), ("r" + node).c_str(), meridian.r[i], "0 at a pole");
        } else {
            detail::require(meridian.r[i] > S(0), ("r" + node).c_str(), meridian.r[i], "> 0 between the poles");
        }
        if (i > 0 && meridian.r[i] == meridian.r[i - 1] && meridian.z[i] == meridian.z[i - 1]) {
            throw InvalidArgument("meridian: nodes " + std::to_string(i - 1) + " and " + std::to_string(i) +
                                  " coincide: consecutive nodes must be distinct");
        }
    }
    // Orientation: twice the signed area between the curve and the axis.
    S signed_area = 0;
    for (Index i = 0; i + 1 < n; ++i) {
        signed_area += (meridian.r[i] + meridian.r[i + 1]) * (meridian.z[i + 1] - meridian.z[i]);
    }
    detail::require(signed_area > S(0), "meridian: signed area between curve and axis", S(signed_area / 2),
                    "> 0, that is the lower pole comes first");
    if (const auto crossing = self_intersection(meridian)) {
        throw InvalidArgument("meridian: the elements that start at nodes " + std::to_string(crossing->first) +
                              " and " + std::to_string(crossing->second) +
                              " cross: the curve must not intersect itself");
    }
}

}  // namespace axistokes
