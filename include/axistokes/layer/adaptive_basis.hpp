// SPDX-License-Identifier: MIT
// Piecewise polynomials in the node index, as a basis of a layer (layer_engine.hpp; docs/adaptive.md, section 3).
// Panels are elements, t in [0, 1].
#pragma once

#include "../geometry/local_polynomials.hpp"
#include "layer_engine.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace axistokes::detail {

template <class S>
class AdaptiveBasis {
  public:
    /// `order` points an element; `rules` has them up to at least twice that.
    AdaptiveBasis(const Meridian<S>& m, const ElementRules<S>& rules, Index half, Index order)
        : n_(m.nodes()),
          rules_(rules),
          half_(half),
          order_(order),
          stencils_(local_stencils<S>(half)),
          r_(m.r, -1, half),
          z_(m.z, 1, half) {
        using std::sqrt;
        speed_.resize(panels());
        for (Index e = 0; e < panels(); ++e) {
            S largest = 0;
            for (const S& t : {S(0), S(0.5), S(1)}) {
                const S r1 = r_.slope(e, t);
                const S z1 = z_.slope(e, t);
                largest = std::max<S>(largest, sqrt(S(r1 * r1 + z1 * z1)));
            }
            speed_[e] = largest;
        }
    }

    Index size() const { return n_; }
    Index panels() const { return n_ - 1; }
    const ElementRules<S>& rules() const { return rules_; }
    Index least_order() const { return order_; }
    Index most_order() const { return rules_.largest(); }
    Index least_product_order() const { return std::min(2 * order_, rules_.largest()); }

    S begin(Index) const { return S(0); }
    S end(Index) const { return S(1); }
    Point<S> position(Index e, const S& t) const { return {r_.value(e, t), z_.value(e, t)}; }
    S length(Index e, const S& begin, const Point<S>& x1, const S& end, const Point<S>& x2) const {
        using std::abs;
        using std::sqrt;
        const S chord = sqrt(S((x1.r - x2.r) * (x1.r - x2.r) + (x1.z - x2.z) * (x1.z - x2.z)));
        return std::max<S>(chord, speed_[e] * abs(end - begin));
    }

    Index fixed_order() const { return order_; }
    LayerPoints<S> fixed(bool normals) const {
        LayerPoints<S> points;
        for (Index e = 0; e < panels(); ++e) {
            points.add(e, S(0), S(1), rules_[order_]);
        }
        evaluate(points, normals);
        return points;
    }

    std::vector<PanelSide<S>> sides(Index node) const { return sides_of_joint<S>(node, panels()); }

    void evaluate(LayerPoints<S>& points, bool normals) const {
        using std::sqrt;
        const std::size_t count = points.t.size();
        const auto width = static_cast<std::size_t>(2 * half_);
        points.r.resize(count);
        points.z.resize(count);
        points.normal_r.resize(normals ? count : 0);
        points.normal_z.resize(normals ? count : 0);
        points.shares.resize(count * width);
        for (std::size_t q = 0; q < count; ++q) {
            const Index e = points.panel[q];
            const S& t = points.t[q];
            points.r[q] = r_.value(e, t);
            points.z[q] = z_.value(e, t);
            const S r1 = r_.slope(e, t);
            const S z1 = z_.slope(e, t);
            const S speed = sqrt(S(r1 * r1 + z1 * z1));
            points.weight[q] *= speed;
            if (normals) {
                points.normal_r[q] = z1 / speed;
                points.normal_z[q] = -r1 / speed;
            }
            Eigen::Map<Vector<S>> shares(&points.shares[q * width], 2 * half_);
            const S x = t - S(1) / 2;
            shares.setZero();
            for (Index k = 2 * half_ - 1; k >= 0; --k) {
                shares = shares * x + stencils_->cardinals.row(k).transpose();
            }
        }
    }

    /// to += entries (2 points x columns) times weights and shares (2 nodes x columns). Radial densities are odd.
    void spread(const LayerPoints<S>& points, const Matrix<S>& entries, Eigen::Ref<Matrix<S>> to) const {
        const Index count = points.size();
        for (Index c = 0; c < entries.cols(); c += 2) {
            const S* from = entries.data() + c * entries.rows();
            S* u_r = to.data() + c * to.outerStride();
            S* u_z = u_r + to.outerStride();
            const S* share = points.shares.data();
            for (Index q = 0; q < count; ++q) {
                const auto k = static_cast<std::size_t>(q);
                const Index first = points.panel[k] + 1 - half_;
                const S& weight = points.weight[k];
                for (Index j = 0; j < 2 * half_; ++j, ++share) {
                    const auto [node, sign] = reflection(first + j, n_ - 1, -1);
                    const S even = weight * *share;
                    const S odd = S(sign) * even;
                    u_r[node] += odd * from[q];
                    u_r[n_ + node] += even * from[count + q];
                    u_z[node] += odd * from[2 * count + q];
                    u_z[n_ + node] += even * from[3 * count + q];
                }
            }
        }
    }

  private:
    Index n_;
    const ElementRules<S>& rules_;
    Index half_;
    Index order_;
    std::shared_ptr<const LocalStencils<S>> stencils_;
    LocalPolynomials<S> r_;
    LocalPolynomials<S> z_;
    Vector<S> speed_;  // the largest on each element
};

}  // namespace axistokes::detail
