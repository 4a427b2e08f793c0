// SPDX-License-Identifier: MIT
// Quadrature points on a spectral meridian: the fixed panels, and the geometry at any points (docs/spectral.md,
// section 4).
#pragma once

#include "../geometry/meridian.hpp"
#include "../geometry/trigonometric.hpp"
#include "../quadrature/gauss_legendre.hpp"

#include <algorithm>
#include <cmath>

namespace axistokes::detail {

/// The fixed panels on [0, pi] for series of a degree: points, and the cardinal functions there.
template <class S>
struct SpectralPanels {
    /// Points per degree: the highest mode itself is integrated to a few digits, what is resolved to all.
    static constexpr double density = 2.5;

    SpectralPanels(Index degree, Index order) {
        const auto basis = TrigonometricBasis<S>::of_degree(degree);
        const auto points = density * static_cast<double>(degree);
        count = std::max<Index>(4, static_cast<Index>(std::ceil(points / static_cast<double>(order))));
        const GaussLegendreRule<S> rule = gauss_legendre<S>(order);
        t.resize(count * order);
        weights.resize(t.size());
        cardinals.resize(basis->size(), t.size());
        for (Index q = 0; q < t.size(); ++q) {
            t[q] = boundary(q / order) + (boundary(1) - boundary(0)) * rule.nodes[q % order];
            weights[q] = boundary(1) * rule.weights[q % order];
            basis->cardinals(t[q], cardinals.col(q));
        }
    }

    S boundary(Index panel) const { return pi_value<S>() * S(panel) / S(count); }

    Index count;
    Vector<S> t;
    Vector<S> weights;    // of Int dt
    Matrix<S> cardinals;  // a column for each point
};

/// Points on a meridian given by their parameters.
template <class S>
class SpectralCurvePoints {
  public:
    explicit SpectralCurvePoints(const Meridian<S>& m) : degree_(m.elements()), nodal_(m.nodes(), 4) {
        const auto basis = TrigonometricBasis<S>::of_degree(degree_);
        nodal_.col(0) = m.z;
        nodal_.col(1) = m.r;
        nodal_.col(2) = basis->odd_first() * m.r;
        nodal_.col(3) = basis->even_first() * m.z;
        for (Index j = 0; j < m.nodes(); ++j) {
            nodal_(j, 1) *= basis->sine(j);
            nodal_(j, 3) *= basis->sine(j);
        }
        last_slope_ = -S(degree_) * basis->even_coefficients().row(degree_).dot(m.z);
    }

    /// An odd series has the cardinal functions of the even one times sin t_j/sin t. That misses sin Nt, which vanishes
    /// at all nodes: the slope of z has it.
    void evaluate(const Vector<S>& t, const Matrix<S>& cardinals) {
        const Matrix<S> values = cardinals.transpose() * nodal_;
        inverse_sine = t.array().sin().inverse();
        z = values.col(0);
        r = values.col(1).cwiseProduct(inverse_sine);
        const Vector<S> z1 =
            values.col(3).cwiseProduct(inverse_sine) + last_slope_ * (S(degree_) * t.array()).sin().matrix();
        speed = (values.col(2).cwiseAbs2() + z1.cwiseAbs2()).cwiseSqrt();
    }

    Vector<S> r;
    Vector<S> z;
    Vector<S> speed;
    Vector<S> inverse_sine;

  private:
    Index degree_;
    Matrix<S> nodal_;
    S last_slope_;
};

/// The four entries of a kernel for many pairs, in matrices of equal size.
template <class S>
struct EntryMatrices {
    Matrix<S> rr, rz, zr, zz;

    void set_zero(Index rows, Index columns) {
        for (Matrix<S>* entry : {&rr, &rz, &zr, &zz}) {
            entry->setZero(rows, columns);
        }
    }
    void resize(Index rows, Index columns) {
        for (Matrix<S>* entry : {&rr, &rz, &zr, &zz}) {
            entry->resize(rows, columns);
        }
    }
    KernelArrays<S> arrays(Index row, Index column) {
        return {&rr(row, column), &rz(row, column), &zr(row, column), &zz(row, column)};
    }
};

}  // namespace axistokes::detail
