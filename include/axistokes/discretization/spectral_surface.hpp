// SPDX-License-Identifier: MIT
// Differential operators on a frozen meridian whose coordinates are a sine and a cosine series (docs/spectral.md,
// section 2): collocation at the nodes, dense matrices.
#pragma once

#include "../geometry/meridian.hpp"
#include "../geometry/shape_changes.hpp"
#include "../geometry/stretches.hpp"
#include "../geometry/trigonometric.hpp"
#include "../operators.hpp"

#include <cmath>
#include <memory>
#include <tuple>

namespace axistokes {

/// Geometry and operators of a meridian with n = N + 1 nodes. Vector fields are stacked: n values of r, then n of z.
template <class S>
struct SpectralSurface {
    using Operator = Matrix<S>;

    Meridian<S> nodes;
    Vector<S> arc_length;       // at the nodes, from the lower pole
    Vector<S> weight;           // quadrature weights of Int dA at the nodes
    Vector<S> volume_gradient;  // 2n: dV/dx of the volume inside the curve; the counterpart of weight * n
    Vector<S> normal_r;         // outward unit normal
    Vector<S> normal_z;
    Vector<S> mean_curvature;   // H > 0 on a sphere
    Vector<S> gauss_curvature;  // K = (n_r/r) (2 H - n_r/r); H^2 at the poles
    Vector<S> element_area;     // quadrature weights of Int dA at the tension's nodes

    Operator laplacian;          // n x n: Laplace-Beltrami operator of an axisymmetric scalar
    Operator mean_curvature_of;  // n x 2n: positions -> H, linear with normals and metric frozen
    Operator divergence;         // velocity -> its surface divergence at the tension's nodes
    Operator tension_force;      // tension at its nodes -> force density -2 gamma H n + grad_s gamma
    Operator tension_at_nodes;   // interpolation of the tension

    CurveSamples<S> curve;  // at the nodes
    std::shared_ptr<const TrigonometricBasis<S>> basis;

    Index size() const { return nodes.nodes(); }
    Vector<S> positions() const { return detail::stacked(nodes.r, nodes.z); }
    /// Unit normals, stacked.
    Vector<S> normals() const { return detail::stacked(normal_r, normal_z); }
    /// Operator -> scalar per node, as a stacked field along the frozen normals.
    Operator along_normal(const Operator& scalar) const {
        Operator spread(2 * size(), scalar.cols());
        spread.topRows(size()) = normal_r.asDiagonal() * scalar;
        spread.bottomRows(size()) = normal_z.asDiagonal() * scalar;
        return spread;
    }
    /// Int of a stacked field's normal component over the surface; exactly 0 for a translation.
    S flux(const Vector<S>& field) const { return volume_gradient.dot(field); }
    S area() const { return weight.sum(); }
    Vector<S> at_nodes(const Vector<S>& tension) const { return tension_at_nodes * tension; }
    /// Derivative along the meridian of nodal values; 0 at the poles.
    Vector<S> surface_gradient(const Vector<S>& values) const { return slopes(values).cwiseQuotient(curve.speed); }
    /// Surface divergence of a stacked nodal field, at the nodes.
    Vector<S> surface_divergence(const Vector<S>& field) const { return at_nodes(divergence * field); }
    /// See DifferentiableSurface.
    Operator change(const NodalChange<S>& c) const {
        Operator result(size(), 2 * size());
        set_change(result, 0, c);
        return result;
    }
    Operator changes(const NodalChange<S>& upper, const NodalChange<S>& lower) const {
        Operator result(2 * size(), 2 * size());
        set_change(result, 0, upper);
        set_change(result, size(), lower);
        return result;
    }
    Vector<S> slopes(const Vector<S>& values) const { return basis->even_first() * values; }
    Vector<S> second_slopes(const Vector<S>& values) const { return basis->even_second() * values; }
    Vector<S> tension_slopes(const Vector<S>& tension) const { return slopes(at_nodes(tension)); }

    /// Of the material that lay on `reference`, node by node.
    Stretches<S> stretches(const SpectralSurface& reference) const {
        return detail::stretches_of<S>(curve.speed.cwiseQuotient(reference.curve.speed), nodes.r, reference.nodes.r);
    }

  private:
    void set_change(Operator& to, Index row, const NodalChange<S>& c) const {
        const Index n = size();
        auto of_r = to.block(row, 0, n, n);
        auto of_z = to.block(row, n, n, n);
        of_r = c.r1.asDiagonal() * basis->odd_first();
        of_r += c.r2.asDiagonal() * basis->odd_second();
        of_r.diagonal() += c.r;
        of_z = c.z1.asDiagonal() * basis->even_first();
        of_z += c.z2.asDiagonal() * basis->even_second();
    }
};

/// Degree of the tension's series. The tension is the Lagrange multiplier of div_s u = 0: with one mode less than the
/// coordinates, every mode of it exerts forces and no motion of the nodes goes unseen (docs/spectral.md, section 3).
inline Index tension_degree(Index degree) {
    return degree - 1;
}

namespace detail {

/// The tension's nodes seen from the surface's, and the other way round.
template <class S>
struct TensionSpace {
    using Sampling = typename TrigonometricBasis<S>::Sampling;

    explicit TensionSpace(Index degree) {
        const auto surface = TrigonometricBasis<S>::of_degree(degree);
        const auto tension = TrigonometricBasis<S>::of_degree(tension_degree(degree));
        surface_there = surface->sample(tension->nodes());
        tension_here = tension->sample(surface->nodes());
    }

    Sampling surface_there;
    Sampling tension_here;
};

template <class S>
class SpectralSurfaceBuilder {
  public:
    explicit SpectralSurfaceBuilder(const Meridian<S>& meridian)
        : basis_(TrigonometricBasis<S>::of_degree(meridian.elements())), n_(meridian.nodes()) {
        s_.basis = basis_;
        s_.nodes = meridian;
    }

    SpectralSurface<S> build(SurfaceParts parts) {
        metric();
        volume();
        if (parts == SurfaceParts::all) {
            laplacian();
            curvatures();
            tension();
        }
        return std::move(s_);
    }

  private:
    bool pole(Index i) const { return i == 0 || i == n_ - 1; }

    void metric() {
        const Meridian<S>& m = s_.nodes;
        s_.curve = series_curve(m);
        std::tie(s_.normal_r, s_.normal_z) = s_.curve.normals();
        // The integral of a cosine series, a_0 t + sum_k (a_k/k) sin kt.
        Vector<S> integral = basis_->even_coefficients() * s_.curve.speed;
        for (Index k = 1; k < n_; ++k) {
            integral[k] /= S(k);
        }
        s_.arc_length.resize(n_);
        for (Index i = 0; i < n_; ++i) {
            const S t = basis_->nodes()[i];
            s_.arc_length[i] = integral[0] * t + sine_series<S>(integral, t);
        }
        // dA = 2 pi r |x'| dt with r/sin t even; at a pole r/sin t is the slope |x'|.
        s_.weight.resize(n_);
        for (Index i = 0; i < n_; ++i) {
            const S slope = pole(i) ? s_.curve.speed[i] : S(m.r[i] / basis_->sine(i));
            s_.weight[i] = 2 * pi_value<S>() * s_.curve.speed[i] * slope * basis_->sine_weights()[i];
        }
    }

    /// V = pi Int r^2 z' dt, a trigonometric polynomial that the fine rule integrates exactly, and so the gradient.
    void volume() {
        const auto& fine = basis_->fine();
        const Vector<S> r = fine.odd * s_.nodes.r;
        const Vector<S> r1 = fine.odd_slope * s_.nodes.r;
        const Vector<S> z1 = fine.even_slope * s_.nodes.z;
        const Vector<S> ring = 2 * pi_value<S>() * fine.weights.cwiseProduct(r);
        s_.volume_gradient.resize(2 * n_);
        s_.volume_gradient.head(n_) = fine.odd.transpose() * ring.cwiseProduct(z1);
        s_.volume_gradient.tail(n_) = -(fine.even.transpose() * ring.cwiseProduct(r1));
    }

    void laplacian() {
        const auto [first, second] = s_.curve.laplacian_factors();
        s_.laplacian = second.asDiagonal() * basis_->even_second();
        s_.laplacian += first.asDiagonal() * basis_->even_first();
        radial_laplacian_ = second.asDiagonal() * basis_->odd_second();
        radial_laplacian_ += first.asDiagonal() * basis_->odd_first();
    }

    /// Lap_s x = -2 H n, where the radial component of the vector x is Lap_s r - r/r^2 (its unit vector turns with the
    /// azimuth); 1/r^2 belongs to the frozen metric.
    void curvatures() {
        s_.mean_curvature_of.resize(n_, 2 * n_);
        s_.mean_curvature_of.leftCols(n_) = (s_.normal_r / S(-2)).asDiagonal() * radial_laplacian_;
        s_.mean_curvature_of.rightCols(n_) = (s_.normal_z / S(-2)).asDiagonal() * s_.laplacian;
        for (Index i = 1; i + 1 < n_; ++i) {
            s_.mean_curvature_of(i, i) += s_.normal_r[i] / (2 * s_.nodes.r[i] * s_.nodes.r[i]);
        }
        s_.mean_curvature = s_.mean_curvature_of * s_.positions();
        s_.gauss_curvature = s_.mean_curvature.cwiseAbs2();
        for (Index i = 1; i + 1 < n_; ++i) {
            const S azimuthal = s_.normal_r[i] / s_.nodes.r[i];
            s_.gauss_curvature[i] = azimuthal * (2 * s_.mean_curvature[i] - azimuthal);
        }
    }

    /// div_s u = x'.u'/|x'|^2 + u_r/r, with the limit 2 u_r'/r' at a pole.
    void tension() {
        const auto space = computed_once<TensionSpace<S>>(basis_->degree());
        const auto& here = space->surface_there;
        const Index count = here.size();
        const Vector<S> r = here.odd * s_.nodes.r;
        const Vector<S> r1 = here.odd_slope * s_.nodes.r;
        const Vector<S> z1 = here.even_slope * s_.nodes.z;
        const Vector<S> v2 = r1.cwiseAbs2() + z1.cwiseAbs2();
        s_.divergence.resize(count, 2 * n_);
        s_.divergence.leftCols(n_) = r1.cwiseQuotient(v2).asDiagonal() * here.odd_slope;
        s_.divergence.rightCols(n_) = z1.cwiseQuotient(v2).asDiagonal() * here.even_slope;
        for (Index k = 0; k < count; ++k) {
            if (k == 0 || k == count - 1) {
                s_.divergence.row(k).head(n_) *= S(2);
                s_.divergence.row(k).tail(n_).setZero();
            } else {
                s_.divergence.row(k).head(n_) += here.odd.row(k) / r[k];
            }
        }

        const auto& at_nodes = space->tension_here;
        s_.tension_at_nodes = at_nodes.even;
        const Vector<S> speed2 = s_.curve.speed.cwiseAbs2();
        const Vector<S> pull = -2 * s_.mean_curvature;
        s_.tension_force = s_.along_normal(pull.asDiagonal() * at_nodes.even);
        s_.tension_force.topRows(n_) += s_.curve.r1.cwiseQuotient(speed2).asDiagonal() * at_nodes.even_slope;
        s_.tension_force.bottomRows(n_) += s_.curve.z1.cwiseQuotient(speed2).asDiagonal() * at_nodes.even_slope;
        s_.element_area = at_nodes.even.transpose() * s_.weight;
    }

    std::shared_ptr<const TrigonometricBasis<S>> basis_;
    Index n_;
    SpectralSurface<S> s_;
    Matrix<S> radial_laplacian_;  // of an odd series, as if it were a scalar
};

}  // namespace detail

/// Operators of `meridian`, which must be valid (see validate).
template <class S>
SpectralSurface<S> spectral_surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) {
    return detail::SpectralSurfaceBuilder<S>(meridian).build(parts);
}

}  // namespace axistokes
