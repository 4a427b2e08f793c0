// SPDX-License-Identifier: MIT
// A law of your own that remembers: a capsule, that is a drop with an elastic skin.
#pragma once

#include <axistokes/membrane/law.hpp>

namespace write_your_own {

/// Neo-Hookean membrane, unstressed at the start, on an interface of tension gamma. The tension in a principal
/// direction is gamma + G/(l1 l2) (l^2 - 1/(l1 l2)^2), with the shear modulus G, the principal stretches l1 and l2, and
/// l that of the direction.
template <class S = double>
class Capsule {
  public:
    using Scalar = S;
    static constexpr axistokes::Constraint constraint = axistokes::Constraint::none;
    static constexpr bool conserves_area = false;
    static constexpr bool carries_reference = true;

    /// Both in kappa/R0^2. Without an interface's tension a membrane under compression buckles.
    explicit Capsule(S modulus = S(1), S interface = S(0)) : modulus_(modulus), interface_(interface) {}

    /// With the tensions t1 and t2 along the meridian and around the axis:
    /// f = grad_s t1 - 2 t1 H n - (t2 - t1)/r e_r, stacked [r; z].
    template <class Surface>
    axistokes::Vector<S> force(const Surface& surface, const Surface& reference) const {
        const axistokes::Index n = surface.size();
        const auto l = surface.stretches(reference);
        const axistokes::Vector<S> area = l.meridional.cwiseProduct(l.azimuthal);
        const axistokes::Vector<S> t1 = tension(l.meridional, area);
        const axistokes::Vector<S> t2 = tension(l.azimuthal, area);
        const axistokes::Vector<S> slope = surface.surface_gradient(t1);
        axistokes::Vector<S> f(2 * n);
        for (axistokes::Index i = 0; i < n; ++i) {
            const S normal = -2 * t1[i] * surface.mean_curvature[i];
            const bool pole = i == 0 || i == n - 1;
            // The tangent is (-n_z, n_r); at the poles t1 = t2.
            f[i] = pole ? S(0)
                        : S(normal * surface.normal_r[i] - slope[i] * surface.normal_z[i] -
                            (t2[i] - t1[i]) / surface.nodes.r[i]);
            f[n + i] = normal * surface.normal_z[i] + slope[i] * surface.normal_r[i];
        }
        return f;
    }

    /// As if a uniform tension resisted curvature.
    template <class Surface>
    typename Surface::Operator linearisation(const Surface& surface, const Surface&,
                                             const axistokes::Vector<S>&) const {
        return -2 * (modulus_ + interface_) * surface.along_normal(surface.mean_curvature_of);
    }

  private:
    axistokes::Vector<S> tension(const axistokes::Vector<S>& stretch, const axistokes::Vector<S>& area) const {
        const axistokes::Vector<S> squares = stretch.cwiseAbs2() - area.cwiseAbs2().cwiseInverse();
        return (interface_ + modulus_ * squares.cwiseQuotient(area).array()).matrix();
    }

    S modulus_;
    S interface_;
};

}  // namespace write_your_own
