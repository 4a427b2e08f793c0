// SPDX-License-Identifier: MIT
// Straight elements with linear densities, as a basis of a layer (layer_engine.hpp). Panels are elements, t in [0, 1].
#pragma once

#include "layer_engine.hpp"

#include <cmath>
#include <vector>

namespace axistokes::detail {

template <class S>
class ElementBasis : public LocalShares<S, 2> {
  public:
    ElementBasis(const Meridian<S>& m, const ElementRules<S>& rules)
        : LocalShares<S, 2>(2, 1), m_(m), rules_(rules), dr_(m.elements()), dz_(m.elements()) {
        dr_ = m.r.tail(m.elements()) - m.r.head(m.elements());
        dz_ = m.z.tail(m.elements()) - m.z.head(m.elements());
        length_ = (dr_.cwiseAbs2() + dz_.cwiseAbs2()).cwiseSqrt();
    }

    Index size() const { return m_.nodes(); }
    Index panels() const { return m_.elements(); }
    const ElementRules<S>& rules() const { return rules_; }
    Index least_order() const { return ElementRules<S>::smallest_order; }
    Index most_order() const { return rules_.largest(); }
    Index least_product_order() const { return least_order(); }

    S begin(Index) const { return S(0); }
    S end(Index) const { return S(1); }
    Point<S> position(Index e, const S& t) const {
        const S u = S(1) - t;
        return {u * m_.r[e] + t * m_.r[e + 1], u * m_.z[e] + t * m_.z[e + 1]};
    }
    S length(Index e, const S& begin, const Point<S>&, const S& end, const Point<S>&) const {
        using std::abs;
        return length_[e] * abs(end - begin);
    }

    Index fixed_order() const { return 0; }
    LayerPoints<S> fixed(bool) const { return {}; }

    std::vector<PanelSide<S>> sides(Index node) const { return sides_of_joint<S>(node, panels()); }

    void evaluate(LayerPoints<S>& points, bool normals) const {
        const std::size_t count = points.t.size();
        points.r.resize(count);
        points.z.resize(count);
        points.shares.resize(2 * count);
        for (std::size_t q = 0; q < count; ++q) {
            const Index e = points.panel[q];
            const S& t = points.t[q];
            const Point<S> x = position(e, t);
            points.r[q] = x.r;
            points.z[q] = x.z;
            points.shares[2 * q] = S(1) - t;
            points.shares[2 * q + 1] = t;
            points.weight[q] *= length_[e];
        }
        if (normals) {
            points.normal_r.resize(count);
            points.normal_z.resize(count);
            for (std::size_t q = 0; q < count; ++q) {
                const Index e = points.panel[q];
                points.normal_r[q] = dz_[e] / length_[e];
                points.normal_z[q] = -dr_[e] / length_[e];
            }
        }
    }

    /// Elements that end at the target do not contribute to a double layer in the plane of the meridian, for there X.n
    /// = 0; a smooth curve does. The rigid translation e has (1/pi) Int t (t.e) over the directions t of the meridian
    /// plane into the surface, e/2 if they fill a half-plane: what is missing is that over the angles between elements
    /// and tangent. At a pole, 3/(4 pi) Int t (t.e) over directions in space: cos^3(c) e_z/2 is missing, c the angle
    /// between axis and element.
    KernelBlock<S> corner(Index i) const {
        using std::atan2;
        using std::cos;
        using std::sin;
        const S pi = pi_value<S>();
        if (i == 0 || i == panels()) {
            const Index e = i == 0 ? 0 : i - 1;
            const S cosine = dz_[e] / length_[e];
            return {S(0), S(0), S(0), 4 * pi * cosine * cosine * cosine};
        }
        // The interior lies to the left of the curve: directions from that of the next element to that back along the
        // previous one. Int (cos, sin)(cos, sin)^T of angles from a to b.
        const S a = atan2(dz_[i], dr_[i]);
        S b = atan2(-dz_[i - 1], -dr_[i - 1]);
        if (b < a) {
            b += 2 * pi;
        }
        const auto part = [](const S& angle, int sign) { return S(angle / 2 + sign * (sin(2 * angle) / 4)); };
        const S rr = part(b, 1) - part(a, 1);
        const S zz = part(b, -1) - part(a, -1);
        const S rz = (cos(2 * a) - cos(2 * b)) / 4;
        return {4 * pi - 8 * rr, -8 * rz, -8 * rz, 4 * pi - 8 * zz};
    }

  private:
    const Meridian<S>& m_;
    const ElementRules<S>& rules_;
    Vector<S> dr_;
    Vector<S> dz_;
    Vector<S> length_;
};

}  // namespace axistokes::detail
