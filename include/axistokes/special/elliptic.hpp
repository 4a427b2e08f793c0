// SPDX-License-Identifier: MIT
// Complete elliptic integrals K(m), E(m) from the complementary parameter m1 = 1 - m.
//
// The argument is m1 because a ring seen from a distance d has m1 of order d^2: forming 1 - m first would lose every
// digit once d^2 falls below the rounding error.
#pragma once

#include "../core.hpp"
#include "elliptic_coefficients.hpp"
#include "fast_log.hpp"
#include "ring_integrals.hpp"

#include <cmath>

namespace axistokes {

template <class S>
struct EllipticKE {
    S k;
    S e;
};

namespace detail {

/// `log_m1` is an argument because loops want fast_log and single values std::log.
template <class S>
constexpr EllipticKE<S> elliptic_fit(S m1, S log_m1) noexcept {
    using Fit = EllipticFit<S>;
    return {horner(Fit::pk, m1) - log_m1 * horner(Fit::qk, m1),
            horner(Fit::pe, m1) - log_m1 * (m1 * horner(Fit::qe, m1))};
}

template <class S>
EllipticKE<S> elliptic_agm(const S& m1) {
    const AgmIntegrals<S> all = agm_integrals<S>(m1);
    return {all.k, all.e};
}

}  // namespace detail

/// K(1 - m1) and E(1 - m1), dimensionless, to a few units in the last place of S for m1 in (0, 1], however small.
/// float and double use minimax polynomials, other types the arithmetic-geometric mean.
/// Throws InvalidArgument when m1 <= 0, m1 > 1 or m1 is NaN.
template <class S>
EllipticKE<S> elliptic_ke(S m1) {
    detail::require(m1 > S(0) && m1 <= S(1), "complementary parameter m1", m1, "in (0, 1]");
    if constexpr (detail::EllipticFit<S>::available) {
        return detail::elliptic_fit(m1, std::log(m1));
    } else {
        return detail::elliptic_agm<S>(m1);
    }
}

/// K and E of n values. Precondition, not checked: every m1 is in (0, 1] and a normal number (not subnormal), and the
/// output arrays overlap neither each other nor the input.
template <class S>
void elliptic_ke(const S* m1, Index n, S* k, S* e) {
    const S* __restrict in = m1;
    S* __restrict out_k = k;
    S* __restrict out_e = e;
    for (Index i = 0; i < n; ++i) {
        EllipticKE<S> value;
        if constexpr (detail::EllipticFit<S>::available) {
            value = detail::elliptic_fit(in[i], detail::fast_log(in[i]));
        } else {
            value = detail::elliptic_agm<S>(in[i]);
        }
        out_k[i] = value.k;
        out_e[i] = value.e;
    }
}

}  // namespace axistokes
