// SPDX-License-Identifier: MIT
// Two equal spheres that move along their line of centres with the same velocity: the exact series of M. Stimson and
// G. B. Jeffery (Proc. R. Soc. A 111, 1926), rearranged so that nothing cancels. Shares no code with the library.
//
// Lengths in sphere radii, centres at z = +-d/2. Bispherical coordinates z + i r = i c cot((eta + i xi)/2) with
// c = sinh(alpha), cosh(alpha) = d/2 have the spheres at xi = +-alpha and r = c sin(eta)/(cosh xi - mu), mu = cos(eta).
// With u_z = psi_r/r and u_r = -psi_z/r every Stokes flow outside is
//
//   psi = (cosh xi - mu)^(-3/2) sum_n U_n(xi) V_n(mu),   V_n = P_(n-1) - P_(n+1),   n >= 1,
//   U_n = A_n cosh(p xi) + C_n cosh(q xi),   p = n - 1/2,   q = n + 3/2,
//
// if it is even in z. On the spheres psi = U r^2/2, and so is its derivative along xi. From the generating function
// (cosh xi - mu)^(-1/2) = sqrt(2) sum_n e^(-(n + 1/2) xi) P_n(mu),
//
//   (cosh xi - mu)^(3/2) r^2/2 = sum_n k_n [(2n+3) e^(-p xi) - (2n-1) e^(-q xi)] V_n,
//   k_n = c^2 n (n+1) / (sqrt(2) (2n-1) (2n+1) (2n+3)),
//
// which gives U_n(alpha) and U_n'(alpha), two equations for A_n and C_n. Far away, where eta, xi -> 0, V_n is
// (2n+1) eta^2/2 and psi becomes that of a Stokeslet, (F/(8 pi)) r^2/R, with the force of both spheres on the fluid
//
//   F = (4 sqrt(2) pi/c) sum_n (2n+1) (A_n + C_n).
//
// The solution of the two equations is A_n + C_n = 4 k_n U G_n/D_n, with k = 2n + 1
//
//   D_n = 2 sinh(k alpha) + k sinh(2 alpha)
//   G_n = D_n - [4 sinh^2(k alpha/2) - k^2 sinh^2(alpha)]
//       = 2 (1 - e^(-k alpha)) + k sinh(2 alpha) + k^2 sinh^2(alpha).
//
// Stimson and Jeffery have the difference; in the second form all terms are positive.
#pragma once

#include <cmath>
#include <limits>

namespace axistokes::test {

/// Terms of the series in bispherical coordinates, for a sphere whose centre is at c coth(alpha).
template <class S>
struct BisphericalTerms {
    /// cosh(alpha) = 1 + excess, without the loss of acosh near 1.
    static S alpha_of_excess(const S& excess) {
        using std::asinh;
        using std::sqrt;
        return 2 * asinh(S(sqrt(excess / 2)));
    }

    explicit BisphericalTerms(const S& a) : alpha(a) {
        using std::sinh;
        sinh_alpha = sinh(a);
        sinh_twice = sinh(S(2 * a));
    }

    S d(int k) const {
        using std::sinh;
        return 2 * sinh(S(k * alpha)) + k * sinh_twice;
    }
    S g(int k) const {
        using std::exp;
        using std::sinh;
        const S half = k * alpha / 2;
        return 4 * exp(S(-half)) * sinh(half) + k * sinh_twice + k * k * (sinh_alpha * sinh_alpha);
    }

    /// (4/3) c sum_n n (n+1)/((2n-1)(2n+3)) ratio(2n+1): a force over 6 pi.
    template <class Ratio>
    S drag_factor(const Ratio& ratio) const {
        S sum = 0;
        for (int n = 1;; ++n) {
            const S term = S(n) * S(n + 1) / (S(2 * n - 1) * S(2 * n + 3)) * ratio(2 * n + 1);
            sum += term;
            // What is left is a geometric series of ratio e^(-2 alpha).
            if (term < std::numeric_limits<S>::epsilon() / 8 * sinh_alpha * sum) {
                return 4 * sinh_alpha / 3 * sum;
            }
        }
    }

    S alpha;
    S sinh_alpha;
    S sinh_twice;
};

/// Force on each of two spheres of radius 1 at the distance d > 2 of their centres, over 6 pi U.
template <class S>
S two_spheres_drag_factor(const S& distance) {
    const BisphericalTerms<S> terms(BisphericalTerms<S>::alpha_of_excess((distance - 2) / 2));
    return terms.drag_factor([&](int k) { return S(terms.g(k) / terms.d(k)); });
}

}  // namespace axistokes::test
