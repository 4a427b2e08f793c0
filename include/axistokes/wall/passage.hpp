// SPDX-License-Identifier: MIT
// Can a vesicle of given area and volume get through a channel at all? Neither can change, which bounds the throat.
#pragma once

#include "../geometry/tube_shapes.hpp"
#include "profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace axistokes {

/// Radius of the smallest hole in a thin plate that lets a vesicle through: halfway it consists of two equal spherical
/// caps that meet in the hole, whose area together must not exceed the vesicle's. 0 if any hole does.
template <class S>
S critical_orifice_radius(const S& area, const S& volume) {
    using std::cbrt;
    using std::sqrt;
    detail::require_vesicle(area, volume);
    const S pi = detail::pi_value<S>();
    const S sphere = cbrt(3 * volume / (4 * pi));
    // Caps of radius a >= hole: areas 2 pi a (a + h), volumes pi/3 (a + h)^2 (2 a - h), h = sqrt(a^2 - hole^2).
    const auto least_area = [&](const S& hole) {
        const auto height = [&](const S& a) { return S(sqrt((a - hole) * (a + hole))); };
        const S a = detail::increasing_root<S>(hole, std::max(sphere, hole), [&](const S& radius) {
            const S h = height(radius);
            return S(2 * pi / 3 * (radius + h) * (radius + h) * (2 * radius - h) - volume);
        });
        return S(4 * pi * a * (a + height(a)));
    };
    if (least_area(S(0)) <= area) {
        return S(0);
    }
    return detail::increasing_root<S>(S(0), sphere, [&](const S& hole) { return S(area - least_area(hole)); });
}

namespace detail {

/// Least area of a surface that starts at the channel's section z, goes in the given direction (1 or -1), stays within
/// the wall and holds the given volume with that section: half a sphere if the section is wide enough for it. Else it
/// follows the wall up to some z1 and closes with the sphere that touches the wall there. Nothing if that is not the
/// answer: the wall must pull nowhere, that is, on the part followed, widen with growing slope and have no larger mean
/// curvature than the sphere.
template <ChannelProfile Profile>
std::optional<typename Profile::Scalar> least_area_beyond(const Profile& profile, const typename Profile::Scalar& z,
                                                          int direction, const typename Profile::Scalar& volume) {
    using S = typename Profile::Scalar;
    using std::cbrt;
    using std::sqrt;
    constexpr int samples = 4000;
    const S pi = pi_value<S>();
    const S step = ((direction > 0 ? profile.end() : profile.begin()) - z) / S(samples);
    const S throat = profile.radius(z);
    const S sphere_radius = cbrt(3 * volume / (2 * pi));
    if (sphere_radius <= throat) {
        return 2 * pi * sphere_radius * sphere_radius;
    }
    S wall_area = 0;
    S wall_volume = 0;
    S area_before = 0;
    S volume_before = 0;
    S slope_before = 0;
    for (int i = 0; i <= samples; ++i) {
        const S z1 = z + step * S(i);
        const S radius = profile.radius(z1);
        const S slope = S(direction) * profile.slope(z1);
        if (i > 0) {
            const S middle = profile.radius(z1 - step / 2);
            const S rise = profile.slope(z1 - step / 2);
            const S length = S(direction) * step;
            wall_area += 2 * pi * middle * sqrt(S(1) + rise * rise) * length;
            wall_volume += pi * middle * middle * length;
        }
        const S sphere = radius * sqrt(S(1) + slope * slope);
        const S height = sphere + radius * slope;
        const S area = wall_area + 2 * pi * sphere * height;
        const S held = wall_volume + pi / 3 * height * height * (3 * sphere - height);
        if (slope < slope_before - S(1e-9) || sphere > 2 * throat) {
            return std::nullopt;
        }
        if (held >= volume) {
            const S share = i == 0 ? S(1) : (volume - volume_before) / (held - volume_before);
            return area_before + share * (area - area_before);
        }
        area_before = area;
        volume_before = held;
        slope_before = slope;
    }
    return std::nullopt;
}

}  // namespace detail

/// Least area that a vesicle of the given volume has when half of it has passed the narrowest section of a channel, as
/// far as the wall beside this section tells; that of two spheres if these have less. Nothing if not known.
template <ChannelProfile Profile>
std::optional<typename Profile::Scalar> halfway_area(const Profile& profile, const typename Profile::Scalar& volume) {
    using S = typename Profile::Scalar;
    using std::cbrt;
    if (profile.uniform) {
        return std::nullopt;
    }
    const S narrowest = narrowest_section(profile);
    const auto above = detail::least_area_beyond(profile, narrowest, 1, S(volume / 2));
    const auto below = detail::least_area_beyond(profile, narrowest, -1, S(volume / 2));
    if (!above || !below) {
        return std::nullopt;
    }
    const S sphere = cbrt(3 * volume / (8 * detail::pi_value<S>()));
    return std::min<S>(*above + *below, 8 * detail::pi_value<S>() * sphere * sphere);
}

/// Throws InvalidArgument if a vesicle of the given area and volume cannot pass the channel, whatever the pressure. One
/// that fits into a tube of the throat's radius passes, and so does one with the area of two spheres that share its
/// volume. Any other does not if its throat is narrower than the critical orifice, or narrower than the critical tube
/// over the length of the vesicle in it, or if the vesicle cannot get halfway through. What passes may still need more
/// pressure than the flow has.
template <ChannelProfile Profile>
void require_passage(const Profile& profile, const typename Profile::Scalar& area,
                     const typename Profile::Scalar& volume) {
    using S = typename Profile::Scalar;
    const S throat = narrowest_radius(profile);
    const S tube = critical_tube_radius(area, volume);
    const S orifice = critical_orifice_radius(area, volume);
    if (throat > tube || (orifice == S(0) && !profile.uniform)) {
        return;
    }
    const auto refuse = [&](const S& limit, const char* why) {
        std::ostringstream accepted;
        accepted << "larger than " << limit << ": " << why << " a vesicle of area " << area << " and volume " << volume;
        detail::require(throat > limit, "throat radius", throat, accepted.str().c_str());
    };
    refuse(orifice, "no narrower hole lets through");
    if (profile.uniform) {
        refuse(tube, "no narrower tube holds");
        return;
    }
    constexpr int samples = 2000;
    const S step = (profile.end() - profile.begin()) / S(samples);
    S narrow = 0;
    for (int i = 0; i <= samples; ++i) {
        narrow = profile.radius(profile.begin() + step * S(i)) < tube ? narrow + step : S(0);
        if (narrow > critical_tube_length(area, tube)) {
            refuse(tube, "over the length of the throat, no narrower tube holds");
        }
    }
    const S halfway = halfway_area(profile, volume).value_or(area);
    std::ostringstream accepted;
    accepted << "wider: halfway through, a vesicle of volume " << volume << " needs an area of " << halfway
             << ", and has only " << area;
    detail::require(halfway <= area * (S(1) + S(1e-6)), "throat radius", throat, accepted.str().c_str());
}

}  // namespace axistokes
