// SPDX-License-Identifier: MIT
// The paper's P1 boundary elements: straight elements, linear densities, and quadrature that knows the kernel's
// singularity.
//
// Order of the rule: quadrature/element_rules.hpp; if it exceeds the largest the element is halved. When x0 is one of
// the ends, M = smooth + log_coefficient log(m1), and on a straight element m1 = L^2 t^2 / ((r + r0)^2 + (z - z0)^2): a
// product rule takes log t exactly, and the nearest singularity is the mirror point (-r0, z0).
#pragma once

#include "../geometry/spline_geometry.hpp"
#include "../quadrature/element_rules.hpp"
#include "../quadrature/kernel_row.hpp"
#include "../quadrature/regular_quadrature.hpp"
#include "linear_surface.hpp"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace axistokes {

/// Discretisation policy: P1 elements.
template <class S = double>
class LinearElements : public SplineGeometry<S> {
  public:
    using Scalar = S;
    using Surface = LinearSurface<S>;

    struct Params {
        /// Relative error allowed in each element's integrals, in (0, 0.1]. The elements themselves err by O(h^2).
        S tolerance = default_tolerance();
        MeshingParams<S> meshing;

        static S default_tolerance() {
            // Well below what hundreds of elements resolve (1e-5), and within reach of single precision.
            const S wanted = S(1e-6);
            const S reachable = 16 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument when the tolerance is not in (0, 0.1] or a meshing parameter is out of range.
    explicit LinearElements(Params params = {})
        : SplineGeometry<S>(params.meshing), params_(checked(params)), rules_(params.tolerance) {}

    const Params& params() const { return params_; }

    /// The same discretisation with integrals as coarse as `tolerance`.
    LinearElements loosened(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return LinearElements(std::move(params));
    }

    Surface surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) const {
        return linear_surface(meridian, parts);
    }

    /// u = G f for targets at the nodes: G is 2n x 2n, f and u are stacked [r; z]; f is a force density (kappa/R0^3), u
    /// a velocity (kappa/(eta R0^2)). Includes the factor 1/(8 pi).
    template <class Kernel>
    Matrix<S> single_layer(const Meridian<S>& meridian, const Kernel& kernel) const {
        return assemble(meridian, meridian, kernel, true);
    }

    /// As single_layer, for targets anywhere (targets on an element's interior integrate its logarithm by halving).
    template <class Kernel>
    Matrix<S> single_layer_at(const Meridian<S>& targets, const Meridian<S>& meridian, const Kernel& kernel) const {
        return assemble(targets, meridian, kernel, false);
    }

  private:
    static constexpr int deepest_halving = 60;
    /// Least half-axis sum towards the mirror point in a product rule: m1 < 0.12 on its part of the element. Closer to
    /// the axis the kernel's split is a difference of steep polynomials in m1.
    static constexpr int mirror_clearance = 7;

    static Params checked(Params params) {
        detail::require(params.tolerance > S(0) && params.tolerance <= S(0.1), "quadrature tolerance", params.tolerance,
                        "in (0, 0.1]");
        return params;
    }

    /// Quadrature points of one target, in arrays for the kernel, with the weights of the element's two hat functions.
    struct Points {
        std::vector<S> r, z, lower, upper;
        std::vector<Index> element;

        void clear() {
            r.clear();
            z.clear();
            lower.clear();
            upper.clear();
            element.clear();
        }
        void add(const Point<S>& p, const S& to_lower, const S& to_upper, Index e) {
            r.push_back(p.r);
            z.push_back(p.z);
            lower.push_back(to_lower);
            upper.push_back(to_upper);
            element.push_back(e);
        }
        Index size() const { return static_cast<Index>(r.size()); }
    };

    using Entries = detail::KernelEntries<S>;
    using Row = detail::KernelRow<S>;

    static S distance(const S& r0, const S& z0, const S& r, const S& z) {
        using std::sqrt;
        return sqrt((r - r0) * (r - r0) + (z - z0) * (z - z0));
    }

    template <class Kernel>
    Matrix<S> assemble(const Meridian<S>& targets, const Meridian<S>& m, const Kernel& kernel, bool at_nodes) const {
        const Index rows = targets.nodes();
        const Index n = m.nodes();
        const S scale = S(1) / (8 * detail::pi_value<S>());
        Matrix<S> g(2 * rows, 2 * n);
        Points points;
        Entries entries;
        Entries log_entries;
        Row row(n);
        Vector<S> to_node(n);
        for (Index i = 0; i < rows; ++i) {
            const Point<S> target{targets.r[i], targets.z[i]};
            for (Index j = 0; j < n; ++j) {
                to_node[j] = distance(target.r, target.z, m.r[j], m.z[j]);
            }
            points.clear();
            for (Index e = 0; e < m.elements(); ++e) {
                if (at_nodes && (e == i || e == i - 1)) {
                    continue;
                }
                add_element(m, e, S(0), S(1), target, to_node[e], to_node[e + 1], 0, points);
            }
            row.set_zero();
            accumulate(kernel, target, points, entries, row);
            if (at_nodes) {
                if (i > 0) {
                    add_singular_element(m, i - 1, target, false, kernel, points, entries, log_entries, row);
                }
                if (i < m.elements()) {
                    add_singular_element(m, i, target, true, kernel, points, entries, log_entries, row);
                }
            }
            row.store(scale, i, rows, g);
        }
        if constexpr (Kernel::has_images) {
            add_regular_part(targets, m, kernel, g);
        }
        return g;
    }

    /// The kernel's smooth part, for all targets at once.
    template <class Kernel>
    void add_regular_part(const Meridian<S>& targets, const Meridian<S>& m, const Kernel& kernel, Matrix<S>& g) const {
        using std::isfinite;
        S nearest = kernel.gap({targets.r[0], targets.z[0]});
        for (Index i = 1; i < targets.nodes(); ++i) {
            nearest = std::min<S>(nearest, kernel.gap({targets.r[i], targets.z[i]}));
        }
        if (!isfinite(nearest)) {
            return;
        }
        kernel.regular(
            targets, [&](const S& distance) { return regular_quadrature(m, kernel, nearest, distance); }, g);
    }

    /// Rules for integrands whose singularities are the targets' images, as far behind the wall as the targets, at
    /// least `nearest`, are before it, and no closer than `apart` in any case: the order follows as it does for
    /// targets.
    template <class Kernel>
    RegularQuadrature<S> regular_quadrature(const Meridian<S>& m, const Kernel& kernel, const S& nearest,
                                            const S& apart) const {
        Points points;
        for (Index e = 0; e < m.elements(); ++e) {
            const S length = distance(m.r[e], m.z[e], m.r[e + 1], m.z[e + 1]);
            const S gap = std::min<S>(kernel.gap({m.r[e], m.z[e]}), kernel.gap({m.r[e + 1], m.z[e + 1]}));
            const S closest = std::max<S>(apart, gap + nearest);
            const auto parts = static_cast<Index>(std::ceil(static_cast<double>(length / (2 * closest))));
            for (Index k = 0; k < parts; ++k) {
                add_rule(m, e, S(k) / S(parts), S(k + 1) / S(parts), regular_order(closest, length / S(parts)), points);
            }
        }
        RegularQuadrature<S> result;
        result.points = {Eigen::Map<const Vector<S>>(points.r.data(), points.size()),
                         Eigen::Map<const Vector<S>>(points.z.data(), points.size())};
        result.panel.resize(points.size());
        std::vector<Eigen::Triplet<S>> entries;
        const S scale = S(1) / (8 * detail::pi_value<S>());
        for (std::size_t q = 0; q < points.r.size(); ++q) {
            const auto lower = static_cast<int>(points.element[q]);
            result.panel[static_cast<Index>(q)] = (m.z[lower] + m.z[lower + 1]) / 2;
            entries.emplace_back(static_cast<int>(q), lower, scale * points.lower[q]);
            entries.emplace_back(static_cast<int>(q), lower + 1, scale * points.upper[q]);
        }
        result.weights.resize(points.size(), m.nodes());
        result.weights.setFromTriplets(entries.begin(), entries.end());
        return result;
    }

    /// Nodes for a singularity abreast of the middle of a part of an element, at `closest` from it.
    Index regular_order(const S& closest, const S& length) const {
        using std::sqrt;
        const Index n = rules_.order(2 * sqrt(length * length / 4 + closest * closest), length);
        return n == 0 ? rules_.largest() : n;
    }

    /// Points on the part [begin, end] of element e; `from`, `to` are the target's distances to the part's ends.
    void add_element(const Meridian<S>& m, Index e, const S& begin, const S& end, const Point<S>& target, const S& from,
                     const S& to, int depth, Points& points) const {
        const S dr = m.r[e + 1] - m.r[e];
        const S dz = m.z[e + 1] - m.z[e];
        const S length = distance(S(0), S(0), dr, dz);
        Index n = rules_.order(from + to, length * (end - begin));
        if (n == 0 && depth == deepest_halving) {
            n = rules_.largest();
        }
        if (n == 0) {
            const S middle = (begin + end) / 2;
            const S half = distance(target.r, target.z, m.r[e] + middle * dr, m.z[e] + middle * dz);
            add_element(m, e, begin, middle, target, from, half, depth + 1, points);
            add_element(m, e, middle, end, target, half, to, depth + 1, points);
            return;
        }
        add_rule(m, e, begin, end, n, points);
    }

    /// The rule with n nodes on the part [begin, end] of element e.
    void add_rule(const Meridian<S>& m, Index e, const S& begin, const S& end, Index n, Points& points) const {
        const S dr = m.r[e + 1] - m.r[e];
        const S dz = m.z[e + 1] - m.z[e];
        const S length = distance(S(0), S(0), dr, dz);
        const GaussLegendreRule<S>& rule = rules_[n];
        for (Index q = 0; q < n; ++q) {
            const S t = begin + rule.nodes[q] * (end - begin);
            const S w = rule.weights[q] * (end - begin) * length;
            points.add({m.r[e] + t * dr, m.z[e] + t * dz}, w * (S(1) - t), w * t, e);
        }
    }

    template <class Kernel>
    void accumulate(const Kernel& kernel, const Point<S>& target, const Points& points, Entries& entries,
                    Row& row) const {
        const KernelArrays<S> out = entries.arrays(points.size());
        kernel.singular(target, points.r.data(), points.z.data(), points.size(), out);
        for (std::size_t q = 0; q < points.r.size(); ++q) {
            add(row, points.element[q], points.lower[q], points.upper[q], entries[q]);
        }
    }

    static void add(Row& row, Index e, const S& lower, const S& upper, const KernelBlock<S>& m) {
        row.add(e, lower, m);
        row.add(e + 1, upper, m);
    }

    /// Element e with the target at one of its ends. The product rule covers the part of it, from the target on, that
    /// keeps clear of the mirror point; the rest is an element like any other.
    template <class Kernel>
    void add_singular_element(const Meridian<S>& m, Index e, const Point<S>& target, bool at_lower_end,
                              const Kernel& kernel, Points& points, Entries& entries, Entries& log_entries,
                              Row& row) const {
        using std::log;
        const Index other = at_lower_end ? e + 1 : e;
        const S dr = m.r[other] - target.r;
        const S dz = m.z[other] - target.z;
        S length = distance(S(0), S(0), dr, dz);
        Index n = ElementRules<S>::smallest_order;
        S part = 1;
        if (target.r > S(0)) {
            const auto mirror_sum = [&] {
                return 2 * target.r + distance(-target.r, S(0), target.r + part * dr, part * dz);
            };
            while (mirror_sum() < mirror_clearance * part * length) {
                part /= 2;
            }
            // The product rule interpolates: rho^(-n) instead of rho^(-2n).
            n = std::min(2 * rules_.order(mirror_sum(), part * length), rules_.largest());
        }
        if (part < S(1)) {
            const S near = part * length;
            points.clear();
            if (at_lower_end) {
                add_element(m, e, part, S(1), target, near, length, 0, points);
            } else {
                add_element(m, e, S(0), S(1) - part, target, length, near, 0, points);
            }
            accumulate(kernel, target, points, entries, row);
        }
        length *= part;
        const GaussLegendreRule<S>& rule = rules_[n];
        points.clear();
        for (Index q = 0; q < n; ++q) {
            const S t = part * rule.nodes[q];
            points.add({target.r + t * dr, target.z + t * dz}, at_lower_end ? S(1) - t : t, at_lower_end ? t : S(1) - t,
                       e);
        }
        kernel.singular_split(target, points.r.data(), points.z.data(), n, entries.arrays(n), log_entries.arrays(n));
        for (Index q = 0; q < n; ++q) {
            const auto k = static_cast<std::size_t>(q);
            const S sum = points.r[k] + target.r;
            const S offset = points.z[k] - target.z;
            const S w = length * rule.weights[q];
            const S wlog = w * log(length * length / (sum * sum + offset * offset)) + 2 * length * rule.log_weights[q];
            add(row, e, points.lower[k], points.upper[k],
                {w * entries.rr[k] + wlog * log_entries.rr[k], w * entries.rz[k] + wlog * log_entries.rz[k],
                 w * entries.zr[k] + wlog * log_entries.zr[k], w * entries.zz[k] + wlog * log_entries.zz[k]});
        }
    }

    Params params_;
    ElementRules<S> rules_;
};

}  // namespace axistokes
