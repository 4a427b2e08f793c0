// SPDX-License-Identifier: MIT
// Initial shapes: spheres and spheroids, by aspect ratio or by excess area at unit volume radius.
#pragma once

#include "meridian_spline.hpp"
#include "remesh.hpp"

#include <cmath>
#include <functional>
#include <limits>

namespace axistokes {

/// The sign of a spheroid's aspect ratio minus one: prolate is longer along the axis than across it.
enum class SpheroidKind { prolate, oblate };

/// Area of the spheroid with polar semi-axis c and equatorial semi-axis a (lengths in R0), a, c > 0.
template <class S>
S spheroid_area(const S& a, const S& c) {
    using std::abs;
    using std::asinh;
    using std::atan2;
    using std::sqrt;
    const S pi = detail::pi_value<S>();
    detail::require(a > S(0), "equatorial semi-axis", a, "> 0");
    detail::require(c > S(0), "polar semi-axis", c, "> 0");
    const S q = (c - a) * (c + a) / (c > a ? c * c : a * a);  // +-eccentricity^2
    const S e = sqrt(abs(q));
    if (e < S(0.02)) {
        // asin(e)/e for a prolate, artanh(e)/e for an oblate spheroid: the closed forms are 0/0 for a sphere.
        S ratio = 0;
        S term = 1;
        for (int k = 0; term > std::numeric_limits<S>::epsilon() / 4; ++k) {
            ratio += term / S(2 * k + 1);
            term *= c > a ? S(e * e * S(2 * k + 1) / S(2 * k + 2)) : S(e * e);
        }
        return c > a ? S(2 * pi * a * (a + c * ratio)) : S(2 * pi * (a * a + c * c * ratio));
    }
    if (c > a) {
        return 2 * pi * a * (a + c * atan2(S(e * c), a) / e);  // = asin(e), also for c >> a
    }
    return 2 * pi * (a * a + c * c * asinh(e * a / c) / e);  // asinh(e a/c) = artanh(e), also for c << a
}

namespace detail {

/// Nodes spaced as `spacing` asks for and exactly on the curve that `at_angles` evaluates at angles in [0, pi] from the
/// lower pole to the upper one. The wanted angles are read off a spline with many nodes.
template <class S>
Meridian<S> spaced_on_curve(const std::function<Meridian<S>(const Vector<S>&)>& at_angles, Index elements,
                            const NodeSpacing<S>& spacing) {
    require_elements(elements);
    const S pi = pi_value<S>();
    const Index fine = 16 * elements;
    Vector<S> angle(fine + 1);
    for (Index i = 0; i <= fine; ++i) {
        angle[i] = pi * S(i) / S(fine);
    }
    const CubicSpline<S> density = node_density(MeridianSpline<S>(at_angles(angle)), spacing, elements);
    Vector<S> cumulative(fine + 1);
    cumulative[0] = 0;
    for (Index e = 0; e < fine; ++e) {
        cumulative[e + 1] = cumulative[e] + density.integral(e, S(1));
    }
    const CubicSpline<S> inverse(cumulative, angle, Parity::odd);
    Vector<S> wanted(elements + 1);
    wanted[0] = 0;
    wanted[elements] = pi;
    Index e = 0;
    for (Index i = 1; i < elements; ++i) {
        const S target = cumulative[fine] * S(i) / S(elements);
        while (e + 1 < fine && cumulative[e + 1] < target) {
            ++e;
        }
        wanted[i] = inverse.value(e, (target - cumulative[e]) / inverse.length(e));
    }
    return at_angles(wanted);
}

/// r = a sin t, z = -c cos t.
template <class S>
Meridian<S> spheroid_points(const S& a, const S& c, const Vector<S>& angle) {
    using std::cos;
    using std::sin;
    Meridian<S> m{Vector<S>(angle.size()), Vector<S>(angle.size())};
    for (Index i = 0; i < angle.size(); ++i) {
        m.r[i] = a * sin(angle[i]);
        m.z[i] = -c * cos(angle[i]);
    }
    m.r[0] = m.r[angle.size() - 1] = 0;
    return m;
}

}  // namespace detail

/// Meridian of the ellipse with semi-axes a (equatorial) and c (polar), its nodes spaced as `spacing` asks for.
/// Throws InvalidArgument for fewer than 8 elements or a semi-axis that is not positive and finite.
template <class S>
Meridian<S> spheroid(const S& a, const S& c, Index elements, const NodeSpacing<S>& spacing = {}) {
    detail::require_length("equatorial semi-axis", a);
    detail::require_length("polar semi-axis", c);
    return detail::spaced_on_curve<S>([&](const Vector<S>& angle) { return detail::spheroid_points<S>(a, c, angle); },
                                      elements, spacing);
}

/// Sphere of the given radius (in R0).
template <class S>
Meridian<S> sphere(Index elements, const S& radius = S(1), const NodeSpacing<S>& spacing = {}) {
    detail::require(radius > S(0), "sphere radius", radius, "> 0");
    return spheroid<S>(radius, radius, elements, spacing);
}

/// Spheroid of aspect ratio c/a (polar over equatorial) and volume 4 pi/3.
template <class S>
Meridian<S> spheroid_of_aspect(const S& aspect, Index elements, const NodeSpacing<S>& spacing = {}) {
    using std::cbrt;
    using std::isfinite;
    detail::require(aspect > S(0) && isfinite(aspect), "aspect ratio", aspect, "> 0 and finite");
    const S a = S(1) / cbrt(aspect);
    return spheroid<S>(a, aspect * a, elements, spacing);
}

/// The same on nodes that discretisations of high order carry with few of them: at equidistant s, where t is the
/// eccentric angle and tan t = sqrt(a/c) tan s. Tractions have branch points where tan t = +-i a/c; nearest to
/// the real axis these, and those of the map at tan s = +-i sqrt(c/a), lie sqrt(min(a/c, c/a)) away from it in s, not
/// min(a/c, c/a) as in t.
template <class S>
Meridian<S> smooth_spheroid(const S& aspect, Index elements) {
    using std::cbrt;
    using std::cos;
    using std::isfinite;
    using std::sin;
    using std::sqrt;
    detail::require(aspect > S(0) && isfinite(aspect), "aspect ratio", aspect, "> 0 and finite");
    detail::require_elements(elements);
    const S a = S(1) / cbrt(aspect);
    const S stretch = S(1) / sqrt(aspect);
    Meridian<S> m{Vector<S>(elements + 1), Vector<S>(elements + 1)};
    for (Index i = 0; i <= elements; ++i) {
        const S s = detail::pi_value<S>() * S(i) / S(elements);
        const S x = stretch * sin(s);
        const S y = cos(s);
        const S length = sqrt(S(x * x + y * y));
        m.r[i] = a * x / length;
        m.z[i] = -aspect * a * y / length;
    }
    m.r[0] = m.r[elements] = 0;
    return m;
}

/// Aspect ratio (polar over equatorial) of the spheroid of volume 4 pi/3 and area 4 pi + excess_area, excess_area in
/// [0, 100] R0^2.
template <class S>
S spheroid_aspect_of_excess_area(const S& excess_area, SpheroidKind kind) {
    using std::cbrt;
    using std::exp;
    detail::require(excess_area >= S(0) && excess_area <= S(100), "excess area", excess_area, "in [0, 100]");
    if (excess_area == S(0)) {
        return S(1);
    }
    const S target = 4 * detail::pi_value<S>() + excess_area;
    const S sign = kind == SpheroidKind::prolate ? S(1) : S(-1);
    S low = 0;
    S high = 12;  // of |log(aspect)|
    for (int k = 0; k < std::numeric_limits<S>::digits + 4; ++k) {
        const S middle = (low + high) / 2;
        const S aspect = exp(sign * middle);
        const S a = S(1) / cbrt(aspect);
        (spheroid_area<S>(a, aspect * a) < target ? low : high) = middle;
    }
    return exp(sign * low);
}

/// Spheroid of volume 4 pi/3 and area 4 pi + excess_area: the usual initial shape of a vesicle of that excess area.
/// Throws InvalidArgument for excess_area outside [0, 100] or fewer than 8 elements.
template <class S>
Meridian<S> spheroid_of_excess_area(const S& excess_area, SpheroidKind kind, Index elements,
                                    const NodeSpacing<S>& spacing = {}) {
    return spheroid_of_aspect<S>(spheroid_aspect_of_excess_area<S>(excess_area, kind), elements, spacing);
}

}  // namespace axistokes
