// SPDX-License-Identifier: MIT
// Quadrature of a kernel's smooth part over a discretised meridian.
#pragma once

#include "../geometry/meridian.hpp"

#include <Eigen/SparseCore>

namespace axistokes {

/// Points on the meridian, and (points x nodes) what a unit force density at each node contributes to the force per
/// unit azimuthal length at each point: quadrature weight times interpolation, without the factor 1/(8 pi) of the
/// layer.
template <class S>
struct RegularQuadrature {
    Meridian<S> points;
    /// Axial position of the panel a point belongs to. Kernels that treat close and distant panels by quadratures of
    /// different order decide by it, so that every panel is integrated by one rule as a whole.
    Vector<S> panel;
    Eigen::SparseMatrix<S, Eigen::RowMajor> weights;
};

}  // namespace axistokes
