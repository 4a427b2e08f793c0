// SPDX-License-Identifier: MIT
// Inextensible fluid membrane with bending stiffness (a policy for the law of an interface).
//
// Force density on the fluid, in kappa/R0^3 (Trozzo et al. 2015, eqs 3-5; bending energy 2 Int H^2 dA in kappa):
//   f = [2 Lap_s H + 4 H (H^2 - K)] n  -  2 gamma H n + grad_s gamma  +  load n,     div_s u = 0 fixes gamma.
#pragma once

#include "law.hpp"

namespace axistokes {

template <class S = double>
class Vesicle {
  public:
    using Scalar = S;
    static constexpr Constraint constraint = Constraint::inextensible;
    static constexpr bool conserves_area = true;

    /// Bending force density, stacked.
    template <class Surface>
    static Vector<S> force(const Surface& surface) {
        const auto& h = surface.mean_curvature;
        Vector<S> scalar = surface.laplacian * h;
        for (Index i = 0; i < h.size(); ++i) {
            scalar[i] = 2 * scalar[i] + 4 * (h[i] * h[i] - surface.gauss_curvature[i]) * h[i];
        }
        Vector<S> force(2 * surface.size());
        force << surface.normal_r.cwiseProduct(scalar), surface.normal_z.cwiseProduct(scalar);
        return force;
    }

    /// Positions -> bending force density (2n x 2n), linear with the normals, metric and curvature factor of `surface`
    /// frozen: applied to the surface's own positions it is the bending force. Tension also resists the curvature
    /// created during a step, at its previous value, as far as that is positive.
    template <class Surface>
    static typename Surface::Operator linearisation(const Surface& surface, const Vector<S>& tension) {
        using Operator = typename Surface::Operator;
        const auto& h = surface.mean_curvature;
        Vector<S> factor = 4 * (h.cwiseAbs2() - surface.gauss_curvature);
        if (tension.size() == surface.divergence.rows()) {
            factor -= 2 * positive_part(surface.at_nodes(tension));
        }
        Operator scalar = S(2) * (surface.laplacian * surface.mean_curvature_of);
        scalar += Operator(factor.asDiagonal() * surface.mean_curvature_of);
        return surface.along_normal(scalar);
    }

  private:
    /// (gamma + sqrt(gamma^2 + m^2))/2 with m the mean of |gamma|: a kink would cost higher-order steps their order,
    /// and slightly negative tensions their stability.
    static Vector<S> positive_part(const Vector<S>& tension) {
        const S mean = tension.cwiseAbs().mean();
        return (tension + (tension.cwiseAbs2().array() + mean * mean).sqrt().matrix()) / 2;
    }
};

}  // namespace axistokes
