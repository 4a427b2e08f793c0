// SPDX-License-Identifier: MIT
// The single layer's null space: a uniform pressure moves nothing, and no force creates a flux through a closed
// surface.
#pragma once

#include "../core.hpp"

namespace axistokes::detail {

/// The uniform pressure in a force density at the nodes: its mean normal part.
template <class S, class Surface>
S mean_normal_part(const Surface& surface, const Vector<S>& field) {
    return surface.flux(field) / surface.flux(surface.normals());
}

/// A field at the nodes without its mean normal part: a velocity without flux, or a force density without the uniform
/// pressure in it.
template <class S, class Surface>
Vector<S> without_flux(const Surface& surface, const Vector<S>& field) {
    return field - mean_normal_part<S>(surface, field) * surface.normals();
}

/// m's rows from `row` on, of one column.
template <class S>
Eigen::Map<Vector<S>> part_of_column(Matrix<S>& m, Index row, Index column, Index rows) {
    return {m.data() + column * m.rows() + row, rows};
}

/// Rows, first or also columns, of a body whose nodes start at `begin` (two for each node, r and z stacked): removes
/// the mean normal force from what `mobility` is applied to.
template <class S, class Surface>
void ignore_pressure(const Surface& surface, Index begin, Matrix<S>& mobility) {
    const Vector<S> n = surface.normals();
    const Vector<S> mean = surface.volume_gradient / surface.flux(n);
    Vector<S> moved = Vector<S>::Zero(mobility.rows());
    for (Index j = 0; j < n.size(); ++j) {
        moved += n[j] * part_of_column(mobility, 0, begin + j, moved.size());
    }
    for (Index j = 0; j < n.size(); ++j) {
        part_of_column(mobility, 0, begin + j, moved.size()) -= mean[j] * moved;
    }
}

/// Removes the flux through that body from what `mobility` returns.
template <class S, class Surface>
void stop_flux(const Surface& surface, Index begin, Matrix<S>& mobility) {
    const Vector<S> n = surface.normals();
    const Vector<S> mean = surface.volume_gradient / surface.flux(n);
    for (Index j = 0; j < mobility.cols(); ++j) {
        auto part = part_of_column(mobility, begin, j, n.size());
        const S flux = mean.dot(part);
        part -= flux * n;
    }
}

}  // namespace axistokes::detail
