// SPDX-License-Identifier: MIT
// Modified Bessel functions of the orders 0, 1, 2, exponentially scaled, for real and complex arguments of any
// precision.
//
// Scaled, they neither overflow nor vanish: e^(-x) I and e^x K decay like x^(-1/2). Differences that cancel for large
// arguments (I0 - I1, K1 - K0) are computed as such. Three representations cover the right half-plane |arg x| <= pi/4:
//
//   |x| small   power series (DLMF 10.25.2, 10.31.1-2), whose terms for real x are positive
//   between     I_n e^(-x) = (1/pi) Int_0^pi exp(-x (1 - cos u)) cos(n u) du           (DLMF 10.32.3)
//               K_n e^x    = Int_0^inf exp(-x (cosh u - 1)) cosh(n u) du               (DLMF 10.32.9)
//               by the trapezoidal rule, which converges geometrically for both
//   |x| large   Hankel's expansions (DLMF 10.40.1-2), once e^(-2|x|) is below the rounding error
#pragma once

#include "../core.hpp"

#include <cmath>
#include <complex>
#include <limits>

namespace axistokes {

namespace detail {

template <class X>
struct RealOf {
    using type = X;
};
template <class S>
struct RealOf<std::complex<S>> {
    using type = S;
};
template <class X>
using real_of = typename RealOf<X>::type;

/// 0.577..., to 110 digits.
template <class S>
S euler_constant() {
    if constexpr (std::is_floating_point_v<S>) {
        return std::numbers::egamma_v<S>;
    } else {
        static_assert(std::numeric_limits<S>::digits10 <= 110);
        static const S value(
            "0.57721566490153286060651209008240243104215933593992359880576723488486772677766467093694706329174674951463"
            "144724980708248096050401448654283622417");
        return value;
    }
}

/// log(1/eps), the number of e-foldings that matter.
template <class S>
S decades() {
    using std::log;
    return -log(std::numeric_limits<S>::epsilon());
}

/// Below this modulus the power series lose at most a digit, on the diagonal arg x = pi/4 too.
inline constexpr int bessel_series_limit = 4;

/// Power series of I0, I1, I2 without the scale factor.
template <class X>
struct BesselSeries {
    explicit BesselSeries(const X& x) {
        using std::abs;
        using S = real_of<X>;
        const X q = x * x / S(4);
        X term = S(1);  // q^k / k!^2
        i0 = S(1);
        first = S(1);
        second = S(1);
        for (int k = 1; abs(term) > std::numeric_limits<S>::epsilon() * abs(i0) / 4; ++k) {
            term *= q / S(k) / S(k);
            i0 += term;
            first_excess += term / S(k + 1);
            second += term * S(2) / (S(k + 1) * S(k + 2));
        }
        first += first_excess;
        i1 = x / S(2) * first;
        i2 = q / S(2) * second;
    }

    X i0{}, i1{}, i2{};
    X first{};         // I1 / (x/2)
    X first_excess{};  // I1 / (x/2) - 1
    X second{};        // I2 / (x^2/8)
};

/// Hankel's expansions for the orders 0 and 1 without the common factor; sign = -1 for I, +1 for K.
template <class X>
struct HankelSeries {
    HankelSeries(const X& x, int sign) {
        using std::abs;
        using S = real_of<X>;
        X a0 = S(1);
        X a1 = S(1);
        zero = S(1);
        for (int k = 1; abs(a0) > std::numeric_limits<S>::epsilon() / 4; ++k) {
            const int odd = 2 * k - 1;
            const X factor = S(sign) / (S(8 * k) * x);
            const X next = a0 * factor * S(-odd * odd);
            if (abs(next) > abs(a0)) {
                break;
            }
            a1 *= factor * S(4 - odd * odd);
            a0 = next;
            zero += a0;
            one_minus_zero += a1 - a0;
        }
    }

    X zero{};
    X one_minus_zero{};
};

}  // namespace detail

/// e^(-x) times I0, I1, I2 and I0 - I1.
template <class X>
struct ScaledI {
    X i0{}, i1{}, i2{}, difference{};
};

/// e^x times K0, K1 and K1 - K0.
template <class X>
struct ScaledK {
    X k0{}, k1{}, difference{};
};

/// Dimensionless; |arg x| <= pi/4, x = 0 included. Relative error a few eps in every member.
template <class X>
ScaledI<X> scaled_bessel_i(const X& x) {
    using std::abs;
    using std::ceil;
    using std::exp;
    using std::sin;
    using std::sqrt;
    using S = detail::real_of<X>;
    ScaledI<X> v;
    const S modulus = abs(x);
    if (modulus <= S(detail::bessel_series_limit)) {
        const detail::BesselSeries<X> series(x);
        const X scale = exp(-x);
        v.i0 = scale * series.i0;
        v.i1 = scale * series.i1;
        v.i2 = scale * series.i2;
        v.difference = v.i0 - v.i1;
        return v;
    }
    const S digits = detail::decades<S>() + 2;
    if (2 * modulus > S(1.5) * digits) {
        const detail::HankelSeries<X> series(x, -1);
        const X scale = S(1) / sqrt(2 * detail::pi_value<S>() * x);
        v.i0 = scale * series.zero;
        v.difference = -scale * series.one_minus_zero;
    } else {
        // Aliasing: e^(-x) I_2n(x) ~ exp(-(2n)^2/(2x)), for arg x = pi/4 with 1/sqrt(2) in the exponent.
        const auto n = static_cast<Index>(ceil(sqrt(S(3) * modulus * digits) / 2 + digits / 5));
        v.i0 = (S(1) + exp(S(-2) * x)) / S(2);
        v.difference = exp(S(-2) * x);
        for (Index j = 1; j < n; ++j) {
            const S half = sin(detail::pi_value<S>() * S(j) / S(2 * n));
            const S versine = 2 * half * half;
            const X term = exp(-x * versine);
            v.i0 += term;
            v.difference += versine * term;
        }
        v.i0 /= S(n);
        v.difference /= S(n);
    }
    v.i1 = v.i0 - v.difference;
    v.i2 = v.i0 - S(2) * v.i1 / x;
    return v;
}

/// Dimensionless; |arg x| <= pi/4, x != 0. Relative error a few eps in every member.
template <class X>
ScaledK<X> scaled_bessel_k(const X& x);

/// The parts of K0 and K1 that remain when their logarithms are taken out, for |x| <= 4 (DLMF 10.31.1-2):
///   K0 = k0 - log(x) I0,     K1 = 1/x + k1 + log(x) I1.
template <class X>
struct LogFreeK {
    explicit LogFreeK(const X& x) {
        using std::abs;
        using S = detail::real_of<X>;
        using std::log;
        const S log2 = log(S(2));
        const S euler = detail::euler_constant<S>();
        const X q = x * x / S(4);
        X term = S(1);
        S harmonic = 0;
        X sum0 = S(0);
        X sum1 = S(1) - 2 * euler;
        X i0 = S(1);
        X first = S(1);
        for (int k = 1; abs(term) * (harmonic + 1) > std::numeric_limits<S>::epsilon() * abs(i0) / 4; ++k) {
            term *= q / S(k) / S(k);
            harmonic += S(1) / S(k);
            i0 += term;
            first += term / S(k + 1);
            sum0 += harmonic * term;
            sum1 += (2 * harmonic + S(1) / S(k + 1) - 2 * euler) * term / S(k + 1);
        }
        k0 = (log2 - euler) * i0 + sum0;
        k1 = -x / S(2) * (log2 * first + sum1 / S(2));
    }
    X k0{}, k1{};
};

template <class X>
ScaledK<X> scaled_bessel_k(const X& x) {
    using std::abs;
    using std::acosh;
    using std::exp;
    using std::log;
    using std::sinh;
    using std::sqrt;
    using S = detail::real_of<X>;
    ScaledK<X> v;
    const S modulus = abs(x);
    const S digits = detail::decades<S>() + 2;
    if (modulus <= S(1)) {
        const LogFreeK<X> smooth(x);
        const detail::BesselSeries<X> series(x);
        const X scale = exp(x);
        v.k0 = scale * (smooth.k0 - log(x) * series.i0);
        v.k1 = scale * (S(1) / x + smooth.k1 + log(x) * series.i1);
        v.difference = v.k1 - v.k0;
        return v;
    }
    if (2 * modulus > S(1.5) * digits) {
        const detail::HankelSeries<X> series(x, 1);
        const X scale = sqrt(detail::pi_value<S>() / (S(2) * x));
        v.k0 = scale * series.zero;
        v.difference = scale * series.one_minus_zero;
    } else {
        // Error exp(-2 pi a/h) for a strip of half-width a; on the diagonal a < pi/4, and the integrand grows towards
        // it.
        const S pi = detail::pi_value<S>();
        const S h = pi * pi / 3 / (digits + 4);
        const S cut = acosh(S(1) + S(1.5) * digits / modulus);
        v.k0 = S(0.5);
        for (int j = 1; S(j) * h < cut; ++j) {
            const S half = sinh(S(j) * h / 2);
            const S excess = 2 * half * half;  // cosh - 1
            const X term = exp(-x * excess);
            v.k0 += term;
            v.difference += excess * term;
        }
        v.k0 *= h;
        v.difference *= h;
    }
    v.k1 = v.k0 + v.difference;
    return v;
}

}  // namespace axistokes
