// SPDX-License-Identifier: MIT
// Direct dense solvers (policies for the linear solver).
#pragma once

#include "../core.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <limits>
#include <string>

namespace axistokes {

namespace detail {

/// Throws unless the matrix is regular to working precision; NaN is not. A singular matrix rarely has a pivot that is
/// exactly zero: rounding leaves one of order eps, and a finite solution of order 1/eps without a meaning.
inline void require_regular(bool regular, const char* solver) {
    if (!regular) {
        throw SimulationFailure(std::string(solver) + ": the matrix is singular or not finite");
    }
}

template <class S>
bool regular(const Eigen::PartialPivLU<Matrix<S>>& lu) {
    return lu.rcond() > std::numeric_limits<S>::epsilon();
}

}  // namespace detail

/// LU with partial pivoting: the fastest, 2/3 n^3 operations.
template <class S = double>
class DenseLU {
  public:
    using Scalar = S;

    void factorize(const Matrix<S>& a);
    Vector<S> solve(const Vector<S>& b) const;

  private:
    Eigen::PartialPivLU<Matrix<S>> lu_;
};

template <class S>
void DenseLU<S>::factorize(const Matrix<S>& a) {
    lu_.compute(a);
    detail::require_regular(detail::regular<S>(lu_), "dense LU");
}

template <class S>
Vector<S> DenseLU<S>::solve(const Vector<S>& b) const {
    return lu_.solve(b);
}

/// Householder QR with column pivoting: backward stable without growth, and reveals the rank; some five times the cost
/// of LU.
template <class S = double>
class DenseQR {
  public:
    using Scalar = S;

    void factorize(const Matrix<S>& a) {
        qr_.compute(a);
        detail::require_regular(a.allFinite() && qr_.isInvertible(), "dense QR");
    }
    Vector<S> solve(const Vector<S>& b) const { return qr_.solve(b); }

  private:
    Eigen::ColPivHouseholderQR<Matrix<S>> qr_;
};

}  // namespace axistokes
