// SPDX-License-Identifier: MIT
// A law of your own: a drop, whose interface has the constant tension gamma and nothing else.
#pragma once

#include <axistokes/membrane/law.hpp>

namespace write_your_own {

template <class S = double>
class Drop {
  public:
    using Scalar = S;
    static constexpr axistokes::Constraint constraint = axistokes::Constraint::none;
    static constexpr bool conserves_area = false;

    /// Tension in kappa/R0^2, as that of a membrane.
    explicit Drop(S gamma = S(1)) : gamma_(gamma) {}

    /// f = -2 gamma H n, stacked [r; z].
    template <class Surface>
    axistokes::Vector<S> force(const Surface& surface) const {
        axistokes::Vector<S> curvature(2 * surface.size());
        curvature << surface.mean_curvature, surface.mean_curvature;
        return -2 * gamma_ * curvature.cwiseProduct(surface.normals());
    }

    /// Its change with the positions, normals and metric frozen: what makes semi-implicit steps stable.
    template <class Surface>
    typename Surface::Operator linearisation(const Surface& surface, const axistokes::Vector<S>&) const {
        return -2 * gamma_ * surface.along_normal(surface.mean_curvature_of);
    }

  private:
    S gamma_;
};

}  // namespace write_your_own
