// SPDX-License-Identifier: MIT
// How far two meridians are apart.
#pragma once

#include "meridian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axistokes {

namespace detail {

/// Square of the distance of node i of one meridian from the other one's chords.
template <class S>
S squared_distance(const Meridian<S>& nodes, Index i, const Meridian<S>& chords) {
    S nearest = std::numeric_limits<S>::max();
    for (Index e = 0; e < chords.elements(); ++e) {
        const S dr = chords.r[e + 1] - chords.r[e];
        const S dz = chords.z[e + 1] - chords.z[e];
        const S r = nodes.r[i] - chords.r[e];
        const S z = nodes.z[i] - chords.z[e];
        const S t = std::clamp(S((r * dr + z * dz) / (dr * dr + dz * dz)), S(0), S(1));
        nearest = std::min(nearest, S((r - t * dr) * (r - t * dr) + (z - t * dz) * (z - t * dz)));
    }
    return nearest;
}

/// The parabola through a point of a meridian and its neighbours, u from -1 to 1; past a pole the curve is its mirror
/// image.
template <class S>
struct MeridianArc {
    Point<S> middle, slope, bend;

    MeridianArc(const Meridian<S>& m, Index i) : middle{m.r[i], m.z[i]} {
        const Index last = m.elements();
        const Point<S> before = i > 0 ? Point<S>{m.r[i - 1], m.z[i - 1]} : Point<S>{-m.r[1], m.z[1]};
        const Point<S> after = i < last ? Point<S>{m.r[i + 1], m.z[i + 1]} : Point<S>{-m.r[last - 1], m.z[last - 1]};
        slope = {(after.r - before.r) / 2, (after.z - before.z) / 2};
        bend = {after.r - 2 * middle.r + before.r, after.z - 2 * middle.z + before.z};
    }

    Point<S> at(const S& u) const {
        return {middle.r + u * (slope.r + u * bend.r / 2), middle.z + u * (slope.z + u * bend.z / 2)};
    }
    Point<S> slope_at(const S& u) const { return {slope.r + u * bend.r, slope.z + u * bend.z}; }
};

template <class S>
S dot(const Point<S>& a, const Point<S>& b) {
    return a.r * b.r + a.z * b.z;
}

}  // namespace detail

/// Largest distance (in R0) of a node of one meridian from the other one's chords.
template <class S>
S distance(const Meridian<S>& nodes, const Meridian<S>& chords) {
    using std::sqrt;
    S largest = 0;
    for (Index i = 0; i < nodes.nodes(); ++i) {
        largest = std::max(largest, detail::squared_distance(nodes, i, chords));
    }
    return sqrt(largest);
}

/// Where two curves come closest: their distance h, the length sqrt(2h/h'') along them on which it doubles (infinite if
/// they bend alike), and the spacing of the points of either there.
template <class S>
struct ClosestApproach {
    S distance = std::numeric_limits<S>::infinity();
    S length = std::numeric_limits<S>::infinity();
    S first_spacing{};
    S second_spacing{};
};

/// Of the curves through the points of two meridians that do not meet, by the parabolas through the closest ones.
template <class S>
ClosestApproach<S> closest_approach(const Meridian<S>& a, const Meridian<S>& b) {
    using std::sqrt;
    Index i = 0;
    Index j = 0;
    S least = std::numeric_limits<S>::max();
    for (Index k = 0; k < a.nodes(); ++k) {
        Index nearest = 0;
        const S d = ((b.r.array() - a.r[k]).square() + (b.z.array() - a.z[k]).square()).minCoeff(&nearest);
        if (d < least) {
            least = d;
            i = k;
            j = nearest;
        }
    }
    const detail::MeridianArc<S> first(a, i);
    const detail::MeridianArc<S> second(b, j);
    const auto between = [&](const S& u, const S& v) {
        const Point<S> x = first.at(u);
        const Point<S> y = second.at(v);
        return Point<S>{y.r - x.r, y.z - x.z};
    };
    S u = 0;
    S v = 0;
    Point<S> d = between(u, v);
    for (int iteration = 0; iteration < 8; ++iteration) {
        // Newton's method for the least |d|^2.
        const Point<S> x1 = first.slope_at(u);
        const Point<S> y1 = second.slope_at(v);
        const S g = detail::dot(d, x1);
        const S h = detail::dot(d, y1);
        const S uu = detail::dot(x1, x1) - detail::dot(d, first.bend);
        const S vv = detail::dot(y1, y1) + detail::dot(d, second.bend);
        const S uv = -detail::dot(x1, y1);
        const S determinant = uu * vv - uv * uv;
        if (!(determinant > S(0)) || !(uu > S(0))) {
            break;
        }
        const S next_u = std::clamp(S(u + (vv * g + uv * h) / determinant), S(-1), S(1));
        const S next_v = std::clamp(S(v - (uu * h + uv * g) / determinant), S(-1), S(1));
        const Point<S> next = between(next_u, next_v);
        if (!(detail::dot(next, next) < least)) {
            break;
        }
        u = next_u;
        v = next_v;
        d = next;
        least = detail::dot(next, next);
    }
    ClosestApproach<S> result;
    result.distance = sqrt(least);
    const S first_speed = detail::dot(first.slope_at(u), first.slope_at(u));
    const S second_speed = detail::dot(second.slope_at(v), second.slope_at(v));
    // h'' h: h'' is the sum of the curvatures towards each other.
    const S bend = detail::dot(d, second.bend) / second_speed - detail::dot(d, first.bend) / first_speed;
    if (bend > S(0)) {
        result.length = result.distance * sqrt(2 / bend);
    }
    result.first_spacing = sqrt(first_speed);
    result.second_spacing = sqrt(second_speed);
    return result;
}

}  // namespace axistokes
