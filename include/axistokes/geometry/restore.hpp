// SPDX-License-Identifier: MIT
// Correction of the area and the volume that time stepping has lost.
#pragma once

#include "meridian_spline.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace axistokes {

namespace detail {

/// The displacement (a + b H) n that takes the measures `now` to the area and volume wanted, to first order, from Int H
/// dA and Int H^2 dA: dA = Int 2 H phi dA, dV = Int phi dA for a normal displacement phi. On a sphere, where the two
/// cannot be changed independently, in the least-squares sense; `independent` tells. So too close to a sphere, where
/// Newton's method needs b << 1: b (H - 1) with H - 1 = 2 phi changes a deviation phi of second order by 2 b of it.
/// `near_spheres`: measures and curvature are exact enough for such deviations.
template <class S>
struct RestoringShift {
    S constant{};
    S by_curvature{};
    bool independent = true;

    RestoringShift(const Measures<S>& now, const S& area, const S& volume, const S& curvature,
                   const S& squared_curvature, bool near_spheres) {
        using std::abs;
        using std::sqrt;
        // Jacobian and defect, relative. QR of the columns, the longer one first: A P = Q [n, p; 0, d].
        S ar = 2 * curvature / area;
        S av = now.area / volume;
        S br = 2 * squared_curvature / area;
        S bv = curvature / volume;
        S* a = &constant;
        S* b = &by_curvature;
        if (br * br + bv * bv > ar * ar + av * av) {
            std::swap(ar, br);
            std::swap(av, bv);
            std::swap(a, b);
        }
        const S n = sqrt(ar * ar + av * av);
        if (n == S(0)) {
            independent = false;
            return;
        }
        ar /= n;
        av /= n;
        const S p = ar * br + av * bv;
        const S d = ar * bv - av * br;
        const S area_defect = (area - now.area) / area;
        const S volume_defect = (volume - now.volume) / volume;
        const S along = ar * area_defect + av * volume_defect;
        const S rounding = 1000 * std::numeric_limits<S>::epsilon();
        independent = abs(d) > rounding * n;
        const S share = independent ? S((ar * volume_defect - av * area_defect) / d) : S(0);
        independent = independent && (abs(d) > S(1e-5) * n || (near_spheres && abs(share) < S(0.25)));
        if (independent) {
            *b = share;
            *a = (along - p * *b) / n;
        } else {
            // Of all that leave the least defect, the smallest.
            *a = along * n / (n * n + p * p);
            *b = along * p / (n * n + p * p);
        }
    }

    /// Nothing is left to do: what remains cannot be changed.
    bool exhausted(const S& tolerance) const {
        using std::abs;
        return !independent && abs(constant) < tolerance && abs(by_curvature) < tolerance;
    }
};

/// Whether area and volume are those wanted.
template <class S>
bool restored(const Measures<S>& now, const S& area, const S& volume, const S& tolerance) {
    using std::abs;
    return abs((area - now.area) / area) <= tolerance && abs((volume - now.volume) / volume) <= tolerance;
}

}  // namespace detail

/// Displaces the nodes by (a + b H) n, the smallest normal displacement that changes area and volume, until both have
/// the values given (to `tolerance`, relative; measured on the spline through the nodes). On a sphere, where the two
/// cannot be changed independently, the volume and area are restored in the least-squares sense.
/// Returns false if Newton's iteration does not get there.
template <class S>
bool restore_area_and_volume(Meridian<S>& meridian, const S& area, const S& volume, const S& tolerance) {
    for (int iteration = 0; iteration < 8; ++iteration) {
        const MeridianSpline<S> spline(meridian);
        const Measures<S> now = spline.measures();
        if (detail::restored(now, area, volume, tolerance)) {
            return true;
        }
        S total_curvature = 0;
        S squared_curvature = 0;
        const S two_pi = 2 * detail::pi_value<S>();
        spline.for_each_quadrature_point([&](const CurvePoint<S>& p, const S& weight) {
            const S da = two_pi * p.position.r * p.speed() * weight;
            const S h = (p.meridional_curvature() + p.normal().r / p.position.r) / 2;
            total_curvature += h * da;
            squared_curvature += h * h * da;
        });
        const detail::RestoringShift<S> change(now, area, volume, total_curvature, squared_curvature, false);
        if (change.exhausted(tolerance)) {
            return true;
        }
        for (Index i = 0; i < meridian.nodes(); ++i) {
            const CurvePoint<S> p = spline.at_node(i);
            const bool pole = i == 0 || i + 1 == meridian.nodes();
            const S k = p.meridional_curvature();
            const S h = pole ? k : S((k + p.normal().r / p.position.r) / 2);
            const S shift = change.constant + change.by_curvature * h;
            if (!pole) {
                meridian.r[i] += shift * p.normal().r;
            }
            meridian.z[i] += shift * p.normal().z;
        }
        if (!meridian.r.allFinite() || !meridian.z.allFinite()) {
            return false;
        }
    }
    return false;
}

/// The same for the volume alone: a displacement of all nodes by the same distance along the normal.
template <class S>
bool restore_volume(Meridian<S>& meridian, const S& volume, const S& tolerance) {
    using std::abs;
    for (int iteration = 0; iteration < 8; ++iteration) {
        const MeridianSpline<S> spline(meridian);
        const Measures<S> now = spline.measures();
        if (abs(now.volume / volume - S(1)) <= tolerance) {
            return true;
        }
        const S shift = (volume - now.volume) / now.area;
        for (Index i = 0; i < meridian.nodes(); ++i) {
            const Point<S> normal = spline.at_node(i).normal();
            const bool pole = i == 0 || i + 1 == meridian.nodes();
            meridian.r[i] += pole ? S(0) : S(shift * normal.r);
            meridian.z[i] += shift * normal.z;
        }
        if (!meridian.r.allFinite() || !meridian.z.allFinite()) {
            return false;
        }
    }
    return false;
}

}  // namespace axistokes
