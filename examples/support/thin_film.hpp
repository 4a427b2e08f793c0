// SPDX-License-Identifier: MIT
// Tolerances relative to what the wall of a tube leaves of a force (docs/sphere_in_tube.md).
#pragma once

#include <algorithm>
#include <cmath>

namespace examples {

/// What is left of a force when the wall has cancelled the rest of it, for a sphere of that gap over the tube's radius:
/// the inverse of its drag factor, 1.66 gap^(-5/2) for small gaps, within a factor of two.
inline double remainder(double gap) {
    return std::min(1.0, 0.6 * std::pow(gap, 2.5));
}

/// `tolerance` times `left`, and no less than double precision can tell.
inline double tightened(double tolerance, double left, double least = 2e-13) {
    return std::min(tolerance, std::max(tolerance * std::min(1.0, left), least));
}

}  // namespace examples
