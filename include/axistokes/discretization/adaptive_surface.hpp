// SPDX-License-Identifier: MIT
// Differential operators on a frozen meridian that is a piecewise polynomial in the node index (docs/adaptive.md,
// section 2): differences of high order at the nodes, sparse matrices. Tensions live in the middles of the elements.
#pragma once

#include "../geometry/local_polynomials.hpp"
#include "../geometry/meridian.hpp"
#include "../geometry/shape_changes.hpp"
#include "../geometry/stretches.hpp"
#include "../operators.hpp"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace axistokes {

/// Geometry and operators of a meridian with n nodes and n - 1 elements. Vector fields are stacked: n values of r, then
/// n of z.
template <class S>
struct AdaptiveSurface {
    using Operator = Eigen::SparseMatrix<S>;

    Meridian<S> nodes;
    Vector<S> arc_length;       // at the nodes, from the lower pole
    Vector<S> weight;           // quadrature weights of Int dA at the nodes
    Vector<S> volume_gradient;  // 2n: dV/dx of the volume inside the curve; the counterpart of weight * n
    Vector<S> normal_r;         // outward unit normal
    Vector<S> normal_z;
    Vector<S> mean_curvature;   // H > 0 on a sphere
    Vector<S> gauss_curvature;  // K = (n_r/r) (2 H - n_r/r); H^2 at the poles
    Vector<S> element_area;     // quadrature weights of Int dA in the middles of the elements

    Operator laplacian;          // n x n: Laplace-Beltrami operator of an axisymmetric scalar
    Operator mean_curvature_of;  // n x 2n: positions -> H, linear with normals and metric frozen
    Operator divergence;         // velocity -> its surface divergence in the middles of the elements
    Operator tension_force;      // tension there -> force density -2 gamma H n + grad_s gamma
    Operator tension_at_nodes;   // interpolation of the tension
    Operator tension_first;      // its derivative with respect to the node index, at the nodes
    CurveSamples<S> curve;       // at the nodes
    Index half_width = 0;

    Index size() const { return nodes.nodes(); }
    Vector<S> positions() const { return detail::stacked(nodes.r, nodes.z); }
    /// Unit normals, stacked.
    Vector<S> normals() const { return detail::stacked(normal_r, normal_z); }
    /// Operator -> scalar per node, as a stacked field along the frozen normals.
    Operator along_normal(const Operator& scalar) const { return detail::spread_along(normal_r, normal_z, scalar); }
    /// Int of a stacked field's normal component over the surface; exactly 0 for a translation.
    S flux(const Vector<S>& field) const { return volume_gradient.dot(field); }
    S area() const { return weight.sum(); }
    Vector<S> at_nodes(const Vector<S>& tension) const { return detail::applied(tension_at_nodes, tension); }
    /// Derivative along the meridian of nodal values; 0 at the poles.
    Vector<S> surface_gradient(const Vector<S>& values) const { return slopes(values).cwiseQuotient(curve.speed); }
    /// Surface divergence of a stacked nodal field, at the nodes.
    Vector<S> surface_divergence(const Vector<S>& field) const { return at_nodes(detail::applied(divergence, field)); }
    /// See DifferentiableSurface.
    Operator change(const NodalChange<S>& c) const {
        detail::Triplets<S> entries;
        add_change(entries, 0, c);
        return detail::assembled(size(), 2 * size(), entries);
    }
    Operator changes(const NodalChange<S>& upper, const NodalChange<S>& lower) const {
        detail::Triplets<S> entries;
        add_change(entries, 0, upper);
        add_change(entries, size(), lower);
        return detail::assembled(2 * size(), 2 * size(), entries);
    }
    Vector<S> slopes(const Vector<S>& values) const {
        return detail::differences(values, detail::local_stencils<S>(half_width)->first, 1, half_width);
    }
    Vector<S> second_slopes(const Vector<S>& values) const {
        return detail::differences(values, detail::local_stencils<S>(half_width)->second, 1, half_width);
    }
    Vector<S> tension_slopes(const Vector<S>& tension) const { return detail::applied(tension_first, tension); }

    /// Of the material that lay on `reference`, node by node.
    Stretches<S> stretches(const AdaptiveSurface& reference) const {
        return detail::stretches_of<S>(curve.speed.cwiseQuotient(reference.curve.speed), nodes.r, reference.nodes.r);
    }

  private:
    void add_change(detail::Triplets<S>& entries, Index first_row, const NodalChange<S>& c) const {
        const auto stencils = detail::local_stencils<S>(half_width);
        const Index n = size();
        for (Index i = 0; i < n; ++i) {
            detail::add_entry(entries, first_row + i, i, c.r[i]);
            for (Index k = 0; k <= 2 * half_width; ++k) {
                const auto [node, sign] = detail::reflection(i + k - half_width, n - 1, -1);
                const S of_r = c.r1[i] * stencils->first[k] + c.r2[i] * stencils->second[k];
                const S of_z = c.z1[i] * stencils->first[k] + c.z2[i] * stencils->second[k];
                detail::add_entry(entries, first_row + i, node, S(sign) * of_r);
                detail::add_entry(entries, first_row + i, n + node, of_z);
            }
        }
    }
};

namespace detail {

template <class S>
class AdaptiveSurfaceBuilder {
  public:
    AdaptiveSurfaceBuilder(const Meridian<S>& meridian, Index half)
        : half_(half), stencils_(local_stencils<S>(half)), n_(meridian.nodes()) {
        s_.nodes = meridian;
        s_.half_width = half;
    }

    AdaptiveSurface<S> build(SurfaceParts parts) {
        metric();
        integrals();
        if (parts == SurfaceParts::all) {
            laplacian();
            curvatures();
            tension();
        }
        return std::move(s_);
    }

  private:
    using Operator = typename AdaptiveSurface<S>::Operator;

    /// A difference at every node: `row(i)` times the stencil.
    template <class Row>
    void add_differences(Triplets<S>& entries, const Vector<S>& stencil, int parity, const Row& row) const {
        for (Index i = 0; i < n_; ++i) {
            for (Index k = 0; k <= 2 * half_; ++k) {
                const auto [node, sign] = reflection(i + k - half_, n_ - 1, parity);
                add_entry(entries, i, node, S(sign) * stencil[k] * row(i));
            }
        }
    }

    void metric() {
        s_.curve = local_curve(s_.nodes, half_);
        std::tie(s_.normal_r, s_.normal_z) = s_.curve.normals();
    }

    /// Weights of Int dA of a nodal function, and the gradient of the volume pi Int r^2 z' dt.
    void integrals() {
        const Index q = 2 * half_;
        const auto rules = computed_once<GaussLegendreTable<S>>(q);
        const GaussLegendreRule<S>& rule = (*rules)[q];
        const LocalPolynomials<S> r(s_.nodes.r, -1, half_);
        const LocalPolynomials<S> z(s_.nodes.z, 1, half_);
        // The cardinal functions and their slopes at the rule's points.
        Matrix<S> value(2 * half_, q);
        Matrix<S> slope(2 * half_, q);
        for (Index k = 0; k < q; ++k) {
            const S x = rule.nodes[k] - S(1) / 2;
            for (Index j = 0; j < 2 * half_; ++j) {
                S f = 0;
                S f1 = 0;
                for (Index p = 2 * half_ - 1; p >= 0; --p) {
                    f1 = f1 * x + f;
                    f = f * x + stencils_->cardinals(p, j);
                }
                value(j, k) = f;
                slope(j, k) = f1;
            }
        }
        s_.weight = Vector<S>::Zero(n_);
        s_.volume_gradient = Vector<S>::Zero(2 * n_);
        s_.arc_length.resize(n_);
        s_.arc_length[0] = 0;
        using std::sqrt;
        const S two_pi = 2 * pi_value<S>();
        for (Index e = 0; e + 1 < n_; ++e) {
            S length = 0;
            for (Index k = 0; k < q; ++k) {
                const S& t = rule.nodes[k];
                const S rq = r.value(e, t);
                const S r1 = r.slope(e, t);
                const S z1 = z.slope(e, t);
                const S speed = sqrt(S(r1 * r1 + z1 * z1));
                length += rule.weights[k] * speed;
                const S ring = two_pi * rule.weights[k] * rq;
                for (Index j = 0; j < 2 * half_; ++j) {
                    const Index i = e + 1 - half_ + j;
                    const auto [node, sign] = reflection(i, n_ - 1, -1);
                    s_.weight[node] += ring * speed * value(j, k);
                    s_.volume_gradient[node] += S(sign) * ring * z1 * value(j, k);
                    s_.volume_gradient[n_ + node] -= ring * r1 * value(j, k);
                }
            }
            s_.arc_length[e + 1] = s_.arc_length[e] + length;
        }
        s_.volume_gradient[0] = s_.volume_gradient[n_ - 1] = 0;
    }

    void laplacian() {
        std::tie(first_, second_) = s_.curve.laplacian_factors();
        Triplets<S> entries;
        add_differences(entries, stencils_->second, 1, [&](Index i) { return second_[i]; });
        add_differences(entries, stencils_->first, 1, [&](Index i) { return first_[i]; });
        s_.laplacian = assembled(n_, n_, entries);
    }

    /// Lap_s x = -2 H n, where the radial component of the vector x is Lap_s r - r/r^2 (its unit vector turns with the
    /// azimuth); 1/r^2 belongs to the frozen metric.
    void curvatures() {
        Triplets<S> entries;
        add_differences(entries, stencils_->second, -1, [&](Index i) { return s_.normal_r[i] * second_[i] / S(-2); });
        add_differences(entries, stencils_->first, -1, [&](Index i) { return s_.normal_r[i] * first_[i] / S(-2); });
        for_each_entry(s_.laplacian, [&](Index i, Index j, const S& value) {
            add_entry(entries, i, n_ + j, s_.normal_z[i] * value / S(-2));
        });
        for (Index i = 1; i + 1 < n_; ++i) {
            add_entry(entries, i, i, s_.normal_r[i] / (2 * s_.nodes.r[i] * s_.nodes.r[i]));
        }
        s_.mean_curvature_of = assembled(n_, 2 * n_, entries);
        s_.mean_curvature = applied(s_.mean_curvature_of, s_.positions());
        s_.gauss_curvature = s_.mean_curvature.cwiseAbs2();
        for (Index i = 1; i + 1 < n_; ++i) {
            const S azimuthal = s_.normal_r[i] / s_.nodes.r[i];
            s_.gauss_curvature[i] = azimuthal * (2 * s_.mean_curvature[i] - azimuthal);
        }
    }

    /// div_s u = x'.u'/|x'|^2 + u_r/r.
    void tension() {
        const Index elements = n_ - 1;
        const Vector<S> all_r = continued(s_.nodes.r, -1, half_);
        const Vector<S> all_z = continued(s_.nodes.z, 1, half_);
        Triplets<S> divergence;
        for (Index e = 0; e < elements; ++e) {
            const S r = stencils_->middle.dot(all_r.segment(e + 1, 2 * half_));
            const S r1 = stencils_->middle_slope.dot(all_r.segment(e + 1, 2 * half_));
            const S z1 = stencils_->middle_slope.dot(all_z.segment(e + 1, 2 * half_));
            const S v2 = r1 * r1 + z1 * z1;
            for (Index k = 0; k < 2 * half_; ++k) {
                const Index i = e + 1 - half_ + k;
                const auto [node, sign] = reflection(i, n_ - 1, -1);
                const S of_r = r1 / v2 * stencils_->middle_slope[k] + stencils_->middle[k] / r;
                add_entry(divergence, e, node, S(sign) * of_r);
                add_entry(divergence, e, n_ + node, z1 / v2 * stencils_->middle_slope[k]);
            }
        }
        s_.divergence = assembled(elements, 2 * n_, divergence);

        Triplets<S> at_nodes;
        Triplets<S> slopes;
        Triplets<S> force;
        for (Index i = 0; i < n_; ++i) {
            const S v2 = s_.curve.speed[i] * s_.curve.speed[i];
            const S pull = -2 * s_.mean_curvature[i];
            for (Index k = 0; k < 2 * half_; ++k) {
                const Index e = reflected_middle(i - half_ + k, elements);
                const S value = stencils_->middle[k];
                const S slope = stencils_->middle_slope[k];
                add_entry(at_nodes, i, e, value);
                add_entry(slopes, i, e, slope);
                add_entry(force, i, e, pull * s_.normal_r[i] * value + s_.curve.r1[i] / v2 * slope);
                add_entry(force, n_ + i, e, pull * s_.normal_z[i] * value + s_.curve.z1[i] / v2 * slope);
            }
        }
        s_.tension_at_nodes = assembled(n_, elements, at_nodes);
        s_.tension_first = assembled(n_, elements, slopes);
        s_.tension_force = assembled(2 * n_, elements, force);
        s_.element_area = Vector<S>::Zero(elements);
        for_each_entry(s_.tension_at_nodes,
                       [&](Index i, Index e, const S& value) { s_.element_area[e] += value * s_.weight[i]; });
    }

    Index half_;
    std::shared_ptr<const LocalStencils<S>> stencils_;
    Index n_;
    AdaptiveSurface<S> s_;
    Vector<S> first_, second_;  // the Laplacian's factors of f' and f''
};

}  // namespace detail

/// Operators of `meridian`, which must be valid (see validate), of order 2 half_width.
template <class S>
AdaptiveSurface<S> adaptive_surface(const Meridian<S>& meridian, Index half_width,
                                    SurfaceParts parts = SurfaceParts::all) {
    return detail::AdaptiveSurfaceBuilder<S>(meridian, half_width).build(parts);
}

}  // namespace axistokes
