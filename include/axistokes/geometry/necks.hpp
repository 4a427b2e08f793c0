// SPDX-License-Identifier: MIT
// Where a meridian has become too thin for its elements.
#pragma once

#include "meridian.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace axistokes {

/// Lengths in R0, z relative to what the meridian is relative to.
template <class S>
struct Neck {
    S z{};
    S radius{};
    S element{};  // length of the longer element beside it
};

/// The thinnest place between two wider ones.
template <class S>
std::optional<Neck<S>> thinnest_neck(const Meridian<S>& shape) {
    using std::sqrt;
    std::optional<Neck<S>> thinnest;
    for (Index i = 2; i + 2 < shape.nodes(); ++i) {
        if (shape.r[i] > shape.r[i - 1] || shape.r[i] > shape.r[i + 1] || (thinnest && shape.r[i] > thinnest->radius)) {
            continue;
        }
        const auto length = [&](Index e) {
            const S dr = shape.r[e + 1] - shape.r[e];
            const S dz = shape.z[e + 1] - shape.z[e];
            return S(sqrt(dr * dr + dz * dz));
        };
        thinnest = Neck<S>{shape.z[i], shape.r[i], std::max(length(i - 1), length(i))};
    }
    return thinnest;
}

/// Two parts of a meridian that are closer to each other than half of an element there.
template <class S>
struct Contact {
    Point<S> point;
    S distance{};
    S element{};
};

/// The first pair of nodes, four or more elements apart, of which that is true.
template <class S>
std::optional<Contact<S>> unresolved_contact(const Meridian<S>& shape) {
    using std::sqrt;
    const Index n = shape.elements();
    Vector<S> squares(n);
    for (Index e = 0; e < n; ++e) {
        const S dr = shape.r[e + 1] - shape.r[e];
        const S dz = shape.z[e + 1] - shape.z[e];
        squares[e] = dr * dr + dz * dz;
    }
    for (Index i = 0; i + 4 <= n; ++i) {
        const S element = std::max(squares[i], squares[std::max<Index>(i - 1, 0)]);
        for (Index j = i + 4; j <= n; ++j) {
            const S dr = shape.r[j] - shape.r[i];
            const S dz = shape.z[j] - shape.z[i];
            const S square = dr * dr + dz * dz;
            if (4 * square < element) {
                return Contact<S>{{shape.r[i], shape.z[i]}, sqrt(square), sqrt(element)};
            }
        }
    }
    return std::nullopt;
}

}  // namespace axistokes
