// SPDX-License-Identifier: MIT
// A curve of panels with p Gauss-Legendre nodes each, and the single layer on it: geometry and density are the
// polynomials through a panel's nodes, targets are the nodes themselves or points off the curve.
//
// A target far from a panel is served by the panel's own nodes. A near one needs a finer rule on it, or on the parts of
// it that repeated halving leaves (quadrature/element_rules.hpp); density and geometry are interpolated to its nodes.
// For a target x(t0) on the panel itself the panel is cut at t0, and on either side, t = t0 + h s,
//   M = smooth + log_coefficient [2 log s + log(|x - x0|^2 / (s^2 D^2))],   D^2 = (r + r0)^2 + (z - z0)^2,
// where log s is left to a product rule and the rest is smooth, up to the mirror point (-r0, z0).
#pragma once

#include "../geometry/meridian_spline.hpp"
#include "../quadrature/element_rules.hpp"
#include "../quadrature/kernel_row.hpp"
#include "../quadrature/lagrange_basis.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axistokes {

template <class S>
class PanelCurve {
  public:
    /// Throws InvalidArgument unless there are at least 2 nodes a panel and the tolerance is in (0, 0.1].
    PanelCurve(Index nodes_per_panel, const S& tolerance)
        : p_(checked(nodes_per_panel, tolerance)),
          rules_(tolerance, 2 * nodes_per_panel),
          basis_(rules_[nodes_per_panel].nodes) {}

    /// Appends the panel x(t), 0 <= t <= 1, given as a function t -> CurvePoint. The curve runs so that the outward
    /// normal is to the right of it, as on a Meridian.
    template <class Curve>
    void append(const Curve& curve) {
        const Index old = nodes_.nodes();
        nodes_.r.conservativeResize(old + p_);
        nodes_.z.conservativeResize(old + p_);
        speed_.conservativeResize(old + p_);
        normal_r_.conservativeResize(old + p_);
        normal_z_.conservativeResize(old + p_);
        for (Index k = 0; k < p_; ++k) {
            const CurvePoint<S> x = curve(rules_[p_].nodes[k]);
            nodes_.r[old + k] = x.position.r;
            nodes_.z[old + k] = x.position.z;
            speed_[old + k] = x.speed();
            normal_r_[old + k] = x.normal().r;
            normal_z_[old + k] = x.normal().z;
        }
    }

    Index size() const { return nodes_.nodes(); }
    Index panels() const { return size() / p_; }
    Index nodes_per_panel() const { return p_; }
    const Meridian<S>& nodes() const { return nodes_; }

    /// Point of a panel at t in [0, 1].
    Point<S> position(Index panel, const S& t) const {
        Vector<S> basis;
        basis_.evaluate(t, basis);
        return {basis.dot(nodes_.r.segment(panel * p_, p_)), basis.dot(nodes_.z.segment(panel * p_, p_))};
    }
    /// |dx/dt| there.
    S speed(Index panel, const S& t) const {
        Vector<S> basis;
        basis_.evaluate(t, basis);
        return basis.dot(speed_.segment(panel * p_, p_));
    }

    /// Weights of Int dl at the nodes.
    Vector<S> line_weights() const {
        Vector<S> w(size());
        for (Index e = 0; e < panels(); ++e) {
            w.segment(e * p_, p_) = speed_.segment(e * p_, p_).cwiseProduct(rules_[p_].weights);
        }
        return w;
    }
    /// Weights of Int dA at the nodes.
    Vector<S> weights() const { return 2 * detail::pi_value<S>() * line_weights().cwiseProduct(nodes_.r); }
    /// Outward unit normals, stacked.
    Vector<S> normals() const {
        Vector<S> n(2 * size());
        n << normal_r_, normal_z_;
        return n;
    }

    /// Nodal force densities, stacked [r; z], to the velocities they cause at the nodes (with the factor 1/(8 pi)).
    template <class Kernel>
    Matrix<S> single_layer(const Kernel& kernel) const {
        return assemble(nodes_, kernel, true);
    }
    /// The same for targets that are not on the curve.
    template <class Kernel>
    Matrix<S> single_layer_at(const Meridian<S>& targets, const Kernel& kernel) const {
        return assemble(targets, kernel, false);
    }

  private:
    static constexpr int deepest_halving = 60;
    /// As in LinearElements.
    static constexpr int mirror_clearance = 7;

    static Index checked(Index nodes_per_panel, const S& tolerance) {
        detail::require(nodes_per_panel >= 2, "nodes per panel", nodes_per_panel, "at least 2");
        detail::require(tolerance > S(0) && tolerance <= S(0.1), "panel tolerance", tolerance, "in (0, 0.1]");
        return nodes_per_panel;
    }

    /// Quadrature points on one panel for one target: positions, the share of each of the panel's p densities, and
    /// the kernel's entries.
    struct Points {
        std::vector<S> r, z, to_node;
        detail::KernelEntries<S> entries, log_entries;

        void clear() {
            r.clear();
            z.clear();
            to_node.clear();
        }
        Index size() const { return static_cast<Index>(r.size()); }
    };
    using Row = detail::KernelRow<S>;

    static S distance(const Point<S>& a, const Point<S>& b) {
        using std::sqrt;
        return sqrt((a.r - b.r) * (a.r - b.r) + (a.z - b.z) * (a.z - b.z));
    }

    /// A point at t whose weight for Int ... dt is w.
    void add_point(Index panel, const S& t, const S& w, Vector<S>& basis, Points& points) const {
        basis_.evaluate(t, basis);
        points.r.push_back(basis.dot(nodes_.r.segment(panel * p_, p_)));
        points.z.push_back(basis.dot(nodes_.z.segment(panel * p_, p_)));
        const S dl = w * basis.dot(speed_.segment(panel * p_, p_));
        for (Index k = 0; k < p_; ++k) {
            points.to_node.push_back(dl * basis[k]);
        }
    }

    /// Points on the part [begin, end] of a panel, which reaches from x1 to x2.
    void add_part(Index panel, const S& begin, const Point<S>& x1, const S& end, const Point<S>& x2,
                  const Point<S>& target, int depth, Points& points) const {
        const S length = distance(x1, x2);
        Index n = rules_.order(distance(target, x1) + distance(target, x2), length);
        if (n == 0 && depth == deepest_halving) {
            n = rules_.largest();
        }
        if (n == 0) {
            const S middle = (begin + end) / 2;
            const Point<S> x = position(panel, middle);
            add_part(panel, begin, x1, middle, x, target, depth + 1, points);
            add_part(panel, middle, x, end, x2, target, depth + 1, points);
            return;
        }
        n = std::max(n, (p_ + 1) / 2);
        const GaussLegendreRule<S>& rule = rules_[n];
        Vector<S> basis;
        for (Index q = 0; q < n; ++q) {
            add_point(panel, begin + rule.nodes[q] * (end - begin), rule.weights[q] * (end - begin), basis, points);
        }
    }

    void add_to_row(Index panel, Index point, const Points& points, const KernelBlock<S>& m, Row& row) const {
        const S* share = points.to_node.data() + point * p_;
        for (Index k = 0; k < p_; ++k) {
            row.add(panel * p_ + k, share[k], m);
        }
    }

    template <class Kernel>
    void accumulate(const Kernel& kernel, Index panel, const Point<S>& target, Points& points, Row& row) const {
        const Index n = points.size();
        kernel.singular(target, points.r.data(), points.z.data(), n, points.entries.arrays(n));
        for (Index q = 0; q < n; ++q) {
            add_to_row(panel, q, points, points.entries[static_cast<std::size_t>(q)], row);
        }
    }

    /// The side of the panel from t0 to `end` (0 or 1) for a target at t0. The product rule covers the part of it, from
    /// the target on, that keeps clear of the mirror point; the rest is a part like any other.
    template <class Kernel>
    void add_singular_side(const Kernel& kernel, Index panel, const Point<S>& target, const S& t0, const S& end,
                           Points& points, Row& row) const {
        using std::abs;
        using std::log;
        const Point<S> last = position(panel, end);
        const Point<S> mirror{-target.r, target.z};
        S h = end - t0;
        Point<S> x = last;
        const auto mirror_sum = [&] { return 2 * target.r + distance(mirror, x); };
        while (mirror_sum() < mirror_clearance * distance(target, x)) {
            h /= 2;
            x = position(panel, t0 + h);
        }
        if (t0 + h != end) {
            points.clear();
            if (h > S(0)) {
                add_part(panel, t0 + h, x, end, last, target, 0, points);
            } else {
                add_part(panel, end, last, t0 + h, x, target, 0, points);
            }
            accumulate(kernel, panel, target, points, row);
        }
        // The product rule interpolates: rho^(-n) instead of rho^(-2n), and the density has degree p - 1.
        const Index wanted = std::max(2 * rules_.order(mirror_sum(), distance(target, x)), p_ + 4);
        const Index n = std::min(wanted, rules_.largest());
        const GaussLegendreRule<S>& rule = rules_[n];
        points.clear();
        Vector<S> basis;
        for (Index q = 0; q < n; ++q) {
            add_point(panel, t0 + h * rule.nodes[q], abs(h), basis, points);
        }
        kernel.singular_split(target, points.r.data(), points.z.data(), n, points.entries.arrays(n),
                              points.log_entries.arrays(n));
        for (Index q = 0; q < n; ++q) {
            const auto k = static_cast<std::size_t>(q);
            const S sum = points.r[k] + target.r;
            const S offset = points.z[k] - target.z;
            const S d = distance(target, {points.r[k], points.z[k]}) / rule.nodes[q];
            const S w = rule.weights[q];
            const S wlog = w * log(d * d / (sum * sum + offset * offset)) + 2 * rule.log_weights[q];
            const KernelBlock<S> smooth = points.entries[k];
            const KernelBlock<S> logarithm = points.log_entries[k];
            add_to_row(panel, q, points,
                       {w * smooth.rr + wlog * logarithm.rr, w * smooth.rz + wlog * logarithm.rz,
                        w * smooth.zr + wlog * logarithm.zr, w * smooth.zz + wlog * logarithm.zz},
                       row);
        }
    }

    template <class Kernel>
    Matrix<S> assemble(const Meridian<S>& targets, const Kernel& kernel, bool at_nodes) const {
        const S scale = S(1) / (8 * detail::pi_value<S>());
        const Index rows = targets.nodes();
        const Index n = size();
        const Vector<S> weights = line_weights();
        std::vector<Point<S>> ends;
        for (Index e = 0; e < panels(); ++e) {
            ends.push_back(position(e, S(0)));
            ends.push_back(position(e, S(1)));
        }
        Matrix<S> g(2 * rows, 2 * n);
        Points near;
        Points far;
        std::vector<Index> far_nodes;
        Row row(n);
        for (Index i = 0; i < rows; ++i) {
            const Point<S> target{targets.r[i], targets.z[i]};
            row.set_zero();
            far.clear();
            far_nodes.clear();
            for (Index e = 0; e < panels(); ++e) {
                if (at_nodes && e == i / p_) {
                    const S t0 = rules_[p_].nodes[i % p_];
                    add_singular_side(kernel, e, target, t0, S(0), near, row);
                    add_singular_side(kernel, e, target, t0, S(1), near, row);
                    continue;
                }
                const Point<S>& x1 = ends[static_cast<std::size_t>(2 * e)];
                const Point<S>& x2 = ends[static_cast<std::size_t>(2 * e + 1)];
                const Index order = rules_.order(distance(target, x1) + distance(target, x2), distance(x1, x2));
                if (order == 0 || order > p_) {
                    near.clear();
                    add_part(e, S(0), x1, S(1), x2, target, 0, near);
                    accumulate(kernel, e, target, near, row);
                    continue;
                }
                for (Index k = e * p_; k < (e + 1) * p_; ++k) {
                    far.r.push_back(nodes_.r[k]);
                    far.z.push_back(nodes_.z[k]);
                    far_nodes.push_back(k);
                }
            }
            kernel.singular(target, far.r.data(), far.z.data(), far.size(), far.entries.arrays(far.size()));
            for (std::size_t q = 0; q < far_nodes.size(); ++q) {
                row.add(far_nodes[q], weights[far_nodes[q]], far.entries[q]);
            }
            row.store(scale, i, rows, g);
        }
        return g;
    }

    Index p_;
    ElementRules<S> rules_;
    LagrangeBasis<S> basis_;
    Meridian<S> nodes_;
    Vector<S> speed_;  // |dx/dt|
    Vector<S> normal_r_;
    Vector<S> normal_z_;
};

}  // namespace axistokes
