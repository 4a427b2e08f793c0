// SPDX-License-Identifier: MIT
// Gauss-Laguerre rules by the eigenvalues of the Jacobi matrix (Golub & Welsch, Math. Comp. 23 (1969) 221-230).
#pragma once

#include "../core.hpp"

#include <Eigen/Eigenvalues>

namespace axistokes {

/// Nodes x > 0, ascending, and weights of Int_0^inf exp(-x) f(x) dx.
template <class S>
struct GaussLaguerreRule {
    Vector<S> nodes;
    Vector<S> weights;
};

/// The rule with n >= 1 nodes, exact to degree 2n - 1.
template <class S>
GaussLaguerreRule<S> gauss_laguerre(Index n) {
    detail::require(n >= 1, "number of quadrature nodes", n, "at least 1");
    Vector<S> diagonal(n);
    Vector<S> below(n - 1);
    for (Index i = 0; i < n; ++i) {
        diagonal[i] = S(2 * i + 1);
        if (i > 0) {
            below[i - 1] = S(i);
        }
    }
    Eigen::SelfAdjointEigenSolver<Matrix<S>> solver;
    solver.computeFromTridiagonal(diagonal, below);
    return {solver.eigenvalues(), solver.eigenvectors().row(0).cwiseAbs2().transpose()};
}

}  // namespace axistokes
