// SPDX-License-Identifier: MIT
// A cubic spline through the nodes of a meridian: fourth-order area, volume and centroid, and points between the nodes.
#pragma once

#include "../quadrature/gauss_legendre.hpp"
#include "cubic_spline.hpp"
#include "measures.hpp"
#include "meridian.hpp"

#include <algorithm>
#include <cmath>

namespace axistokes {

/// Position and its first two derivatives with respect to the spline's parameter.
template <class S>
struct CurvePoint {
    Point<S> position;
    Point<S> first;
    Point<S> second;

    S speed() const {
        using std::sqrt;
        return sqrt(first.r * first.r + first.z * first.z);
    }
    /// Outward unit normal.
    Point<S> normal() const { return {first.z / speed(), -first.r / speed()}; }
    /// Curvature of the meridian, positive where the surface is convex.
    S meridional_curvature() const {
        const S v = speed();
        return (first.r * second.z - first.z * second.r) / (v * v * v);
    }
};

/// Interpolating spline (r(t), z(t)), t the cumulative chord length.
template <class S>
class MeridianSpline {
  public:
    explicit MeridianSpline(const Meridian<S>& meridian)
        : t_(chord_parameter(meridian)), r_(t_, meridian.r, Parity::odd), z_(t_, meridian.z, Parity::even) {}

    Index elements() const { return r_.elements(); }
    const Vector<S>& parameters() const { return t_; }

    /// Point of element e at the local coordinate x in [0, 1]. Derivatives are with respect to t.
    CurvePoint<S> at(Index e, const S& x) const {
        return {{r_.value(e, x), z_.value(e, x)}, {r_.first(e, x), z_.first(e, x)}, {r_.second(e, x), z_.second(e, x)}};
    }

    CurvePoint<S> at_node(Index i) const { return i < elements() ? at(i, S(0)) : at(i - 1, S(1)); }

    /// Calls use(point, weight) at the quadrature points of Int ... dt over the whole curve.
    template <class Use>
    void for_each_quadrature_point(const Use& use) const {
        static const GaussLegendreRule<S> rule = gauss_legendre<S>(5);
        for (Index e = 0; e < elements(); ++e) {
            for (Index q = 0; q < rule.nodes.size(); ++q) {
                use(at(e, rule.nodes[q]), S(r_.length(e) * rule.weights[q]));
            }
        }
    }

    Measures<S> measures() const {
        const S pi = detail::pi_value<S>();
        Measures<S> m;
        S moment = 0;
        for_each_quadrature_point([&](const CurvePoint<S>& p, const S& weight) {
            const S disc = pi * p.position.r * p.position.r * p.first.z * weight;
            m.area += 2 * pi * p.position.r * p.speed() * weight;
            m.volume += disc;
            moment += p.position.z * disc;
        });
        m.centroid = moment / m.volume;
        return m;
    }

    /// Largest distance from the axis.
    S max_radius() const {
        S largest = 0;
        for (Index e = 0; e < elements(); ++e) {
            // A maximum at a node can miss both of its elements: the slope there is zero only up to rounding.
            largest = std::max(largest, r_.value(e, S(0)));
            if (r_.first(e, S(0)) < S(0) || r_.first(e, S(1)) > S(0)) {
                continue;
            }
            S low = 0;
            S high = 1;
            for (int i = 0; i < 60; ++i) {
                const S middle = (low + high) / 2;
                (r_.first(e, middle) > S(0) ? low : high) = middle;
            }
            largest = std::max(largest, r_.value(e, low));
        }
        return largest;
    }

  private:
    static Vector<S> chord_parameter(const Meridian<S>& meridian) {
        using std::sqrt;
        Vector<S> t(meridian.nodes());
        t[0] = 0;
        for (Index i = 1; i < t.size(); ++i) {
            const S dr = meridian.r[i] - meridian.r[i - 1];
            const S dz = meridian.z[i] - meridian.z[i - 1];
            t[i] = t[i - 1] + sqrt(dr * dr + dz * dz);
        }
        return t;
    }

    Vector<S> t_;
    CubicSpline<S> r_;
    CubicSpline<S> z_;
};

}  // namespace axistokes
