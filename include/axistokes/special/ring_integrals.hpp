// SPDX-License-Identifier: MIT
// The two functions of the complementary parameter m1 = 1 - m from which every axisymmetric Stokeslet entry, and K and
// E themselves, follow as sums of positive terms (docs/free_space_kernel.md, section 2):
//
//   h = [(2 - m) K - 2 E] / m^2    = (pi/16)   2F1(3/2, 3/2; 3; m)
//   c = [(2 - m) E - 2 m1 K] / m^2 = (3 pi/16) 2F1(1/2, 3/2; 3; m)
//   K = (1 + m1) h + 2 c,   E = (1 + m1) c + 2 m1 h
//
// Each is split as h = ph - qh log(m1), c = pc - m1 qc log(m1), with all four factors regular at m1 = 0. float and
// double use minimax polynomials on the whole of (0, 1], all other types the arithmetic-geometric mean.
#pragma once

#include "../core.hpp"
#include "elliptic_coefficients.hpp"

#include <cmath>
#include <limits>

namespace axistokes {

template <class S>
struct RingIntegrals {
    S h;
    S c;
};

/// h = ph - qh log(m1), c = pc - m1 qc log(m1).
template <class S>
struct RingSplit {
    S ph;
    S qh;
    S pc;
    S qc;
};

namespace detail {

template <class S>
constexpr RingSplit<S> ring_split_fit(S m1) noexcept {
    using Fit = RingFit<S>;
    return {horner(Fit::ph, m1), horner(Fit::qh, m1), horner(Fit::pc, m1), horner(Fit::qc, m1)};
}

template <class S>
constexpr RingIntegrals<S> ring_from_split(const RingSplit<S>& split, S m1, S log_m1) noexcept {
    return {split.ph - log_m1 * split.qh, split.pc - log_m1 * (m1 * split.qc)};
}

template <class S>
struct AgmSums {
    S mean;  // agm(1, sqrt(m1)) = pi / (2 K(m))
    S sum;   // sum_{n>=1} 2^n (c_n / m)^2, c_n the n-th half difference; equals h(m) / K(m)
};

/// Gauss's arithmetic-geometric mean for parameter m and complement m1 = 1 - m (Abramowitz & Stegun 17.6). The half
/// differences come from c_{n+1} = c_n^2 / (4 a_{n+1}), c_0^2 = m, free of subtractions and divisible by m.
template <class S>
AgmSums<S> agm_sums(const S& m, const S& m1) {
    using std::sqrt;
    S b = sqrt(m1);
    S a = (S(1) + b) / 2;
    S c_over_m = S(1) / (4 * a);
    S weight = 2;
    S sum = 0;
    b = sqrt(b);
    for (;;) {
        const S term = weight * c_over_m * c_over_m;
        sum += term;
        const S next = (a + b) / 2;
        b = sqrt(a * b);
        a = next;
        if (term <= std::numeric_limits<S>::epsilon() * sum) {
            return {a, sum};
        }
        c_over_m = m * c_over_m * c_over_m / (4 * a);
        weight *= 2;
    }
}

template <class S>
struct AgmIntegrals {
    S k;
    S e;
    S h;
    S c;
};

/// K, E, h and c to the precision of any real type with sqrt and acos; m1 in (0, 1].
template <class S>
AgmIntegrals<S> agm_integrals(const S& m1) {
    const S m = S(1) - m1;
    const AgmSums<S> direct = agm_sums<S>(m, m1);
    const S k = pi_value<S>() / (2 * direct.mean);
    const S h = k * direct.sum;
    if (m1 >= S(0.25)) {
        const S c = (k - (S(1) + m1) * h) / 2;
        return {k, S((S(1) + m1) * c + 2 * m1 * h), h, c};
    }
    // K - (1 + m1) h would lose digits to the logarithm. Legendre's relation, solved for E, is a sum of positive terms:
    // E = pi / (2 K') + K (K' - E') / K'.
    const AgmSums<S> complementary = agm_sums<S>(m1, m);
    const S e = complementary.mean + k * m1 * (S(1) + m1 * complementary.sum) / 2;
    return {k, e, h, S((e - 2 * m1 * h) / (S(1) + m1))};
}

template <class S>
RingIntegrals<S> ring_integrals_agm(const S& m1) {
    const AgmIntegrals<S> all = agm_integrals<S>(m1);
    return {all.h, all.c};
}

/// The logarithms' exact coefficients are (1/2) 2F1(3/2, 3/2; 1; m1) and -(3/4) 2F1(3/2, 5/2; 2; m1). They are singular
/// at m1 = 1, that is on the axis, where there is no logarithm to represent; their Taylor polynomials are regular
/// everywhere, and leave in ph and pc a remainder of order m1^(degree+1) log(m1).
template <class S>
RingSplit<S> ring_split_agm(const S& m1) {
    using std::log;
    constexpr int kDegree = std::numeric_limits<S>::digits / 5;
    S qh = 1;
    S qc = 1;
    for (int n = kDegree - 1; n >= 0; --n) {
        const S odd = 2 * n + 3;
        qh = S(1) + m1 * qh * (odd * odd) / S(4 * (n + 1) * (n + 1));
        qc = S(1) + m1 * qc * (odd * (odd + 2)) / S(4 * (n + 1) * (n + 2));
    }
    qh /= 2;
    qc *= S(-3) / S(4);
    const RingIntegrals<S> value = ring_integrals_agm<S>(m1);
    const S log_m1 = log(m1);
    return {S(value.h + log_m1 * qh), qh, S(value.c + log_m1 * m1 * qc), qc};
}

}  // namespace detail

/// h(m1) and c(m1) for m1 in (0, 1]; arguments are not checked.
template <class S>
RingIntegrals<S> ring_integrals(S m1) {
    if constexpr (detail::RingFit<S>::available) {
        return detail::ring_from_split(detail::ring_split_fit(m1), m1, std::log(m1));
    } else {
        return detail::ring_integrals_agm<S>(m1);
    }
}

/// The logarithmic split of h and c for m1 in (0, 1]; arguments are not checked.
template <class S>
RingSplit<S> ring_split(S m1) {
    if constexpr (detail::RingFit<S>::available) {
        return detail::ring_split_fit(m1);
    } else {
        return detail::ring_split_agm<S>(m1);
    }
}

}  // namespace axistokes
