// SPDX-License-Identifier: MIT
// Necks of a meridian.
#pragma once

#include <axistokes/geometry/meridian.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace examples {

/// Where a tube, of ten radii at least, leaves a body: the first place above the widest one that is thinner than its
/// neighbours.
inline std::optional<axistokes::Index> tube_neck(const axistokes::Meridian<double>& shape) {
    axistokes::Index widest = 0;
    shape.r.maxCoeff(&widest);
    for (axistokes::Index i = widest + 1; i + 1 < shape.nodes(); ++i) {
        if (shape.r[i] <= shape.r[i - 1] && shape.r[i] < shape.r[i + 1]) {
            const bool slender = shape.z[shape.nodes() - 1] - shape.z[i] > 10 * shape.r[i];
            return slender ? std::optional(i) : std::nullopt;
        }
    }
    return std::nullopt;
}

/// Tension times radius squared, in units of kappa, where it is largest on what is a tube, above node `from`: where the
/// radius changes by less than a twentieth of the distance along the axis. A tube is unstable above 3/2.
inline double tension_over_bending(const axistokes::Meridian<double>& shape, const axistokes::Vector<double>& tension,
                                   axistokes::Index from) {
    double largest = 0;
    for (axistokes::Index i = from; i + 1 < shape.nodes(); ++i) {
        if (20 * std::abs(shape.r[i + 1] - shape.r[i - 1]) < std::abs(shape.z[i + 1] - shape.z[i - 1])) {
            largest = std::max(largest, tension[i] * shape.r[i] * shape.r[i]);
        }
    }
    return largest;
}

/// How often, from node `from` on, the radius rises and falls again by a factor, not counting the end of the tube.
inline axistokes::Index pearls_above(const axistokes::Meridian<double>& shape, axistokes::Index from, double factor) {
    axistokes::Index count = 0;
    double low = shape.r[from];
    double high = shape.r[from];
    bool rising = false;
    for (axistokes::Index i = from; i + 1 < shape.nodes(); ++i) {
        const double r = shape.r[i];
        low = std::min(low, r);
        high = std::max(high, r);
        if (!rising && r > factor * low) {
            rising = true;
            high = r;
        } else if (rising && r < high / factor) {
            rising = false;
            low = r;
            ++count;
        }
    }
    // The last fall is that to the pole.
    return std::max<axistokes::Index>(count - 1, 0);
}

}  // namespace examples
