// SPDX-License-Identifier: MIT
// A curve of panels with p Gauss-Legendre nodes each, and the layers on it (layer/panel_basis.hpp).
#pragma once

#include "../geometry/meridian_spline.hpp"
#include "../layer/panel_basis.hpp"

namespace axistokes {

template <class S>
class PanelCurve {
  public:
    /// Throws InvalidArgument unless there are at least 2 nodes a panel and the tolerance is in [eps, 0.1].
    PanelCurve(Index nodes_per_panel, const S& tolerance)
        : p_(checked(nodes_per_panel, tolerance)), basis_(nodes_per_panel, tolerance) {}

    /// Appends the panel x(t), 0 <= t <= 1, given as a function t -> CurvePoint. The curve runs so that the outward
    /// normal is to the right of it, as on a Meridian.
    template <class Curve>
    void append(const Curve& curve) {
        const Index old = size();
        Vector<S> r(p_);
        Vector<S> z(p_);
        Vector<S> speed(p_);
        normal_r_.conservativeResize(old + p_);
        normal_z_.conservativeResize(old + p_);
        for (Index k = 0; k < p_; ++k) {
            const CurvePoint<S> x = curve(basis_.rules()[p_].nodes[k]);
            r[k] = x.position.r;
            z[k] = x.position.z;
            speed[k] = x.speed();
            normal_r_[old + k] = x.normal().r;
            normal_z_[old + k] = x.normal().z;
        }
        basis_.append(r, z, speed);
    }

    Index size() const { return basis_.size(); }
    Index panels() const { return basis_.panels(); }
    Index nodes_per_panel() const { return p_; }
    const Meridian<S>& nodes() const { return basis_.nodes(); }

    /// Point of a panel at t in [0, 1].
    Point<S> position(Index panel, const S& t) const { return basis_.position(panel, t); }
    /// |dx/dt| there.
    S speed(Index panel, const S& t) const { return basis_.speed(panel, t); }

    /// Weights of Int dl at the nodes.
    Vector<S> line_weights() const { return basis_.line_weights(); }
    /// Weights of Int dA at the nodes.
    Vector<S> weights() const { return 2 * detail::pi_value<S>() * line_weights().cwiseProduct(nodes().r); }
    /// Outward unit normals, stacked.
    Vector<S> normals() const {
        Vector<S> n(2 * size());
        n << normal_r_, normal_z_;
        return n;
    }

    /// Nodal force densities, stacked [r; z], to the velocities they cause at the nodes (with the factor 1/(8 pi)).
    template <class Kernel>
    Matrix<S> single_layer(const Kernel& kernel) const {
        return detail::single_layer(basis_, kernel, nodes(), true);
    }
    /// The same for targets that are not on the curve.
    template <class Kernel>
    Matrix<S> single_layer_at(const Meridian<S>& targets, const Kernel& kernel) const {
        return detail::single_layer(basis_, kernel, targets, false);
    }

    /// Nodal velocities to those that a double layer of them causes at the nodes: the principal value, half of a rigid
    /// translation if the curve is closed (layer/layer_engine.hpp, eq. 2).
    template <class Kernel>
    Matrix<S> double_layer(const Kernel& kernel) const {
        return detail::double_layer(basis_, kernel, nodes(), true);
    }
    /// The same for targets that are not on the curve.
    template <class Kernel>
    Matrix<S> double_layer_at(const Meridian<S>& targets, const Kernel& kernel) const {
        return detail::double_layer(basis_, kernel, targets, false);
    }

  private:
    static Index checked(Index nodes_per_panel, const S& tolerance) {
        detail::require(nodes_per_panel >= 2, "nodes per panel", nodes_per_panel, "at least 2");
        detail::require_tolerance("panel tolerance", tolerance);
        return nodes_per_panel;
    }

    Index p_;
    detail::PanelBasis<S> basis_;
    Vector<S> normal_r_;
    Vector<S> normal_z_;
};

}  // namespace axistokes
