// SPDX-License-Identifier: MIT
// A linear solver of your own: Eigen's LU with full pivoting. Slow, and as robust as an LU can be.
#pragma once

#include <axistokes/core.hpp>

#include <Eigen/LU>

#include <optional>

namespace write_your_own {

template <class S = double>
class FullPivotLU {
  public:
    using Scalar = S;

    void factorize(const axistokes::Matrix<S>& a) {
        lu_.emplace(a);
        if (!a.allFinite() || !lu_->isInvertible()) {
            throw axistokes::SimulationFailure("full-pivot LU: the matrix is singular or not finite");
        }
    }
    axistokes::Vector<S> solve(const axistokes::Vector<S>& b) const { return lu_->solve(b); }

  private:
    std::optional<Eigen::FullPivLU<axistokes::Matrix<S>>> lu_;  // none before the first matrix
};

}  // namespace write_your_own
