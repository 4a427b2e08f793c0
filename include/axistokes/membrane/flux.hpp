// SPDX-License-Identifier: MIT
// The single layer's null space: a uniform pressure moves nothing, and no force creates a flux through the surface.
#pragma once

#include "../core.hpp"

namespace axistokes::detail {

/// Removes the mean normal force from what `mobility` is applied to and the flux from what it returns. The exact single
/// layer maps n to 0 (a uniform pressure moves nothing) and creates no flux; a discrete one does so up to O(h^2), which
/// would act as a leak and as an arbitrary pressure.
template <class S, class Surface>
void complete_rank(const Surface& surface, Matrix<S>& mobility) {
    const Vector<S> n = surface.normals();
    const Vector<S> mean = surface.volume_gradient / surface.flux(n);
    mobility -= ((mobility * n) * mean.transpose()).eval();
    mobility -= (n * (mean.transpose() * mobility)).eval();
}

/// A field at the nodes without its mean normal part: a velocity without flux, or a force density without the uniform
/// pressure in it.
template <class S, class Surface>
Vector<S> without_flux(const Surface& surface, const Vector<S>& field) {
    const Vector<S> n = surface.normals();
    return field - (surface.flux(field) / surface.flux(n)) * n;
}

}  // namespace axistokes::detail
