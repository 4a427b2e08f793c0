// SPDX-License-Identifier: MIT
// Area, volume and centroid of a closed axisymmetric surface.
#pragma once

#include "../core.hpp"

#include <cmath>

namespace axistokes {

/// Integrals over the closed surface, in units of R0^2 (area), R0^3 (volume) and R0 (centroid, axial).
template <class S>
struct Measures {
    S area{};
    S volume{};
    S centroid{};

    /// Volume over that of the sphere of equal area; 1 for a sphere.
    S reduced_volume() const {
        using std::sqrt;
        return 6 * sqrt(detail::pi_value<S>()) * volume / (area * sqrt(area));
    }
    /// Area in excess of the sphere of equal volume, in units of the square of that sphere's radius.
    S excess_area() const {
        using std::cbrt;
        const S radius = cbrt(3 * volume / (4 * detail::pi_value<S>()));
        return area / (radius * radius) - 4 * detail::pi_value<S>();
    }
};

}  // namespace axistokes
