// SPDX-License-Identifier: MIT
// Filon's rule: Simpson's rule for the smooth factor of an oscillating integrand (Abramowitz & Stegun 25.4.47-57;
// Trozzo et al. 2015, appendix A).
#pragma once

#include "../core.hpp"

#include <cmath>
#include <vector>

namespace axistokes {

/// Int f(x) cos(k x) dx and Int f(x) sin(k x) dx.
template <class S>
struct FourierIntegrals {
    S cosine{};
    S sine{};
};

namespace detail {

/// alpha, beta, gamma of the rule for theta = k h; series where the closed forms cancel.
template <class S>
struct FilonWeights {
    explicit FilonWeights(const S& theta) {
        using std::abs;
        using std::cos;
        using std::sin;
        const S t2 = theta * theta;
        if (abs(theta) < S(0.2)) {
            alpha = theta * t2 * (S(2) / 45 - t2 * (S(2) / 315 - t2 * (S(2) / 4725 - t2 * S(8) / 467775)));
            beta = S(2) / 3 + t2 * (S(2) / 15 - t2 * (S(4) / 105 - t2 * (S(2) / 567 - t2 * S(4) / 22275)));
            gamma = S(4) / 3 - t2 * (S(2) / 15 - t2 * (S(1) / 210 - t2 * (S(1) / 11340 - t2 / 997920)));
            return;
        }
        const S s = sin(theta);
        const S c = cos(theta);
        const S t3 = t2 * theta;
        alpha = (t2 + theta * s * c - 2 * s * s) / t3;
        beta = 2 * (theta * (S(1) + c * c) - 2 * s * c) / t3;
        gamma = 4 * (s - theta * c) / t3;
    }
    S alpha, beta, gamma;
};

}  // namespace detail

/// Over [a, b], from f at 2p + 1 equidistant points, p >= 1. Exact for parabolas on each pair of intervals, whatever k.
template <class S>
FourierIntegrals<S> filon(const std::vector<S>& f, const S& a, const S& b, const S& k) {
    using std::cos;
    using std::sin;
    const std::size_t last = f.size() - 1;
    detail::require(f.size() >= 3 && last % 2 == 0, "number of points of Filon's rule", f.size(), "odd and at least 3");
    const S h = (b - a) / S(last);
    const detail::FilonWeights<S> weights(S(k * h));
    FourierIntegrals<S> even;
    FourierIntegrals<S> odd;
    for (std::size_t i = 0; i <= last; ++i) {
        const S x = k * (a + h * S(i));
        const S value = i == 0 || i == last ? S(f[i] / 2) : f[i];
        FourierIntegrals<S>& sum = i % 2 == 0 ? even : odd;
        sum.cosine += value * cos(x);
        sum.sine += value * sin(x);
    }
    return {h * (weights.alpha * (f[last] * sin(k * b) - f[0] * sin(k * a)) + weights.beta * even.cosine +
                 weights.gamma * odd.cosine),
            h * (weights.alpha * (f[0] * cos(k * a) - f[last] * cos(k * b)) + weights.beta * even.sine +
                 weights.gamma * odd.sine)};
}

}  // namespace axistokes
