// SPDX-License-Identifier: MIT
// e^(-x) I0(x) and e^(-x) (I0(x) - I1(x)) at millions of arguments along a ray: piecewise polynomials for float and
// double, tabulated once from special/bessel.hpp in the next wider type; other types evaluate them directly.
#pragma once

#include "bessel.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <type_traits>

namespace axistokes::detail {

template <class C>
struct ScaledIPair {
    C i0{};
    C difference{};
};

template <class C>
struct WiderOf {
    using type = long double;
};
template <class S>
struct WiderOf<std::complex<S>> {
    using type = std::complex<long double>;
};

/// Arguments x direction, x >= 0 real; direction is 1 (C real) or a unit complex number with |arg| <= pi/4.
template <class C>
class ScaledITable {
    using S = real_of<C>;
    static constexpr bool tabulated = std::is_same_v<S, double> || std::is_same_v<S, float>;
    static constexpr int coefficients = 15;  // odd; interpolation error below 1e-16 on every cell

  public:
    static constexpr int cells = 20;  // of width 1 in x, and as many of width 1/cells in cells/x beyond
    /// Whether `beyond` exists: on the real axis exp(-2x) is negligible past `cells`, and one polynomial does.
    static constexpr bool asymptotic = tabulated && std::is_same_v<C, S>;

    explicit ScaledITable(const C& direction) : direction_(direction) {
        if constexpr (tabulated) {
            for (int k = 0; k < cells; ++k) {
                near_[static_cast<std::size_t>(k)] = fit([&](long double xi) { return value(k + (xi + 1) / 2); });
                far_[static_cast<std::size_t>(k)] = fit([&](long double xi) {
                    const long double u = (k + (xi + 1) / 2) / cells;  // cells/x in (0, 1]
                    const long double x = cells / u;
                    Pair v = value(x);
                    v.i0 *= std::sqrt(x);
                    v.difference *= x * std::sqrt(x);
                    return v;
                });
            }
        }
        if constexpr (asymptotic) {
            beyond_ = fit([&](long double xi) {
                const long double x = 2 * cells / (xi + 1);
                Pair v = value(x);
                v.i0 *= std::sqrt(x);
                v.difference *= x * std::sqrt(x);
                return v;
            });
        }
    }

    /// sqrt(x) times the one and x^(3/2) times the other function, given 1/x <= 1/cells.
    ScaledIPair<C> beyond(const S& inverse) const { return sum(beyond_, 2 * S(cells) * inverse - S(1)); }

    ScaledIPair<C> operator()(const S& x) const {
        if constexpr (tabulated) {
            if (x < S(cells)) {
                const auto k = static_cast<std::size_t>(x);
                return sum(near_[k], 2 * (x - S(k)) - S(1));
            }
            const S u = S(cells) / x * S(cells);
            // u = cells exactly when x = cells.
            const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(u), cells - 1);
            ScaledIPair<C> v = sum(far_[k], 2 * (u - S(k)) - S(1));
            const S root = S(1) / std::sqrt(x);
            v.i0 *= root;
            v.difference *= root / x;
            return v;
        } else {
            const ScaledI<C> v = scaled_bessel_i<C>(direction_ * x);
            return {v.i0, v.difference};
        }
    }

  private:
    using Wide = typename WiderOf<C>::type;
    using Pair = ScaledIPair<Wide>;
    using Cell = std::array<ScaledIPair<C>, coefficients>;

    Pair value(long double x) const {
        const ScaledI<Wide> v = scaled_bessel_i<Wide>(Wide(direction_) * x);
        return {v.i0, v.difference};
    }

    static ScaledIPair<C> sum(const Cell& cell, const S& xi) {
        // Even and odd powers apart: two short dependency chains instead of a long one.
        const S square = xi * xi;
        ScaledIPair<C> even = cell[coefficients - 1];
        ScaledIPair<C> odd = cell[coefficients - 2];
        for (int k = coefficients - 3; k >= 2; k -= 2) {
            const auto i = static_cast<std::size_t>(k);
            even.i0 = even.i0 * square + cell[i].i0;
            even.difference = even.difference * square + cell[i].difference;
            odd.i0 = odd.i0 * square + cell[i - 1].i0;
            odd.difference = odd.difference * square + cell[i - 1].difference;
        }
        even.i0 = even.i0 * square + cell[0].i0;
        even.difference = even.difference * square + cell[0].difference;
        return {even.i0 + xi * odd.i0, even.difference + xi * odd.difference};
    }

    /// Chebyshev interpolation on [-1, 1], converted to powers.
    static Cell fit(const std::function<Pair(long double)>& function) {
        constexpr int n = coefficients;
        std::array<Pair, n> chebyshev{};
        for (int j = 0; j < n; ++j) {
            const long double angle = pi_value<long double>() * (j + 0.5L) / n;
            const Pair f = function(std::cos(angle));
            for (int k = 0; k < n; ++k) {
                const long double w = (k == 0 ? 1.0L : 2.0L) / n * std::cos(k * angle);
                chebyshev[static_cast<std::size_t>(k)].i0 += w * f.i0;
                chebyshev[static_cast<std::size_t>(k)].difference += w * f.difference;
            }
        }
        // T_{k+1} = 2 x T_k - T_{k-1} on coefficient arrays.
        std::array<long double, n> before{};
        std::array<long double, n> now{};
        before[0] = 1;
        now[1] = 1;
        std::array<Pair, n> powers{};
        for (int k = 0; k < n; ++k) {
            const std::array<long double, n>& t = k == 0 ? before : now;
            for (std::size_t i = 0; i < n; ++i) {
                powers[i].i0 += t[i] * chebyshev[static_cast<std::size_t>(k)].i0;
                powers[i].difference += t[i] * chebyshev[static_cast<std::size_t>(k)].difference;
            }
            if (k > 0) {
                std::array<long double, n> next{};
                for (std::size_t i = 0; i < n; ++i) {
                    next[i] = (i > 0 ? 2 * now[i - 1] : 0.0L) - before[i];
                }
                before = now;
                now = next;
            }
        }
        Cell cell;
        for (std::size_t i = 0; i < n; ++i) {
            cell[i] = {C(powers[i].i0), C(powers[i].difference)};
        }
        return cell;
    }

    C direction_;
    std::array<Cell, cells> near_;
    std::array<Cell, cells> far_;
    Cell beyond_;
};

}  // namespace axistokes::detail
