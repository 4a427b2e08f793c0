// SPDX-License-Identifier: MIT
// Panels of p Gauss-Legendre nodes each, geometry and densities the polynomials through them, as a basis of a layer
// (layer_engine.hpp). Panels have t in [0, 1], and far targets are served by the nodes.
#pragma once

#include "../quadrature/lagrange_basis.hpp"
#include "layer_engine.hpp"

#include <cmath>
#include <vector>

namespace axistokes::detail {

template <class S>
class PanelBasis : public LocalShares<S, Eigen::Dynamic> {
  public:
    PanelBasis(Index nodes_per_panel, const S& tolerance)
        : LocalShares<S, Eigen::Dynamic>(nodes_per_panel, nodes_per_panel),
          p_(nodes_per_panel),
          rules_(tolerance, 2 * nodes_per_panel),
          basis_(rules_[nodes_per_panel].nodes) {}

    /// |dx/dt| at the new panel's nodes, besides their positions.
    void append(const Vector<S>& r, const Vector<S>& z, const Vector<S>& speed) {
        const Index old = size();
        for (Vector<S>* values : {&nodes_.r, &nodes_.z, &speed_}) {
            values->conservativeResize(old + p_);
        }
        nodes_.r.tail(p_) = r;
        nodes_.z.tail(p_) = z;
        speed_.tail(p_) = speed;
    }

    Index size() const { return nodes_.nodes(); }
    Index panels() const { return size() / p_; }
    const Meridian<S>& nodes() const { return nodes_; }
    const ElementRules<S>& rules() const { return rules_; }
    Index least_order() const { return (p_ + 1) / 2; }
    Index most_order() const { return rules_.largest(); }
    /// The density has degree p - 1.
    Index least_product_order() const { return std::min(p_ + 4, rules_.largest()); }

    S begin(Index) const { return S(0); }
    S end(Index) const { return S(1); }
    Point<S> position(Index panel, const S& t) const {
        return {interpolated(nodes_.r, panel, t), interpolated(nodes_.z, panel, t)};
    }
    S speed(Index panel, const S& t) const { return interpolated(speed_, panel, t); }
    S length(Index, const S&, const Point<S>& x1, const S&, const Point<S>& x2) const {
        using std::sqrt;
        return sqrt((x1.r - x2.r) * (x1.r - x2.r) + (x1.z - x2.z) * (x1.z - x2.z));
    }

    /// Weights of Int dl at the nodes.
    Vector<S> line_weights() const { return speed_.cwiseProduct(rules_[p_].weights.replicate(panels(), 1)); }

    Index fixed_order() const { return p_; }
    LayerPoints<S> fixed(bool normals) const {
        LayerPoints<S> points;
        for (Index e = 0; e < panels(); ++e) {
            points.add(e, S(0), S(1), rules_[p_]);
        }
        evaluate(points, normals);
        points.shares.clear();
        return points;
    }

    std::vector<PanelSide<S>> sides(Index node) const {
        const S& t = rules_[p_].nodes[node % p_];
        return {{node / p_, t, S(0)}, {node / p_, t, S(1)}};
    }

    /// Normals are those of the polynomials: X.n then vanishes at the target as it must.
    void evaluate(LayerPoints<S>& points, bool normals) const {
        using std::sqrt;
        const std::size_t count = points.t.size();
        points.r.resize(count);
        points.z.resize(count);
        points.normal_r.resize(normals ? count : 0);
        points.normal_z.resize(normals ? count : 0);
        points.shares.resize(count * static_cast<std::size_t>(p_));
        Vector<S> slopes;
        for (std::size_t q = 0; q < count; ++q) {
            Eigen::Map<Vector<S>> shares(&points.shares[q * static_cast<std::size_t>(p_)], p_);
            const Index first = points.panel[q] * p_;
            basis_.evaluate(points.t[q], shares);
            points.r[q] = shares.dot(nodes_.r.segment(first, p_));
            points.z[q] = shares.dot(nodes_.z.segment(first, p_));
            points.weight[q] *= shares.dot(speed_.segment(first, p_));
            if (normals) {
                slopes.noalias() = basis_.differentiation().transpose() * shares;
                const S r1 = slopes.dot(nodes_.r.segment(first, p_));
                const S z1 = slopes.dot(nodes_.z.segment(first, p_));
                const S speed = sqrt(S(r1 * r1 + z1 * z1));
                points.normal_r[q] = z1 / speed;
                points.normal_z[q] = -r1 / speed;
            }
        }
    }

  private:
    S interpolated(const Vector<S>& values, Index panel, const S& t) const {
        Vector<S> shares(p_);
        basis_.evaluate(t, shares);
        return shares.dot(values.segment(panel * p_, p_));
    }

    Index p_;
    ElementRules<S> rules_;
    LagrangeBasis<S> basis_;
    Meridian<S> nodes_;
    Vector<S> speed_;
};

}  // namespace axistokes::detail
