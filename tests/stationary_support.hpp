// SPDX-License-Identifier: MIT
// What the tests of stationary states in spectral discretisation share.
#pragma once

#include <axistokes/core.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/geometry/meridian.hpp>

#include <algorithm>
#include <cmath>

namespace stationary {

/// Largest distance of the nodes of one curve from the other one.
inline double distance(const axistokes::Meridian<double>& nodes, const axistokes::Meridian<double>& curve) {
    const axistokes::Index fine = 4000;
    const axistokes::Meridian<double> line = axistokes::SpectralMeridian<double>().resampled(curve, fine);
    double largest = 0;
    for (axistokes::Index i = 0; i < nodes.nodes(); ++i) {
        double nearest = 1e300;
        for (axistokes::Index k = 0; k < fine; ++k) {
            const double dr = line.r[k + 1] - line.r[k];
            const double dz = line.z[k + 1] - line.z[k];
            const double pr = nodes.r[i] - line.r[k];
            const double pz = nodes.z[i] - line.z[k];
            const double along = std::clamp((pr * dr + pz * dz) / (dr * dr + dz * dz), 0.0, 1.0);
            nearest = std::min(nearest, std::hypot(pr - along * dr, pz - along * dz));
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

}  // namespace stationary
