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

/// The least such distance.
template <class S>
S least_distance(const Meridian<S>& nodes, const Meridian<S>& chords) {
    using std::sqrt;
    S least = std::numeric_limits<S>::max();
    for (Index i = 0; i < nodes.nodes(); ++i) {
        least = std::min(least, detail::squared_distance(nodes, i, chords));
    }
    return sqrt(least);
}

}  // namespace axistokes
