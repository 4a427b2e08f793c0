// SPDX-License-Identifier: MIT
// A meridian and its derivatives with respect to a parameter at some of its points, and what follows from them.
#pragma once

#include "../core.hpp"
#include "measures.hpp"
#include "meridian.hpp"
#include "restore.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace axistokes {

template <class S>
struct CurveSamples {
    Vector<S> r, z, r1, z1, r2, z2;
    Vector<S> speed;
    Vector<S> weights{};  // of Int dt, if the points belong to a rule

    /// Fills in the speed.
    void finish() { speed = (r1.cwiseAbs2() + z1.cwiseAbs2()).cwiseSqrt(); }

    /// Positive where the surface is convex.
    Vector<S> meridional_curvature() const {
        return (r1.cwiseProduct(z2) - z1.cwiseProduct(r2)).array() / speed.array().cube();
    }
    /// H; azimuthal and meridional curvature are the same on the axis.
    Vector<S> mean_curvature() const {
        Vector<S> h = meridional_curvature();
        for (Index i = 0; i < h.size(); ++i) {
            if (r[i] > S(0)) {
                h[i] = (h[i] + z1[i] / (speed[i] * r[i])) / 2;
            }
        }
        return h;
    }
    /// Outward unit normals, of all of a meridian from pole to pole.
    std::pair<Vector<S>, Vector<S>> normals() const {
        std::pair<Vector<S>, Vector<S>> n{z1.cwiseQuotient(speed), -r1.cwiseQuotient(speed)};
        const Index last = r.size() - 1;
        n.first[0] = n.first[last] = 0;
        n.second[0] = -1;
        n.second[last] = 1;
        return n;
    }
    /// The factors of f' and f'' in the Laplacian of f, likewise:
    /// (r f'/|x'|)'/(r |x'|) = [f'' + (r'/r - |x'|'/|x'|) f']/|x'|^2, with the limit 2 f''/|x'|^2 at a pole.
    std::pair<Vector<S>, Vector<S>> laplacian_factors() const {
        std::pair<Vector<S>, Vector<S>> factors{Vector<S>(r.size()), Vector<S>(r.size())};
        for (Index i = 0; i < r.size(); ++i) {
            const bool pole = i == 0 || i + 1 == r.size();
            const S v2 = speed[i] * speed[i];
            factors.first[i] = pole ? S(0) : S((r1[i] / r[i] - (r1[i] * r2[i] + z1[i] * z2[i]) / v2) / v2);
            factors.second[i] = S(pole ? 2 : 1) / v2;
        }
        return factors;
    }
    Vector<S> area_weights() const { return 2 * detail::pi_value<S>() * weights.cwiseProduct(r).cwiseProduct(speed); }
};

namespace detail {

/// What depends on a curve only through its samples, for a geometry `Derived` that has at_nodes(shape) and fine(shape),
/// with weights.
template <class Derived, class S>
class SampledGeometry {
  public:
    Measures<S> measures(const Meridian<S>& shape) const { return measures(derived().fine(shape)); }

    /// 2 Int H^2 dA in kappa.
    S bending_energy(const Meridian<S>& shape) const {
        const CurveSamples<S> fine = derived().fine(shape);
        return 2 * fine.area_weights().dot(fine.mean_curvature().cwiseAbs2());
    }

    /// Meridional curvatures at the lower and the upper pole, in 1/R0, positive on a sphere.
    std::pair<S, S> pole_curvatures(const Meridian<S>& shape) const {
        const Vector<S> k = derived().at_nodes(shape).meridional_curvature();
        return {k[0], k[k.size() - 1]};
    }

    /// Displaces the nodes by (a + b H) n until area and volume have the values given, to 1000 epsilon; false if
    /// Newton's iteration does not get there. See restore_area_and_volume.
    bool restore(Meridian<S>& shape, const S& area, const S& volume) const {
        const S tolerance = 1000 * std::numeric_limits<S>::epsilon();
        for (int iteration = 0; iteration < 8; ++iteration) {
            const CurveSamples<S> fine = derived().fine(shape);
            const Measures<S> now = measures(fine);
            if (restored(now, area, volume, tolerance)) {
                return true;
            }
            const Vector<S> h = fine.mean_curvature();
            const Vector<S> da = fine.area_weights();
            const RestoringShift<S> change(now, area, volume, da.dot(h), da.dot(h.cwiseAbs2()), true);
            if (change.exhausted(tolerance)) {
                return true;
            }
            const CurveSamples<S> curve = derived().at_nodes(shape);
            Vector<S> shift = change.by_curvature * curve.mean_curvature();
            shift.array() += change.constant;
            if (!displace(shape, curve, shift)) {
                return false;
            }
        }
        return false;
    }

    /// Gives the shape its volume again, if its area may change, by a displacement of all nodes by the same distance
    /// along the normal; false if that fails.
    bool restore(Meridian<S>& shape, const S& volume) const {
        using std::abs;
        for (int iteration = 0; iteration < 8; ++iteration) {
            const Measures<S> now = measures(shape);
            if (abs(now.volume / volume - S(1)) <= 1000 * std::numeric_limits<S>::epsilon()) {
                return true;
            }
            const Vector<S> shift = Vector<S>::Constant(shape.nodes(), S((volume - now.volume) / now.area));
            if (!displace(shape, derived().at_nodes(shape), shift)) {
                return false;
            }
        }
        return false;
    }

  private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    static Measures<S> measures(const CurveSamples<S>& fine) {
        const Vector<S> disc = pi_value<S>() * fine.weights.cwiseProduct(fine.r.cwiseAbs2()).cwiseProduct(fine.z1);
        Measures<S> m;
        m.area = fine.area_weights().sum();
        m.volume = disc.sum();
        m.centroid = disc.dot(fine.z) / m.volume;
        return m;
    }

    /// Along the normals; false if that leads to infinity.
    static bool displace(Meridian<S>& shape, const CurveSamples<S>& curve, const Vector<S>& distance) {
        const Vector<S> shift = distance.cwiseQuotient(curve.speed);
        shape.r += shift.cwiseProduct(curve.z1);
        shape.z -= shift.cwiseProduct(curve.r1);
        shape.r[0] = shape.r[shape.elements()] = 0;
        return shape.r.allFinite() && shape.z.allFinite();
    }
};

}  // namespace detail
}  // namespace axistokes
