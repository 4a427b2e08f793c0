// SPDX-License-Identifier: MIT
// Initial shapes that fit inside a tube.
#pragma once

#include "shapes.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace axistokes {

namespace detail {

/// Semi-axes (a, c) of the superspheroid of exponent q with volume 4 pi/3 and area 4 pi + excess_area, longer than
/// wide; none if all of them have larger areas: the blunter they are, the farther from a sphere.
template <class S>
std::optional<std::pair<S, S>> superspheroid_of_excess_area(const S& excess_area, int q) {
    using std::abs;
    using std::cbrt;
    using std::exp;
    const S pi = pi_value<S>();
    const Index fine = 400;
    Vector<S> angle(fine + 1);
    for (Index i = 0; i <= fine; ++i) {
        angle[i] = pi * S(i) / S(fine);
    }
    const auto scaled_area = [&](const S& aspect) {
        const Measures<S> m = MeridianSpline<S>(superspheroid_points<S>(S(1), aspect, q, angle)).measures();
        const S scale = cbrt(4 * pi / (3 * m.volume));
        return std::pair<S, S>{m.area * scale * scale, scale};
    };
    // The area of these shapes is least near aspect 1 and grows monotonically beyond.
    S low = 0;
    S high = 12;  // of log(aspect)
    for (int k = 0; k < 60; ++k) {
        const S middle = (low + high) / 2;
        (scaled_area(exp(middle)).first < 4 * pi + excess_area ? low : high) = middle;
    }
    const auto [area, scale] = scaled_area(exp(low));
    if (!(abs(area / (4 * pi + excess_area) - S(1)) < S(1e-9))) {
        return std::nullopt;
    }
    return std::pair<S, S>{scale, scale * exp(low)};
}

}  // namespace detail

/// A vesicle of volume 4 pi/3 and area 4 pi + excess_area that fits into a tube of radius tube_radius (in R0), leaving
/// a film of 3 % of that radius if possible: the spheroid of the wanted kind, or else the least blunt of the
/// superspheroids r = a sqrt(1 - (z/c)^(2q)), q = 2, 3, 4. Throws InvalidArgument for an excess area outside [0, 100]
/// and a tube that is too narrow for all of them.
template <class S>
Meridian<S> shape_in_tube(const S& excess_area, const S& tube_radius, SpheroidKind kind, Index elements,
                          const NodeSpacing<S>& spacing = {}) {
    using std::isfinite;
    detail::require(tube_radius > S(0) && isfinite(tube_radius), "tube radius", tube_radius, "> 0 and finite");
    const S widest = tube_radius * S(0.97);
    const Meridian<S> wanted = spheroid_of_excess_area<S>(excess_area, kind, elements, spacing);
    if (wanted.r.maxCoeff() <= widest) {
        return wanted;
    }
    // An oblate shape is turned into no other: which branch a vesicle ends on may depend on its initial shape.
    S narrowest = wanted.r.maxCoeff();
    int exponent = 1;  // the spheroid's
    S half_length = 0;
    constexpr int bluntest = 4;
    for (int q = 2; q <= bluntest && kind == SpheroidKind::prolate && narrowest > widest; ++q) {
        const auto axes = detail::superspheroid_of_excess_area<S>(excess_area, q);
        if (axes && axes->first < narrowest) {
            narrowest = axes->first;
            half_length = axes->second;
            exponent = q;
        }
    }
    std::ostringstream accepted;
    accepted << "> " << narrowest << " for "
             << (kind == SpheroidKind::prolate ? "a prolate shape" : "an oblate spheroid") << " of excess area "
             << excess_area;
    detail::require(narrowest < tube_radius, "tube radius", tube_radius, accepted.str().c_str());
    if (exponent == 1) {
        return wanted;
    }
    return detail::spaced_on_curve<S>(
        [&](const Vector<S>& angle) {
            return detail::superspheroid_points<S>(narrowest, half_length, exponent, angle);
        },
        elements, spacing);
}
/// Likewise, in the tube of a kernel, or of a wall that is one.
template <class S, HasGap<S> Tube>
Meridian<S> shape_in_tube(const S& excess_area, const Tube& tube, SpheroidKind kind, Index elements,
                          const NodeSpacing<S>& spacing = {}) {
    return shape_in_tube<S>(excess_area, S(tube.gap({S(0), S(0)})), kind, elements, spacing);
}

}  // namespace axistokes
