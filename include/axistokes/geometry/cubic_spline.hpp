// SPDX-License-Identifier: MIT
// Interpolating cubic spline of an even or an odd function of the arc length from a pole.
#pragma once

#include "../core.hpp"

namespace axistokes {

/// How a quantity on the meridian continues across a pole: z and curvatures are even, r is odd.
enum class Parity { even, odd };

/// Cubic spline through (t_i, f_i), t increasing. Even: zero slope at both ends; odd: zero second derivative.
/// Element e is [t_e, t_{e+1}]; x in [0, 1] is the local coordinate on it. Derivatives are with respect to t.
template <class S>
class CubicSpline {
  public:
    CubicSpline() = default;
    CubicSpline(const Vector<S>& t, const Vector<S>& values, Parity parity)
        : t_(t), values_(values), second_(second_derivatives(parity)) {}

    Index elements() const { return t_.size() - 1; }
    S length(Index e) const { return t_[e + 1] - t_[e]; }

    S value(Index e, const S& x) const {
        const S h = length(e);
        const S y = S(1) - x;
        return y * values_[e] + x * values_[e + 1] +
               h * h / 6 * ((y * y * y - y) * second_[e] + (x * x * x - x) * second_[e + 1]);
    }

    S first(Index e, const S& x) const {
        const S h = length(e);
        const S y = S(1) - x;
        return (values_[e + 1] - values_[e]) / h +
               h / 6 * ((S(1) - 3 * y * y) * second_[e] + (3 * x * x - S(1)) * second_[e + 1]);
    }

    S second(Index e, const S& x) const { return (S(1) - x) * second_[e] + x * second_[e + 1]; }

    /// Int from t_e to the point x of element e.
    S integral(Index e, const S& x) const {
        const S h = length(e);
        const S x2 = x * x;
        const S y2 = (S(1) - x) * (S(1) - x);
        const S from_second =
            (-(y2 * y2 - 1) / 4 + (y2 - 1) / 2) * second_[e] + (x2 * x2 / 4 - x2 / 2) * second_[e + 1];
        return h * ((x - x2 / 2) * values_[e] + x2 / 2 * values_[e + 1] + h * h / 6 * from_second);
    }

  private:
    Vector<S> second_derivatives(Parity parity) const {
        const Index n = t_.size();
        Vector<S> lower = Vector<S>::Zero(n);
        Vector<S> diagonal = Vector<S>::Ones(n);
        Vector<S> upper = Vector<S>::Zero(n);
        Vector<S> second = Vector<S>::Zero(n);
        const auto slope = [&](Index e) { return S((values_[e + 1] - values_[e]) / length(e)); };
        for (Index i = 1; i + 1 < n; ++i) {
            lower[i] = length(i - 1);
            upper[i] = length(i);
            diagonal[i] = 2 * (lower[i] + upper[i]);
            second[i] = 6 * (slope(i) - slope(i - 1));
        }
        if (parity == Parity::even) {
            upper[0] = length(0);
            diagonal[0] = 2 * upper[0];
            second[0] = 6 * slope(0);
            lower[n - 1] = length(n - 2);
            diagonal[n - 1] = 2 * lower[n - 1];
            second[n - 1] = -6 * slope(n - 2);
        }
        // Diagonally dominant: elimination without pivoting is stable.
        for (Index i = 1; i < n; ++i) {
            const S factor = lower[i] / diagonal[i - 1];
            diagonal[i] -= factor * upper[i - 1];
            second[i] -= factor * second[i - 1];
        }
        second[n - 1] /= diagonal[n - 1];
        for (Index i = n - 2; i >= 0; --i) {
            second[i] = (second[i] - upper[i] * second[i + 1]) / diagonal[i];
        }
        return second;
    }

    Vector<S> t_;
    Vector<S> values_;
    Vector<S> second_;
};

}  // namespace axistokes
