// SPDX-License-Identifier: MIT
// How far the material of an interface is stretched.
#pragma once

#include "../core.hpp"

#include <utility>

namespace axistokes {

/// Principal stretches at the nodes: lengths along the meridian and around the axis over those on a reference.
template <class S>
struct Stretches {
    Vector<S> meridional;
    Vector<S> azimuthal;
};

namespace detail {

/// The azimuthal stretch is r/R, and at the poles the meridional one.
template <class S>
Stretches<S> stretches_of(Vector<S> meridional, const Vector<S>& r, const Vector<S>& reference_r) {
    Stretches<S> stretches{meridional, std::move(meridional)};
    for (Index i = 1; i + 1 < r.size(); ++i) {
        stretches.azimuthal[i] = r[i] / reference_r[i];
    }
    return stretches;
}

}  // namespace detail
}  // namespace axistokes
