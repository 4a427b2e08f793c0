// SPDX-License-Identifier: MIT
// The layers of a discretisation, from its basis (layer_engine.hpp).
#pragma once

#include "layer_engine.hpp"

namespace axistokes::detail {

/// Base of a discretisation `Derived` that has layer_basis(meridian).
template <class Derived, class S>
class LayerOperators {
  public:
    /// u = G f for targets at the nodes: G is 2n x 2n, f and u are stacked [r; z]; f is a force density (kappa/R0^3), u
    /// a velocity (kappa/(eta R0^2)). Includes the factor 1/(8 pi).
    template <class Kernel>
    Matrix<S> single_layer(const Meridian<S>& meridian, const Kernel& kernel) const {
        return detail::single_layer(derived().layer_basis(meridian), kernel, meridian, true);
    }
    /// As single_layer, for targets anywhere (towards a target on the curve, between the nodes, panels are halved).
    template <class Kernel>
    Matrix<S> single_layer_at(const Meridian<S>& targets, const Meridian<S>& meridian, const Kernel& kernel) const {
        return detail::single_layer(derived().layer_basis(meridian), kernel, targets, false);
    }

    /// Nodal velocities to those that a double layer of them causes at the nodes, for kernels with stresses: the
    /// principal value, half of a rigid translation (layer_engine.hpp, eq. 2).
    template <class Kernel>
    Matrix<S> double_layer(const Meridian<S>& meridian, const Kernel& kernel) const {
        return detail::double_layer(derived().layer_basis(meridian), kernel, meridian, true);
    }
    /// As double_layer, for targets off the surface: all of a rigid translation inside, nothing outside.
    template <class Kernel>
    Matrix<S> double_layer_at(const Meridian<S>& targets, const Meridian<S>& meridian, const Kernel& kernel) const {
        return detail::double_layer(derived().layer_basis(meridian), kernel, targets, false);
    }

  private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

}  // namespace axistokes::detail
