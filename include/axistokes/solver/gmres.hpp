// SPDX-License-Identifier: MIT
// Restarted GMRES, preconditioned by the LU factors of an earlier matrix (a policy for the linear solver).
//
// The matrices of consecutive time steps are close, so the factors of one serve as preconditioner for the next ones:
// an iteration costs 4 n^2 operations instead of the 2/3 n^3 of a new factorisation. What it returns depends on them,
// to its tolerance: a run that goes on from recorded steps is not the same to the last bit.
#pragma once

#include "../core.hpp"
#include "dense.hpp"

#include <Eigen/LU>
#include <unsupported/Eigen/IterativeSolvers>

#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace axistokes {

namespace detail {

/// Eigen's preconditioner concept around LU factors that outlive the solver.
template <class S>
class LaggedLU {
  public:
    using MatrixType = Matrix<S>;
    using StorageIndex = Index;
    enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

    void use(std::shared_ptr<const Eigen::PartialPivLU<Matrix<S>>> factors) { factors_ = std::move(factors); }
    Index rows() const { return factors_->rows(); }
    Index cols() const { return factors_->cols(); }
    template <class M>
    LaggedLU& analyzePattern(const M&) {
        return *this;
    }
    template <class M>
    LaggedLU& factorize(const M&) {
        return *this;
    }
    template <class M>
    LaggedLU& compute(const M&) {
        return *this;
    }
    template <class B>
    Vector<S> solve(const B& b) const {
        return factors_->solve(b);
    }
    Eigen::ComputationInfo info() const { return Eigen::Success; }

  private:
    std::shared_ptr<const Eigen::PartialPivLU<Matrix<S>>> factors_;
};

}  // namespace detail

template <class S = double>
class Gmres {
  public:
    using Scalar = S;

    struct Params {
        /// Relative residual of the preconditioned system, in (0, 1); a hundredth of the backward error allowed.
        S tolerance = 100 * std::numeric_limits<S>::epsilon();
        /// Iterations after which the preconditioner is renewed.
        Index patience = 20;
    };

    /// Throws InvalidArgument when a parameter is out of range.
    explicit Gmres(Params params = {}) : params_(params) {
        detail::require(params.tolerance > S(0) && params.tolerance < S(1), "GMRES tolerance", params.tolerance,
                        "in (0, 1)");
        detail::require(params.patience >= 1, "GMRES patience", params.patience, "at least 1");
    }

    void factorize(const Matrix<S>& a) {
        matrix_ = a;
        if (!factors_ || factors_->rows() != a.rows()) {
            renew();
        }
    }

    Vector<S> solve(const Vector<S>& b) {
        iterations_ = 0;
        for (const bool may_renew : {true, false}) {
            Eigen::GMRES<Matrix<S>, detail::LaggedLU<S>> gmres;
            gmres.preconditioner().use(factors_);
            gmres.setTolerance(params_.tolerance);
            gmres.set_restart(params_.patience);
            gmres.setMaxIterations(params_.patience);
            gmres.compute(matrix_);
            const Vector<S> x = gmres.solve(b);
            iterations_ += gmres.iterations();
            if (gmres.info() == Eigen::Success && x.allFinite() && solves(x, b)) {
                return x;
            }
            if (may_renew) {
                renew();
            }
        }
        throw SimulationFailure("GMRES: no convergence in " + std::to_string(params_.patience) +
                                " iterations with a fresh LU preconditioner");
    }

    /// Of the last solve.
    Index iterations() const { return iterations_; }
    /// Factorisations so far.
    Index factorizations() const { return factorizations_; }

  private:
    /// Old factors may hide a residual of the system itself: its backward error is to be small as well.
    bool solves(const Vector<S>& x, const Vector<S>& b) const {
        const S size =
            matrix_.cwiseAbs().rowwise().sum().maxCoeff() * x.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff();
        return (matrix_ * x - b).cwiseAbs().maxCoeff() <= 100 * params_.tolerance * size;
    }

    void renew() {
        auto factors = std::make_shared<const Eigen::PartialPivLU<Matrix<S>>>(matrix_);
        ++factorizations_;
        detail::require_regular(detail::regular<S>(*factors), "GMRES");
        factors_ = std::move(factors);
    }

    Params params_;
    Matrix<S> matrix_;
    std::shared_ptr<const Eigen::PartialPivLU<Matrix<S>>> factors_;
    Index iterations_ = 0;
    Index factorizations_ = 0;
};

}  // namespace axistokes
