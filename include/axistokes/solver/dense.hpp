// SPDX-License-Identifier: MIT
// Direct dense solvers (policies for the linear solver).
#pragma once

#include "../core.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

namespace axistokes {

namespace detail {

template <class S>
Vector<S> finite_or_throw(Vector<S> x, const char* solver) {
    if (!x.allFinite()) {
        throw SimulationFailure(std::string(solver) + ": the matrix is singular or not finite");
    }
    return x;
}

}  // namespace detail

/// LU with partial pivoting: the fastest, 2/3 n^3 operations.
template <class S = double>
class DenseLU {
  public:
    using Scalar = S;

    void factorize(const Matrix<S>& a) { lu_.compute(a); }
    Vector<S> solve(const Vector<S>& b) const { return detail::finite_or_throw<S>(lu_.solve(b), "dense LU"); }

  private:
    Eigen::PartialPivLU<Matrix<S>> lu_;
};

/// Householder QR with column pivoting: backward stable without growth, least squares when the matrix is singular; some
/// five times the cost of LU.
template <class S = double>
class DenseQR {
  public:
    using Scalar = S;

    void factorize(const Matrix<S>& a) { qr_.compute(a); }
    Vector<S> solve(const Vector<S>& b) const { return detail::finite_or_throw<S>(qr_.solve(b), "dense QR"); }

  private:
    Eigen::ColPivHouseholderQR<Matrix<S>> qr_;
};

}  // namespace axistokes
