// SPDX-License-Identifier: MIT
// Inextensible fluid membrane with bending stiffness (a policy for the law of an interface).
//
// Force density on the fluid, in kappa/R0^3 (Trozzo et al. 2015, eqs 3-5; bending energy 2 Int H^2 dA in kappa):
//   f = [2 Lap_s H + 4 H (H^2 - K)] n  -  2 gamma H n + grad_s gamma  +  load n,     div_s u = 0 fixes gamma.
#pragma once

#include "../geometry/shape_changes.hpp"
#include "../operators.hpp"
#include "law.hpp"

#include <cmath>
#include <utility>

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
        const Vector<S> laplacian = detail::applied(surface.laplacian, h);
        const Index n = surface.size();
        Vector<S> force(2 * n);
        for (Index i = 0; i < n; ++i) {
            const S scalar = 2 * laplacian[i] + 4 * (h[i] * h[i] - surface.gauss_curvature[i]) * h[i];
            force[i] = scalar * surface.normal_r[i];
            force[n + i] = scalar * surface.normal_z[i];
        }
        return force;
    }

    /// Bending energy 2 Int H^2 dA, in kappa.
    template <class Discretization>
    static S energy(const Discretization& discretization, const Meridian<S>& shape) {
        return discretization.bending_energy(shape);
    }

    /// Positions -> bending force density (2n x 2n), linear with the normals, metric and curvature factor of `surface`
    /// frozen: applied to the surface's own positions it is the bending force. Tension also resists the curvature
    /// created during a step, at its previous value, as far as that is positive. Of a DifferentiableSurface: the
    /// derivative of the bending force and of the previous tension's, which lets tubes under tension take longer steps.
    template <class Surface>
    static typename Surface::Operator linearisation(const Surface& surface, const Vector<S>& tension) {
        using Operator = typename Surface::Operator;
        if constexpr (DifferentiableSurface<Surface>) {
            if (is_differentiable(surface)) {
                return derivative(surface, tension);
            }
        }
        const auto& h = surface.mean_curvature;
        Vector<S> factor(h.size());
        for (Index i = 0; i < h.size(); ++i) {
            factor[i] = 4 * (h[i] * h[i] - surface.gauss_curvature[i]);
        }
        if (tension.size() == surface.divergence.rows()) {
            resist(surface.at_nodes(tension), factor);
        }
        Operator scalar = detail::scaled(S(2), detail::product(surface.laplacian, surface.mean_curvature_of));
        scalar = detail::sum(std::move(scalar), detail::rows_scaled(factor, surface.mean_curvature_of));
        return surface.along_normal(scalar);
    }

  private:
    /// The derivative of the force density at constant tension.
    template <class Surface>
    static typename Surface::Operator derivative(const Surface& surface, const Vector<S>& given) {
        using Operator = typename Surface::Operator;
        const auto& h = surface.mean_curvature;
        const auto& k = surface.gauss_curvature;
        const Index tensions = surface.divergence.rows();
        const Vector<S> tension = given.size() == tensions ? given : Vector<S>(Vector<S>::Zero(tensions));
        const Vector<S> gamma = surface.at_nodes(tension);
        const Vector<S> laplacian = detail::applied(surface.laplacian, h);
        Vector<S> by_mean(h.size());
        Vector<S> by_gauss(h.size());
        Vector<S> normal(h.size());
        for (Index i = 0; i < h.size(); ++i) {
            by_mean[i] = 12 * h[i] * h[i] - 4 * k[i] - 2 * gamma[i];
            by_gauss[i] = -4 * h[i];
            normal[i] = 2 * laplacian[i] + 4 * (h[i] * h[i] - k[i]) * h[i] - 2 * gamma[i] * h[i];
        }
        const auto [mean, gauss] = curvature_changes(surface.curve);
        const Operator of_mean = surface.change(mean);
        Operator scalar = detail::product(surface.laplacian, of_mean);
        scalar =
            detail::sum(std::move(scalar),
                        surface.change(laplacian_change(surface.curve, surface.slopes(h), surface.second_slopes(h))));
        scalar = detail::scaled(S(2), std::move(scalar));
        scalar = detail::sum(std::move(scalar), detail::rows_scaled(by_mean, of_mean));
        scalar = detail::sum(std::move(scalar), detail::rows_scaled(by_gauss, surface.change(gauss)));
        const auto [radial, axial] = direction_changes(surface.curve, normal, surface.tension_slopes(tension));
        return detail::sum(surface.along_normal(scalar), surface.changes(radial, axial));
    }

    /// Subtracts gamma + sqrt(gamma^2 + m^2), m the mean of |gamma|, which is twice a tension's positive part: a kink
    /// would cost higher-order steps their order, and slightly negative tensions their stability.
    static void resist(const Vector<S>& tension, Vector<S>& factor) {
        using std::abs;
        using std::sqrt;
        S mean = 0;
        for (Index i = 0; i < tension.size(); ++i) {
            mean += abs(tension[i]) / S(tension.size());
        }
        for (Index i = 0; i < tension.size(); ++i) {
            factor[i] -= tension[i] + sqrt(tension[i] * tension[i] + mean * mean);
        }
    }
};

}  // namespace axistokes
