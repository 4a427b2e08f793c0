// SPDX-License-Identifier: MIT
// The narrowest tube that holds a vesicle, and initial shapes that fit inside one.
#pragma once

#include "measures.hpp"
#include "shapes.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace axistokes {

namespace detail {

template <class S>
void require_vesicle(const S& area, const S& volume) {
    using std::cbrt;
    using std::isfinite;
    require(volume > S(0) && isfinite(volume), "vesicle volume", volume, "> 0 and finite");
    const S radius = cbrt(3 * volume / (4 * pi_value<S>()));
    const S least = 4 * pi_value<S>() * radius * radius;
    require(area >= least * (S(1) - S(1e-6)), "vesicle area", area, "at least that of the sphere of equal volume");
}

/// Root in [low, high] of an increasing function; the end nearest to it if there is none.
template <class S, class Function>
S increasing_root(const S& low, const S& high, const Function& function) {
    const S below = function(low);
    const S above = function(high);
    if (!(below < S(0) && above > S(0))) {
        return below < S(0) ? high : low;
    }
    std::uintmax_t most = 1000;
    const boost::math::tools::eps_tolerance<S> close;
    return boost::math::tools::toms748_solve(function, low, high, below, above, close, most).second;
}

}  // namespace detail

/// Radius of the narrowest long tube that holds a vesicle of the given area and volume. It fills the tube as a cylinder
/// with hemispherical ends, the shape of least area between parallel walls: of radius R and area A, that has the
/// volume A R/2 - 2 pi R^3/3. Throws InvalidArgument if no surface of that area holds the volume.
template <class S>
S critical_tube_radius(const S& area, const S& volume) {
    using std::asin;
    using std::sin;
    using std::sqrt;
    detail::require_vesicle(area, volume);
    // In units of the radius of the sphere of equal area the cubic is 3 x - x^3 = 2 v, v the reduced volume; x = 2 sin
    // u makes it sin 3 u = v.
    const S sphere = sqrt(area / (4 * detail::pi_value<S>()));
    const S reduced = 3 * volume / (area * sphere);
    return 2 * sphere * sin(asin(std::min(reduced, S(1))) / 3);
}

/// Length of that cylinder with its ends: A = 2 pi R length.
template <class S>
S critical_tube_length(const S& area, const S& radius) {
    return area / (2 * detail::pi_value<S>() * radius);
}

/// The surface parallel to a prolate spheroid of semi-axes a <= c at the distance d outside it (lengths in R0), a > 0,
/// d >= 0: smooth and convex, the spheroid for d = 0, a cylinder with hemispherical ends in the limit a = 0.
template <class S>
struct ParallelSpheroid {
    S a;
    S c;
    S d;

    S radius() const { return a + d; }

    /// By Steiner's formula: V + A d + M d^2 + 4 pi d^3/3 and its derivative, V, A and M the spheroid's volume, area
    /// and integral of the mean curvature. M c is the area of the oblate spheroid of semi-axes c and a.
    Measures<S> measures() const {
        const S pi = detail::pi_value<S>();
        const S area = spheroid_area<S>(a, c);
        const S curvature = spheroid_area<S>(c, a) / c;
        return {area + 2 * d * (curvature + 2 * pi * d),
                4 * pi / 3 * a * a * c + d * (area + d * (curvature + 4 * pi / 3 * d)), S(0)};
    }

    /// Points at angles in [0, pi] from the lower pole to the upper one: the mean of the spheroid's parameter t and the
    /// normal's angle, weighted with c and d, which leaves neither the ends nor the waist without points.
    Meridian<S> points(const Vector<S>& angle) const {
        using std::atan2;
        using std::cos;
        using std::hypot;
        using std::sin;
        const S pi = detail::pi_value<S>();
        Meridian<S> m{Vector<S>::Zero(angle.size()), Vector<S>(angle.size())};
        m.z[0] = -(c + d);
        m.z[angle.size() - 1] = c + d;
        for (Index i = 1; i + 1 < angle.size(); ++i) {
            const S half = std::min(angle[i], S(pi - angle[i]));  // both halves are alike
            const S t = detail::increasing_root<S>(
                S(0), half, [&](const S& x) { return S(c * (x - half) + d * (atan2(c * sin(x), a * cos(x)) - half)); });
            const S sine = sin(t);
            const S cosine = cos(t);
            const S speed = hypot(a * cosine, c * sine);
            m.r[i] = sine * (a + d * c / speed);
            m.z[i] = (half < angle[i] ? S(1) : S(-1)) * cosine * (c + d * a / speed);
        }
        return m;
    }
};

/// The one that has the given area, volume and largest radius. Throws InvalidArgument unless the radius is between that
/// of the narrowest tube and that of the prolate spheroid, which both are unless the surface is a sphere.
template <class S>
ParallelSpheroid<S> parallel_spheroid(const S& area, const S& volume, const S& radius) {
    const S narrowest = critical_tube_radius(area, volume);
    const S pi = detail::pi_value<S>();
    // Of that radius and volume, a the given share of the radius. Longer ones hold more.
    const auto of_volume = [&](const S& share) {
        const S a = share * radius;
        const S d = radius - a;
        const S longest = 3 * volume / (2 * pi * radius * radius);
        const S c = detail::increasing_root<S>(a, longest, [&](const S& x) {
            return S(ParallelSpheroid<S>{a, x, d}.measures().volume - volume);
        });
        return ParallelSpheroid<S>{a, c, d};
    };
    const auto excess = [&](const S& share) { return S(of_volume(share).measures().area - area); };
    const S rounding = 64 * std::numeric_limits<S>::epsilon() * area;
    std::ostringstream accepted;
    accepted << "between " << narrowest << " and that of the spheroid of this area and volume";
    detail::require(radius > narrowest && 4 * pi / 3 * radius * radius * radius < volume && excess(S(1)) > -rounding,
                    "largest radius", radius, accepted.str().c_str());
    return of_volume(detail::increasing_root<S>(std::numeric_limits<S>::epsilon(), S(1), excess));
}

/// A vesicle of volume 4 pi/3 and area 4 pi + excess_area that fits into a tube of radius tube_radius (in R0), leaving
/// a film of 3 % of that radius or, where that is more than half of what the narrowest tube would leave, this half: the
/// spheroid of the wanted kind, or else a surface parallel to a prolate one. Throws InvalidArgument for an excess area
/// outside [0, 100] and a tube too narrow for any surface of that area and volume, or for the oblate spheroid.
template <class S>
Meridian<S> shape_in_tube(const S& excess_area, const S& tube_radius, SpheroidKind kind, Index elements,
                          const NodeSpacing<S>& spacing = {}) {
    using std::isfinite;
    detail::require(tube_radius > S(0) && isfinite(tube_radius), "tube radius", tube_radius, "> 0 and finite");
    const Meridian<S> wanted = spheroid_of_excess_area<S>(excess_area, kind, elements, spacing);
    const S volume = 4 * detail::pi_value<S>() / 3;
    const S area = 3 * volume + excess_area;
    // An oblate shape is turned into no other: which branch a vesicle ends on may depend on its initial shape.
    const bool prolate = kind == SpheroidKind::prolate;
    const S narrowest = prolate ? critical_tube_radius<S>(area, volume) : wanted.r.maxCoeff();
    std::ostringstream accepted;
    accepted << "> " << narrowest << " for " << (prolate ? "a vesicle" : "an oblate spheroid") << " of excess area "
             << excess_area;
    detail::require(narrowest < tube_radius, "tube radius", tube_radius, accepted.str().c_str());
    const S widest = std::max<S>(tube_radius * S(0.97), (tube_radius + narrowest) / 2);
    if (!prolate || wanted.r.maxCoeff() <= widest) {
        return wanted;
    }
    const ParallelSpheroid<S> parallel = parallel_spheroid<S>(area, volume, widest);
    return detail::spaced_on_curve<S>([&](const Vector<S>& angle) { return parallel.points(angle); }, elements,
                                      spacing);
}
/// Likewise, in the tube of a kernel, or of a wall that is one.
template <class S, HasGap<S> Tube>
Meridian<S> shape_in_tube(const S& excess_area, const Tube& tube, SpheroidKind kind, Index elements,
                          const NodeSpacing<S>& spacing = {}) {
    return shape_in_tube<S>(excess_area, S(tube.gap({S(0), S(0)})), kind, elements, spacing);
}

}  // namespace axistokes
