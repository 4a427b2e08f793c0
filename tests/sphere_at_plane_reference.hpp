// SPDX-License-Identifier: MIT
// A sphere that moves perpendicularly to a plane no-slip wall: the exact drag of Brenner, Chem. Eng. Sci. 16 (1961)
// 242, without cancellation at contact. Shares no code with the library.
//
// As for two spheres (two_spheres_reference.hpp), with the wall at xi = 0, where W_n = W_n' = 0:
// W_n = A_n [cosh(p xi) - cosh(q xi)] + B_n [q sinh(p xi) - p sinh(q xi)], and cosh(alpha) the height of the centre.
// The drag over 6 pi eta R U is
//
//   (4/3) sinh(alpha) sum_n n(n+1)/((2n-1)(2n+3)) [(2 sinh x + (2n+1) sinh(2 alpha))/D - 1],
//   x = (2n+1) alpha,   D = 4 sinh^2(x/2) - (2n+1)^2 sinh^2 alpha.
//
// The bracket is [2 (1 - exp(-x)) + (2n+1) sinh(2 alpha) + (2n+1)^2 sinh^2 alpha]/D, and D is the product of
// 2 sinh(x/2) +- (2n+1) sinh(alpha). With beta = alpha/2 and sinh(m beta) = sinh(beta) [1 + 2 sum_k cosh(2 k beta)],
// m = 2n + 1, the difference, which cancels as alpha -> 0, is 2 sinh(beta) e_n with
//
//   e_n = 1 - cosh(beta) + 2 sum_(k=1)^n [cosh(2 k beta) - cosh(beta)]
//       = -2 sinh^2(beta/2) + 4 sum_(k=1)^n sinh((2k+1) beta/2) sinh((2k-1) beta/2).
#pragma once

#include <axistokes/core.hpp>

#include <cmath>
#include <limits>

namespace axistokes::test {

/// Drag on a sphere of radius 1 with its centre at `height` > 1 above the wall, over that far from any wall.
template <class S>
S sphere_at_plane_drag_factor(const S& height) {
    using std::expm1;
    using std::log1p;
    using std::sinh;
    using std::sqrt;
    detail::require(height > S(1), "height of the centre", height, "> 1");
    const S gap = height - 1;  // cosh(alpha) - 1
    const S sinh_alpha = sqrt(gap * (gap + 2));
    const S alpha = log1p(S(gap + sinh_alpha));
    const S sinh_two_alpha = 2 * sinh_alpha * height;
    const S quarter = alpha / 4;
    const S sinh_quarter = sinh(quarter);
    S last = sinh_quarter;  // sinh((2k-1) beta/2)
    S e = -2 * sinh_quarter * sinh_quarter;
    S sum = 0;
    S term = 0;
    S n = 1;
    do {
        const S m = 2 * n + 1;
        const S x = m * alpha;
        const S a = m * sinh_alpha;
        const S next = sinh(S(m * quarter));
        e += 4 * next * last;
        last = next;
        const S denominator = 2 * sinh(S(alpha / 2)) * e * (2 * sinh(S(x / 2)) + a);
        term = n * (n + 1) / ((m - 2) * (m + 2)) * (m * sinh_two_alpha + a * a - 2 * expm1(S(-x))) / denominator;
        sum += term;
        n += 1;
        // What is left is about term/(1 - exp(-2 alpha)).
    } while (term > std::numeric_limits<S>::epsilon() * sum * sinh_alpha / (4 + 4 * sinh_alpha));
    return 4 * sinh_alpha * sum / 3;
}

}  // namespace axistokes::test
