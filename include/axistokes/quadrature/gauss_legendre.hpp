// SPDX-License-Identifier: MIT
// Gauss-Legendre rules on [0, 1] for any scalar, and product rules for the weight log(t) at the same nodes.
#pragma once

#include "../core.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace axistokes {

/// Nodes t_i in (0, 1), ascending, with the weights of Int_0^1 f dt and of Int_0^1 f(t) log(t) dt.
///
/// With n nodes the first is exact for polynomials of degree 2n - 1, the second (a product rule) of degree n - 1.
template <class S>
struct GaussLegendreRule {
    Vector<S> nodes;
    Vector<S> weights;
    Vector<S> log_weights;
};

namespace detail {

/// P_n(x) and P_{n-1}(x) by the three-term recurrence.
template <class S>
std::pair<S, S> legendre_pair(Index n, const S& x) {
    S previous = 1;
    S current = x;
    for (Index k = 2; k <= n; ++k) {
        const S next = (S(2 * k - 1) * x * current - S(k - 1) * previous) / S(k);
        previous = current;
        current = next;
    }
    return {current, previous};
}

}  // namespace detail

/// The rule with n >= 1 nodes. The logarithmic weights are w_i sum_k (2k + 1) P_k(2 t_i - 1) c_k with the exact moments
/// c_k = Int_0^1 P_k(2t - 1) log t dt = -1 for k = 0 and (-1)^(k+1) / (k (k + 1)) otherwise.
template <class S>
GaussLegendreRule<S> gauss_legendre(Index n) {
    using std::abs;
    using std::cos;
    detail::require(n >= 1, "number of quadrature nodes", n, "at least 1");
    GaussLegendreRule<S> rule{Vector<S>(n), Vector<S>(n), Vector<S>(n)};
    const double pi = std::acos(-1.0);
    for (Index i = 0; i < n; ++i) {
        S x = S(-std::cos(pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(n) + 0.5)));
        S slope = 1;
        // Quadratic convergence from an error below 1/n^2: ten iterations exceed a thousand digits.
        for (int iteration = 0; iteration < 10; ++iteration) {
            const auto [value, previous] = detail::legendre_pair<S>(n, x);
            slope = S(n) * (x * value - previous) / (x * x - S(1));
            const S step = value / slope;
            x -= step;
            if (abs(step) <= std::numeric_limits<S>::epsilon() * S(0.5)) {
                break;
            }
        }
        const auto [value, previous] = detail::legendre_pair<S>(n, x);
        slope = S(n) * (x * value - previous) / (x * x - S(1));
        rule.nodes[i] = (S(1) + x) / 2;
        rule.weights[i] = S(1) / ((S(1) - x * x) * slope * slope);

        S p_previous = 1;
        S p = x;
        S sum = -1;
        for (Index k = 1; k < n; ++k) {
            const S moment = S(k % 2 == 1 ? 1 : -1) / S(k * (k + 1));
            sum += S(2 * k + 1) * p * moment;
            const S p_next = (S(2 * k + 1) * x * p - S(k) * p_previous) / S(k + 1);
            p_previous = p;
            p = p_next;
        }
        rule.log_weights[i] = rule.weights[i] * sum;
    }
    return rule;
}

/// Rules with 1, ..., count nodes, computed once.
template <class S>
class GaussLegendreTable {
  public:
    explicit GaussLegendreTable(Index count) {
        for (Index n = 1; n <= count; ++n) {
            rules_.push_back(gauss_legendre<S>(n));
        }
    }

    Index largest() const { return static_cast<Index>(rules_.size()); }
    const GaussLegendreRule<S>& operator[](Index n) const { return rules_[static_cast<std::size_t>(n - 1)]; }

  private:
    std::vector<GaussLegendreRule<S>> rules_;
};

}  // namespace axistokes
