// SPDX-License-Identifier: MIT
// Differential operators of the paper's P1 elements (Trozzo et al. 2015, section 2.2.2) on a frozen meridian.
//
// Notation: element e joins nodes e and e+1, L is its length, A = pi (r_e + r_{e+1}) L the area of its frustum. The
// patch of a node reaches to the midpoints of its two elements; W is its area, and the sum of W is that of A.
#pragma once

#include "../geometry/meridian.hpp"
#include "../geometry/stretches.hpp"
#include "../operators.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace axistokes {

/// Geometry and operators of a meridian with n nodes and n - 1 elements. Vector fields are stacked: n values of r, then
/// n of z.
template <class S>
struct LinearSurface {
    using Operator = Eigen::SparseMatrix<S>;

    Meridian<S> nodes;
    Vector<S> arc_length;       // at the nodes, from the lower pole
    Vector<S> element_length;   // L
    Vector<S> element_area;     // A
    Vector<S> weight;           // W: the quadrature weights of Int dA at the nodes
    Vector<S> volume_gradient;  // 2n: dV/dx of the volume inside the elements, the discrete counterpart of W n
    Vector<S> normal_r;         // outward unit normal
    Vector<S> normal_z;
    Vector<S> mean_curvature;   // H > 0 on a sphere
    Vector<S> gauss_curvature;  // K = (n_r/r) (2 H - n_r/r); H^2 at the poles

    Operator laplacian;          // n x n: Laplace-Beltrami operator of an axisymmetric scalar
    Operator mean_curvature_of;  // n x 2n: positions -> H, linear with normals and metric frozen
    Operator divergence;         // (n - 1) x 2n: velocity -> relative rate of change of each frustum's area
    Operator tension_force;      // 2n x (n - 1): tension of each element -> force density, -(1/W) dA/dx

    Index size() const { return nodes.nodes(); }
    Vector<S> positions() const { return detail::stacked(nodes.r, nodes.z); }
    /// Unit normals, stacked.
    Vector<S> normals() const { return detail::stacked(normal_r, normal_z); }
    /// Operator -> scalar per node, as a stacked field along the frozen normals.
    Operator along_normal(const Operator& scalar) const { return detail::spread_along(normal_r, normal_z, scalar); }
    /// Int of a stacked field's normal component over the surface; exactly 0 for a translation.
    S flux(const Vector<S>& field) const { return volume_gradient.dot(field); }
    S area() const { return weight.sum(); }
    /// Values on elements (such as the tension) at the nodes, by area-weighted averages.
    Vector<S> at_nodes(const Vector<S>& on_elements) const {
        Vector<S> result(size());
        for (Index i = 0; i < size(); ++i) {
            const Index below = std::max<Index>(i - 1, 0);
            const Index above = std::min<Index>(i, size() - 2);
            // Linear interpolation between the elements' midpoints; constant at a pole, where the slope is zero.
            const S wa = element_length[below];
            const S wb = element_length[above];
            result[i] = (wb * on_elements[below] + wa * on_elements[above]) / (wa + wb);
        }
        return result;
    }
    /// Derivative along the meridian of nodal values: the mean of the elements' slopes (paper, eq. 40), 0 at the poles.
    Vector<S> surface_gradient(const Vector<S>& values) const {
        Vector<S> result = Vector<S>::Zero(size());
        for (Index i = 1; i + 1 < size(); ++i) {
            const S below = element_length[i - 1];
            const S above = element_length[i];
            result[i] = (above * (values[i] - values[i - 1]) / below + below * (values[i + 1] - values[i]) / above) /
                        (below + above);
        }
        return result;
    }
    /// Surface divergence of a stacked nodal field, at the nodes.
    Vector<S> surface_divergence(const Vector<S>& field) const { return at_nodes(detail::applied(divergence, field)); }
    /// Of the material that lay on `reference`, node by node.
    Stretches<S> stretches(const LinearSurface& reference) const {
        Vector<S> ratio(element_length.size());
        for (Index e = 0; e < ratio.size(); ++e) {
            ratio[e] = element_length[e] / reference.element_length[e];
        }
        return detail::stretches_of<S>(at_nodes(ratio), nodes.r, reference.nodes.r);
    }
};

namespace detail {

/// Weights (w1, w2) of f1 - f0 and f2 - f0 in the Laplacian at a pole, for nodes at arc lengths s1, s2 from it.
///
/// The one-patch rule 4 (f1 - f0)/s1^2 errs by 4 s1^2 f4 on f = f4 s^4, the interior rule by 6 h^2 f4. The second
/// Laplacian of the bending force would turn that jump of the error into an error of order one at the pole. Two nodes
/// allow the same 6 s1^2 f4 at the pole: w1 s1^2 + w2 s2^2 = 4, w1 s1^4 + w2 s2^4 = 6 s1^2.
template <class S>
std::pair<S, S> pole_laplacian_weights(const S& s1, const S& s2) {
    const S a = s1 * s1;
    const S b = s2 * s2;
    const S w2 = 2 * a / (b * (b - a));
    return {(S(4) - w2 * b) / a, w2};
}

/// dA/dx of the frustum of element e with respect to the node `i` of it (the other one is `j`).
template <class S>
Point<S> frustum_area_gradient(const Meridian<S>& m, Index i, Index j, const S& length) {
    const S pi = pi_value<S>();
    const S sum = m.r[i] + m.r[j];
    return {pi * (length + sum * (m.r[i] - m.r[j]) / length), pi * sum * (m.z[i] - m.z[j]) / length};
}

template <class S>
class LinearSurfaceBuilder {
  public:
    explicit LinearSurfaceBuilder(const Meridian<S>& meridian) : m_(meridian), n_(meridian.nodes()) {
        s_.nodes = meridian;
    }

    LinearSurface<S> build(SurfaceParts parts) {
        metric();
        volume();
        normals();
        if (parts == SurfaceParts::all) {
            laplacian();
            curvatures();
            tension();
        }
        return std::move(s_);
    }

  private:
    using Triplets = detail::Triplets<S>;
    using Operator = typename LinearSurface<S>::Operator;

    void metric() {
        using std::sqrt;
        const S pi = pi_value<S>();
        s_.arc_length = Vector<S>::Zero(n_);
        s_.element_length.resize(n_ - 1);
        s_.element_area.resize(n_ - 1);
        s_.weight = Vector<S>::Zero(n_);
        for (Index e = 0; e + 1 < n_; ++e) {
            const S dr = m_.r[e + 1] - m_.r[e];
            const S dz = m_.z[e + 1] - m_.z[e];
            const S length = sqrt(dr * dr + dz * dz);
            s_.element_length[e] = length;
            s_.arc_length[e + 1] = s_.arc_length[e] + length;
            s_.element_area[e] = pi * (m_.r[e] + m_.r[e + 1]) * length;
            s_.weight[e] += pi * length * (3 * m_.r[e] + m_.r[e + 1]) / 4;
            s_.weight[e + 1] += pi * length * (m_.r[e] + 3 * m_.r[e + 1]) / 4;
        }
    }

    /// V = sum pi/3 (r1^2 + r1 r2 + r2^2) (z2 - z1). The radial derivative at a pole belongs to no axisymmetric motion.
    void volume() {
        const S third = pi_value<S>() / 3;
        s_.volume_gradient = Vector<S>::Zero(2 * n_);
        for (Index e = 0; e + 1 < n_; ++e) {
            const S r1 = m_.r[e];
            const S r2 = m_.r[e + 1];
            const S dz = m_.z[e + 1] - m_.z[e];
            s_.volume_gradient[e] += third * (2 * r1 + r2) * dz;
            s_.volume_gradient[e + 1] += third * (r1 + 2 * r2) * dz;
            const S along = third * (r1 * r1 + r1 * r2 + r2 * r2);
            s_.volume_gradient[n_ + e] -= along;
            s_.volume_gradient[n_ + e + 1] += along;
        }
        s_.volume_gradient[0] = s_.volume_gradient[n_ - 1] = 0;
    }

    /// Tangent of the parabola through a node and its neighbours.
    void normals() {
        using std::sqrt;
        s_.normal_r = Vector<S>::Zero(n_);
        s_.normal_z = Vector<S>::Zero(n_);
        s_.normal_z[0] = -1;
        s_.normal_z[n_ - 1] = 1;
        for (Index i = 1; i + 1 < n_; ++i) {
            const S ratio = s_.element_length[i] / s_.element_length[i - 1];
            const S tr = ratio * (m_.r[i] - m_.r[i - 1]) + (m_.r[i + 1] - m_.r[i]) / ratio;
            const S tz = ratio * (m_.z[i] - m_.z[i - 1]) + (m_.z[i + 1] - m_.z[i]) / ratio;
            const S norm = sqrt(tr * tr + tz * tz);
            s_.normal_r[i] = tz / norm;
            s_.normal_z[i] = -tr / norm;
        }
    }

    /// Square of the angle the normals turn through on element e, (k h)^2.
    S squared_turn(Index e) const {
        const S turn_r = s_.normal_r[e + 1] - s_.normal_r[e];
        const S turn_z = s_.normal_z[e + 1] - s_.normal_z[e];
        return turn_r * turn_r + turn_z * turn_z;
    }

    /// Length of the arc over element e: the chord, corrected for its curvature.
    S arc(Index e) const { return s_.element_length[e] * (S(1) + squared_turn(e) / 24); }

    /// Contour fluxes (paper, eq. 38): the flux through the patch's edges over the patch's area.
    void laplacian() {
        const S pi = pi_value<S>();
        Triplets entries;
        const auto add = [&](Index i, Index j, const S& w) {
            add_entry(entries, i, j, w);
            add_entry(entries, i, i, -w);
        };
        for (Index i = 1; i + 1 < n_; ++i) {
            for (const Index j : {i - 1, i + 1}) {
                const Index e = std::min(i, j);
                add(i, j, pi * (m_.r[i] + m_.r[j]) / (s_.element_length[e] * s_.weight[i]));
            }
        }
        for (const auto& [pole, step] : {std::pair<Index, Index>{0, 1}, std::pair<Index, Index>{n_ - 1, -1}}) {
            const S s1 = arc(std::min(pole, pole + step));
            const S s2 = s1 + arc(std::min(pole + step, pole + 2 * step));
            const auto [w1, w2] = pole_laplacian_weights<S>(s1, s2);
            add(pole, pole + step, w1);
            add(pole, pole + 2 * step, w2);
        }
        s_.laplacian = assembled(n_, n_, entries);
    }

    /// Lap_s x = -2 H n. The radial component of the vector x is Lap_s r - r/r^2 (its unit vector turns with the
    /// azimuth); 1/r^2 belongs to the frozen metric.
    ///
    /// Off the poles Lap_s r - r/r^2 errs by -[(k h)^2/4 + (L2/L1 - 1)/2] / (2 r), for a curvature k and spacings
    /// L1, L2, ... that grow from the pole. As n_r -> k r this adds k [(k h)^2/16 + (L2/L1 - 1)/8] to H; at the poles,
    /// where n_r = 0, the same is added, again to keep the error of H smooth.
    void curvatures() {
        const auto pole_factor = [&](Index i) {
            if (i != 0 && i != n_ - 1) {
                return S(1);
            }
            const Index first = i == 0 ? 0 : n_ - 2;
            const Index second = i == 0 ? 1 : n_ - 3;
            const S growth = s_.element_length[second] / s_.element_length[first] - S(1);
            return S(S(1) + squared_turn(first) / 16 + growth / 8);
        };
        Triplets entries;
        for_each_entry(s_.laplacian, [&](Index i, Index j, const S& value) {
            add_entry(entries, i, j, -s_.normal_r[i] * value / 2);
            add_entry(entries, i, n_ + j, -pole_factor(i) * s_.normal_z[i] * value / 2);
        });
        for (Index i = 1; i + 1 < n_; ++i) {
            add_entry(entries, i, i, s_.normal_r[i] / (2 * m_.r[i] * m_.r[i]));
        }
        s_.mean_curvature_of = assembled(n_, 2 * n_, entries);
        s_.mean_curvature = applied(s_.mean_curvature_of, s_.positions());
        s_.gauss_curvature = s_.mean_curvature.cwiseAbs2();
        for (Index i = 1; i + 1 < n_; ++i) {
            const S azimuthal = s_.normal_r[i] / m_.r[i];
            s_.gauss_curvature[i] = azimuthal * (2 * s_.mean_curvature[i] - azimuthal);
        }
    }

    /// Adjoint to each other: sum_e tension_e dA_e/dt = - sum_n W_n f_n . u_n.
    void tension() {
        Triplets divergence;
        Triplets force;
        for (Index e = 0; e + 1 < n_; ++e) {
            for (const auto& [i, j] : {std::pair{e, e + 1}, std::pair{e + 1, e}}) {
                const Point<S> gradient = frustum_area_gradient(m_, i, j, s_.element_length[e]);
                const bool pole = i == 0 || i == n_ - 1;
                if (!pole) {
                    add_entry(divergence, e, i, gradient.r / s_.element_area[e]);
                    add_entry(force, i, e, -gradient.r / s_.weight[i]);
                }
                add_entry(divergence, e, n_ + i, gradient.z / s_.element_area[e]);
                add_entry(force, n_ + i, e, -gradient.z / s_.weight[i]);
            }
        }
        s_.divergence = assembled(n_ - 1, 2 * n_, divergence);
        s_.tension_force = assembled(2 * n_, n_ - 1, force);
    }

    const Meridian<S>& m_;
    Index n_;
    LinearSurface<S> s_;
};

}  // namespace detail

/// Operators of `meridian`, which must be valid (see validate).
template <class S>
LinearSurface<S> linear_surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) {
    return detail::LinearSurfaceBuilder<S>(meridian).build(parts);
}

}  // namespace axistokes
