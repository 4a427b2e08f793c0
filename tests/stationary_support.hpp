// SPDX-License-Identifier: MIT
// What the tests of stationary states in spectral discretisation share.
#pragma once

#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/geometry/distance.hpp>

namespace stationary {

/// Largest distance of the nodes of one curve from the other one.
inline double distance(const axistokes::Meridian<double>& nodes, const axistokes::Meridian<double>& curve) {
    constexpr axistokes::Index fine = 4000;
    return axistokes::distance(nodes, axistokes::SpectralMeridian<double>().resampled(curve, fine));
}

}  // namespace stationary
