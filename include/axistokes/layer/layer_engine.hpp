// SPDX-License-Identifier: MIT
// The matrix from nodal densities on a curve to the velocities that a layer of them causes,
//
//   single layer   u_a(x0) = 1/(8 pi) sum_b Int M_ab(x0, x) f_b(x) dl(x)                                          (1)
//   double layer   u_a(x0) = 1/(8 pi) sum_b Int Q_ab(x0, x) u_b(x) dl(x),   Q_ab = r Int_0^2pi T_abc n_c dphi     (2)
//
// with T_ijk = -6 X_i X_j X_k/|X|^5, X = x0 - x, and n outward. On the curve (2) is the principal value. Of a rigid
// translation e it is e inside (there X.n < 0 on average: 6 Int cos^2 over the unit sphere is 8 pi), e/2 on the curve
// where it is smooth, and 0 outside.
//
// Order of the rules: quadrature/element_rules.hpp. Targets far from a panel are served by fixed points, if the basis
// has any; for nearer ones the panel is halved until every part keeps the distance that a rule needs. From a target
// x(t0) on the panel itself, t = t0 + h s,
//
//   kernel = smooth + log_coefficient [2 log s + log(m1/s^2)],   m1 = |x - x0|^2/((r + r0)^2 + (z - z0)^2),       (3)
//
// where a product rule takes log s and the rest is smooth up to the mirror point (-r0, z0). The rule covers a part of
// the panel that keeps clear of it; what remains is a part like any other. The images of a wall are as far behind it as
// the targets are before it: their order follows as it does for targets abreast of a panel's middle.
//
// A basis knows the curve and how densities are interpolated on it:
//
//   size(), panels()                           nodes of the density; panels
//   begin(p), end(p), position(p, t)           a panel's range of the parameter; a point
//   length(p, begin, x1, end, x2)              of a part from x1 to x2, not below the chord's
//   rules(), least_order(), most_order()       Gauss-Legendre rules, and the fewest and most nodes on a part
//   least_product_order()                      the fewest on a part with a logarithm
//   fixed(normals), fixed_order()              points for far targets, panel by panel; how many a panel (0: none)
//   sides(i)                                   the parts of panels that begin at node i
//   evaluate(points, normals)                  see LayerPoints
//   spread(points, entries, to)                to += entries at points times weights and shares
//   weights(points, nodes)                     only where r and z are interpolated alike: that as a sparse matrix
//   corner(i)                                  only of curves with corners: what they lack of (2)'s e/2, times 8 pi
#pragma once

#include "../geometry/meridian.hpp"
#include "../quadrature/element_rules.hpp"
#include "../quadrature/regular_quadrature.hpp"
#include "layer_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// A part of a panel that begins at a node; `to` may be smaller than `from`.
template <class S>
struct PanelSide {
    Index panel;
    S from;
    S to;
};

/// Where node i joins the panels i - 1 and i, with t in [0, 1].
template <class S>
std::vector<PanelSide<S>> sides_of_joint(Index node, Index panels) {
    std::vector<PanelSide<S>> result;
    if (node > 0) {
        result.push_back({node - 1, S(1), S(0)});
    }
    if (node < panels) {
        result.push_back({node, S(0), S(1)});
    }
    return result;
}

/// Eq. (1).
template <class Kernel>
struct SingleLayer {
    using S = typename Kernel::Scalar;
    static constexpr bool normals = false;
    const Kernel& kernel;

    /// Adds what the images of a wall contribute; `points` belong to the quadrature.
    template <class Quadrature>
    void add_images(const Meridian<S>& targets, const Quadrature& quadrature, Matrix<S>& out) const {
        kernel.regular(
            targets, [&](const S& apart) { return quadrature(apart).first; }, out);
    }

    void entries(const Point<S>& target, const LayerPoints<S>& points, Index begin, Index n,
                 const KernelArrays<S>& out) const {
        kernel.singular(target, points.r.data() + begin, points.z.data() + begin, n, out);
    }
    void split(const Point<S>& target, const LayerPoints<S>& points, Index n, const KernelArrays<S>& smooth,
               const KernelArrays<S>& log_coefficient) const {
        kernel.singular_split(target, points.r.data(), points.z.data(), n, smooth, log_coefficient);
    }
};

/// Eq. (2).
template <class Kernel>
struct DoubleLayer {
    using S = typename Kernel::Scalar;
    static constexpr bool normals = true;
    const Kernel& kernel;

    /// Pair by pair.
    template <class Quadrature>
    void add_images(const Meridian<S>& targets, const Quadrature& quadrature, Matrix<S>& out) const {
        const auto [sources, points] = quadrature(S(0));
        Vector<S> n(2 * points.size());
        n << Eigen::Map<const Vector<S>>(points.normal_r.data(), points.size()),
            Eigen::Map<const Vector<S>>(points.normal_z.data(), points.size());
        kernel.regular_stress(targets, sources, n, out);
    }

    void entries(const Point<S>& target, const LayerPoints<S>& points, Index begin, Index n,
                 const KernelArrays<S>& out) const {
        kernel.stress(target, points.r.data() + begin, points.z.data() + begin, points.normal_r.data() + begin,
                      points.normal_z.data() + begin, n, out);
    }
    void split(const Point<S>& target, const LayerPoints<S>& points, Index n, const KernelArrays<S>& smooth,
               const KernelArrays<S>& log_coefficient) const {
        kernel.stress_split(target, points.r.data(), points.z.data(), points.normal_r.data(), points.normal_z.data(), n,
                            smooth, log_coefficient);
    }
};

/// Matrices are kept transposed until the end (entries_of): a target's entries are contiguous, for the kernel and for
/// the basis.
template <class Basis, class Layer>
class LayerAssembly {
    using S = typename Layer::S;

  public:
    LayerAssembly(const Basis& basis, const Layer& layer) : basis_(basis), layer_(layer) {
        for (Index p = 0; p < basis.panels(); ++p) {
            const Point<S> first = basis.position(p, basis.begin(p));
            // Panels that follow each other share an end, and the targets' distances to it.
            if (ends_.empty() || first.r != ends_.back().r || first.z != ends_.back().z) {
                ends_.push_back(first);
            }
            first_.push_back(ends_.size() - 1);
            ends_.push_back(basis.position(p, basis.end(p)));
            lengths_.push_back(basis.length(p, basis.begin(p), first, basis.end(p), ends_.back()));
        }
        to_end_.resize(ends_.size());
        using std::abs;
        S extent = 0;
        for (const Point<S>& x : ends_) {
            extent = std::max<S>(extent, abs(x.r) + abs(x.z));
        }
        resolution_ = 32 * std::numeric_limits<S>::epsilon() * extent;
    }

    /// 2 targets x 2 nodes, stacked [r; z]. `at_nodes`: the targets are the nodes.
    Matrix<S> matrix(const Meridian<S>& targets, bool at_nodes) {
        const Index rows = targets.nodes();
        const Index n = basis_.size();
        const LayerPoints<S> fixed = basis_.fixed(Layer::normals);
        Matrix<S> transposed = Matrix<S>::Zero(2 * n, 2 * rows);
        Matrix<S> far = Matrix<S>::Zero(2 * fixed.size(), 2 * rows);
        for (Index i = 0; i < rows; ++i) {
            target_ = {targets.r[i], targets.z[i]};
            near_.clear();
            add_near_points(at_nodes ? basis_.sides(i) : std::vector<PanelSide<S>>(), [&](Index begin, Index end) {
                layer_.entries(target_, fixed, begin, end - begin, entries_of(far, begin, i));
            });
            if (near_.size() > 0) {
                evaluate_near();
                basis_.spread(near_, entries_, transposed.middleCols(2 * i, 2));
            }
            if constexpr (Layer::normals && requires { basis_.corner(i); }) {
                if (at_nodes) {
                    const KernelArrays<S> diagonal = entries_of(transposed, i, i);
                    const KernelBlock<S> c = basis_.corner(i);
                    *diagonal.rr += c.rr;
                    *diagonal.rz += c.rz;
                    *diagonal.zr += c.zr;
                    *diagonal.zz += c.zz;
                }
            }
        }
        if (fixed.size() > 0) {
            basis_.spread(fixed, far, transposed);
        }
        Matrix<S> g(2 * rows, 2 * n);
        for (Index i = 0; i < rows; ++i) {
            g.row(i) = transposed.col(2 * i).transpose();
            g.row(rows + i) = transposed.col(2 * i + 1).transpose();
        }
        if constexpr (std::decay_t<decltype(layer_.kernel)>::has_images) {
            add_images(targets, fixed, g);
        }
        g *= S(1) / (8 * pi_value<S>());
        return g;
    }

  private:
    static constexpr int deepest_halving = 60;
    static constexpr Index most_parts = 1024;
    /// Least half-axis sum towards the mirror point in a product rule: m1 < 0.12 on its part of the panel. Closer to
    /// the axis the kernel's split is a difference of steep polynomials in m1.
    static constexpr int mirror_clearance = 7;

    static S distance(const Point<S>& a, const Point<S>& b) {
        using std::sqrt;
        return sqrt((a.r - b.r) * (a.r - b.r) + (a.z - b.z) * (a.z - b.z));
    }

    const Point<S>& first_end(Index p) const { return ends_[first_[static_cast<std::size_t>(p)]]; }
    const Point<S>& last_end(Index p) const { return ends_[first_[static_cast<std::size_t>(p)] + 1]; }

    /// Points for the present target, those of the product rules first. `far(begin, end)` is called for runs of fixed
    /// points that serve instead.
    template <class Far>
    void add_near_points(const std::vector<PanelSide<S>>& sides, const Far& far) {
        product_.clear();
        std::vector<std::pair<PanelSide<S>, Point<S>>> rest;
        for (const PanelSide<S>& side : sides) {
            const auto [cut, x] = add_product_rule(side);
            if (cut != side.to) {
                rest.push_back({{side.panel, cut, side.to}, x});
            }
        }
        for (const auto& [side, x] : rest) {
            const Point<S> last = basis_.position(side.panel, side.to);
            add_part(side.panel, side.from, x, distance(target_, x), side.to, last, distance(target_, last), 0);
        }
        for (std::size_t k = 0; k < ends_.size(); ++k) {
            to_end_[k] = distance(target_, ends_[k]);
        }
        const Index order = basis_.fixed_order();
        Index run = 0;
        for (Index p = 0; p < basis_.panels(); ++p) {
            const std::size_t k = first_[static_cast<std::size_t>(p)];
            if (!on_panel(sides, p)) {
                const Index n =
                    basis_.rules().order(to_end_[k] + to_end_[k + 1], lengths_[static_cast<std::size_t>(p)]);
                if (n != 0 && n <= order) {
                    continue;
                }
                add_part(p, basis_.begin(p), ends_[k], to_end_[k], basis_.end(p), ends_[k + 1], to_end_[k + 1], 0);
            }
            if (run < p && order > 0) {
                far(run * order, p * order);
            }
            run = p + 1;
        }
        if (run < basis_.panels() && order > 0) {
            far(run * order, basis_.panels() * order);
        }
    }

    static bool on_panel(const std::vector<PanelSide<S>>& sides, Index p) {
        for (const PanelSide<S>& side : sides) {
            if (side.panel == p) {
                return true;
            }
        }
        return false;
    }

    /// The part of a panel from x1 to x2, at the distances d1 and d2 from the target. Next to a target on the curve a
    /// part as short as round-off is left out: the integral over it is no larger, but its points may be the target.
    void add_part(Index p, const S& begin, const Point<S>& x1, const S& d1, const S& end, const Point<S>& x2,
                  const S& d2, int depth) {
        const Index n = order_on_part(S(d1 + d2), basis_.length(p, begin, x1, end, x2));
        if (n == 0) {
            if (depth == deepest_halving || d1 + d2 < resolution_) {
                return;
            }
            const S middle = (begin + end) / 2;
            const Point<S> x = basis_.position(p, middle);
            const S d = distance(target_, x);
            add_part(p, begin, x1, d1, middle, x, d, depth + 1);
            add_part(p, middle, x, d, end, x2, d2, depth + 1);
            return;
        }
        near_.add(p, begin, end, basis_.rules()[n]);
    }

    /// 0 if the part must be halved.
    Index order_on_part(const S& distance_sum, const S& length) const {
        const Index n = basis_.rules().order(distance_sum, length);
        return n > basis_.most_order() || n == 0 ? 0 : std::max(n, basis_.least_order());
    }

    /// From the target on: the parameter and the point up to which the product rule reaches.
    std::pair<S, Point<S>> add_product_rule(const PanelSide<S>& side) {
        S cut = side.to;
        Point<S> x = basis_.position(side.panel, cut);
        Index n = basis_.least_product_order();
        // On the axis there is no logarithm.
        if (target_.r > S(0)) {
            const Point<S> mirror{-target_.r, target_.z};
            const auto mirror_sum = [&] { return S(2 * target_.r + distance(mirror, x)); };
            for (int i = 0; i < deepest_halving && mirror_sum() < mirror_clearance * distance(target_, x); ++i) {
                cut = side.from + (cut - side.from) / 2;
                x = basis_.position(side.panel, cut);
            }
            // The product rule interpolates: rho^(-n) instead of rho^(-2n).
            n = std::clamp(2 * basis_.rules().order(mirror_sum(), distance(target_, x)), n, basis_.rules().largest());
        }
        const GaussLegendreRule<S>& rule = basis_.rules()[n];
        near_.add(side.panel, side.from, cut, rule);
        for (Index q = 0; q < n; ++q) {
            product_.push_back({rule.nodes[q] * rule.nodes[q], 2 * rule.log_weights[q] / rule.weights[q]});
        }
        return {cut, x};
    }

    /// The kernel at the near points; eq. (3) at those of the product rules.
    void evaluate_near() {
        using std::log;
        basis_.evaluate(near_, Layer::normals);
        const auto product = static_cast<Index>(product_.size());
        const Index count = near_.size();
        entries_.resize(2 * count, 2);
        if (count > product) {
            layer_.entries(target_, near_, product, count - product, entries_of(entries_, product, 0));
        }
        if (product == 0) {
            return;
        }
        log_entries_.resize(2 * product, 2);
        layer_.split(target_, near_, product, entries_of(entries_, 0, 0), entries_of(log_entries_, 0, 0));
        for (Index q = 0; q < product; ++q) {
            const auto k = static_cast<std::size_t>(q);
            const S dr = near_.r[k] - target_.r;
            const S sum = near_.r[k] + target_.r;
            const S dz = near_.z[k] - target_.z;
            const S m1 = (dr * dr + dz * dz) / (sum * sum + dz * dz);
            const S factor = log(S(m1 / product_[k].first)) + product_[k].second;
            for (Index c = 0; c < 2; ++c) {
                entries_(q, c) += factor * log_entries_(q, c);
                entries_(count + q, c) += factor * log_entries_(product + q, c);
            }
        }
    }

    /// The kernel's smooth part, for all targets at once. A basis that interpolates r and z differently goes by way of
    /// forces at the points.
    void add_images(const Meridian<S>& targets, const LayerPoints<S>& fixed, Matrix<S>& g) const {
        using std::isfinite;
        S nearest = layer_.kernel.gap({targets.r[0], targets.z[0]});
        for (Index i = 1; i < targets.nodes(); ++i) {
            nearest = std::min<S>(nearest, layer_.kernel.gap({targets.r[i], targets.z[i]}));
        }
        if (!isfinite(nearest)) {
            return;
        }
        if constexpr (requires { basis_.weights(fixed, Index()); }) {
            layer_.add_images(
                targets,
                [&](const S& apart) {
                    LayerPoints<S> points = image_points(fixed, nearest, apart);
                    RegularQuadrature<S> result = quadrature(points);
                    for (Index q = 0; q < points.size(); ++q) {
                        const Index p = points.panel[static_cast<std::size_t>(q)];
                        result.panel[q] = (first_end(p).z + last_end(p).z) / 2;
                    }
                    result.weights = basis_.weights(points, basis_.size());
                    return std::pair(std::move(result), std::move(points));
                },
                g);
        } else {
            const LayerPoints<S> points = image_points(fixed, nearest, S(0));
            RegularQuadrature<S> forces = quadrature(points);
            forces.weights.resize(points.size(), points.size());
            forces.weights.setIdentity();
            Matrix<S> m = Matrix<S>::Zero(2 * targets.nodes(), 2 * points.size());
            layer_.add_images(
                targets, [&](const S&) { return std::pair(forces, points); }, m);
            const Matrix<S> transposed = m.transpose();
            Matrix<S> sum = Matrix<S>::Zero(g.cols(), g.rows());
            basis_.spread(points, transposed, sum);
            g += sum.transpose();
        }
    }

    static RegularQuadrature<S> quadrature(const LayerPoints<S>& points) {
        const Vector<S> z = Eigen::Map<const Vector<S>>(points.z.data(), points.size());
        return {{Eigen::Map<const Vector<S>>(points.r.data(), points.size()), z}, z, {}};
    }

    /// Points for images of targets no closer to the wall than `nearest`, and that are no closer to the points than
    /// `apart` in any case.
    LayerPoints<S> image_points(const LayerPoints<S>& fixed, const S& nearest, const S& apart) const {
        using std::sqrt;
        LayerPoints<S> points;
        for (Index p = 0; p < basis_.panels(); ++p) {
            S gap = std::min<S>(layer_.kernel.gap(first_end(p)), layer_.kernel.gap(last_end(p)));
            for (Index q = p * basis_.fixed_order(); q < (p + 1) * basis_.fixed_order(); ++q) {
                const auto k = static_cast<std::size_t>(q);
                gap = std::min<S>(gap, layer_.kernel.gap({fixed.r[k], fixed.z[k]}));
            }
            const S closest = std::max<S>(apart, gap + nearest);
            Index parts = 1;
            const auto order = [&] {
                const S part = lengths_[static_cast<std::size_t>(p)] / S(parts);
                return order_on_part(S(2 * sqrt(S(part * part / 4 + closest * closest))), part);
            };
            Index n = order();
            while (n == 0 && parts < most_parts) {
                parts *= 2;
                n = order();
            }
            const S width = (basis_.end(p) - basis_.begin(p)) / S(parts);
            for (Index k = 0; k < parts; ++k) {
                points.add(p, basis_.begin(p) + S(k) * width, basis_.begin(p) + S(k + 1) * width,
                           basis_.rules()[n == 0 ? basis_.most_order() : n]);
            }
        }
        basis_.evaluate(points, Layer::normals);
        return points;
    }

    const Basis& basis_;
    const Layer layer_;
    std::vector<Point<S>> ends_;
    std::vector<std::size_t> first_;  // which of them a panel begins with; the next one is its other end
    std::vector<S> lengths_;          // of the panels
    S resolution_{};

    // Of the present target.
    Point<S> target_;
    std::vector<S> to_end_;
    LayerPoints<S> near_;
    std::vector<std::pair<S, S>> product_;  // s^2, and what 2 log s is at a node of the rule
    Matrix<S> entries_;
    Matrix<S> log_entries_;
};

template <class Basis, class Kernel>
Matrix<typename Kernel::Scalar> single_layer(const Basis& basis, const Kernel& kernel,
                                             const Meridian<typename Kernel::Scalar>& targets, bool at_nodes) {
    return LayerAssembly<Basis, SingleLayer<Kernel>>(basis, {kernel}).matrix(targets, at_nodes);
}

template <class Basis, class Kernel>
Matrix<typename Kernel::Scalar> double_layer(const Basis& basis, const Kernel& kernel,
                                             const Meridian<typename Kernel::Scalar>& targets, bool at_nodes) {
    return LayerAssembly<Basis, DoubleLayer<Kernel>>(basis, {kernel}).matrix(targets, at_nodes);
}

}  // namespace axistokes::detail
