// SPDX-License-Identifier: MIT
// The Lagrange polynomials of given nodes in [0, 1], by the barycentric formula.
#pragma once

#include "../core.hpp"

#include <utility>

namespace axistokes {

template <class S>
class LagrangeBasis {
  public:
    /// The nodes must be different.
    explicit LagrangeBasis(Vector<S> nodes)
        : nodes_(std::move(nodes)),
          weights_(Vector<S>::Ones(nodes_.size())),
          differentiation_(Matrix<S>::Zero(nodes_.size(), nodes_.size())) {
        for (Index i = 0; i < nodes_.size(); ++i) {
            for (Index j = 0; j < nodes_.size(); ++j) {
                if (i != j) {
                    weights_[i] /= 4 * (nodes_[i] - nodes_[j]);  // 4: the capacity of [0, 1], against overflow
                }
            }
        }
        for (Index i = 0; i < nodes_.size(); ++i) {
            for (Index j = 0; j < nodes_.size(); ++j) {
                if (i != j) {
                    differentiation_(i, j) = weights_[j] / (weights_[i] * (nodes_[i] - nodes_[j]));
                    differentiation_(i, i) -= differentiation_(i, j);
                }
            }
        }
    }

    /// Nodal values to the interpolating polynomial's slopes at the nodes.
    const Matrix<S>& differentiation() const { return differentiation_; }

    /// Values at t; `values` has as many entries as there are nodes.
    template <class Out>
    void evaluate(const S& t, Out& values) const {
        for (Index k = 0; k < nodes_.size(); ++k) {
            if (t == nodes_[k]) {
                values.setZero();
                values[k] = 1;
                return;
            }
            values[k] = weights_[k] / (t - nodes_[k]);
        }
        values /= values.sum();
    }

  private:
    Vector<S> nodes_;
    Vector<S> weights_;
    Matrix<S> differentiation_;
};

}  // namespace axistokes
