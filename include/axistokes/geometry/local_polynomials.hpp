// SPDX-License-Identifier: MIT
// Functions of the node index as piecewise polynomials (docs/adaptive.md, section 1).
//
// Between the nodes e and e + 1 a function is the polynomial through the 2m nodes around: e - m + 1, ..., e + m. At a
// node its derivatives are those of the polynomial through the 2m + 1 nodes around it. A meridian is continued across
// the axis by symmetry: z and scalars are even about its two poles, r and radial components odd.
#pragma once

#include "../quadrature/computed_once.hpp"
#include "../quadrature/gauss_legendre.hpp"
#include "curve_samples.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <memory>

namespace axistokes::detail {

/// Coefficients of the Lagrange polynomials of `points`: (k, j) is that of x^k in the one that is 1 at point j.
template <class S>
Matrix<S> cardinal_polynomials(const Vector<S>& points) {
    const Index n = points.size();
    Matrix<S> result(n, n);
    for (Index j = 0; j < n; ++j) {
        Vector<S> product = Vector<S>::Zero(n);
        product[0] = 1;
        Index degree = 0;
        for (Index l = 0; l < n; ++l) {
            if (l == j) {
                continue;
            }
            const S scale = S(1) / (points[j] - points[l]);
            ++degree;
            for (Index k = degree; k > 0; --k) {
                product[k] = (product[k - 1] - points[l] * product[k]) * scale;
            }
            product[0] *= -points[l] * scale;
        }
        result.col(j) = product;
    }
    return result;
}

/// Where a node outside of 0, ..., last is by symmetry, and with which sign (of odd functions -1).
struct Reflection {
    Index node;
    int sign;
};
inline Reflection reflection(Index i, Index last, int parity) {
    return i < 0 ? Reflection{-i, parity} : i > last ? Reflection{2 * last - i, parity} : Reflection{i, 1};
}
/// The same for the middles of elements, of even functions: 0, ..., elements - 1.
inline Index reflected_middle(Index e, Index elements) {
    return e < 0 ? -1 - e : e >= elements ? 2 * elements - 1 - e : e;
}

/// Weights of the nodal values in values and derivatives, for half a width m.
template <class S>
struct LocalStencils {
    explicit LocalStencils(Index half)
        : cardinals(cardinal_polynomials<S>(Vector<S>::LinSpaced(2 * half, S(1 - 2 * half) / 2, S(2 * half - 1) / 2))) {
        const Matrix<S> centred = cardinal_polynomials<S>(Vector<S>::LinSpaced(2 * half + 1, S(-half), S(half)));
        first = centred.row(1).transpose();
        second = 2 * centred.row(2).transpose();
        middle = cardinals.row(0).transpose();
        middle_slope = cardinals.row(1).transpose();
    }

    /// Of an element's 2m nodes; x = 0 is its middle, its ends are -1/2 and 1/2.
    Matrix<S> cardinals;
    Vector<S> middle;  // 2m: value and slope between two nodes
    Vector<S> middle_slope;
    Vector<S> first;  // 2m + 1: derivatives at the middle one of them
    Vector<S> second;
};

template <class S>
std::shared_ptr<const LocalStencils<S>> local_stencils(Index half) {
    return computed_once<LocalStencils<S>>(half);
}

/// `values` continued by `by` nodes on either side.
template <class S>
Vector<S> continued(const Vector<S>& values, int parity, Index by) {
    const Index last = values.size() - 1;
    Vector<S> all(values.size() + 2 * by);
    for (Index k = 0; k < all.size(); ++k) {
        const auto [node, sign] = reflection(k - by, last, parity);
        all[k] = S(sign) * values[node];
    }
    return all;
}

/// A stencil of 2 half + 1 nodes, applied at every node.
template <class S>
Vector<S> differences(const Vector<S>& values, const Vector<S>& stencil, int parity, Index half) {
    const Vector<S> all = continued(values, parity, half);
    Vector<S> result(values.size());
    for (Index i = 0; i < values.size(); ++i) {
        result[i] = stencil.dot(all.segment(i, 2 * half + 1));
    }
    return result;
}

/// A meridian at its nodes.
template <class S>
CurveSamples<S> local_curve(const Meridian<S>& m, Index half) {
    const auto stencils = local_stencils<S>(half);
    CurveSamples<S> curve{m.r,
                          m.z,
                          differences(m.r, stencils->first, -1, half),
                          differences(m.z, stencils->first, 1, half),
                          differences(m.r, stencils->second, -1, half),
                          differences(m.z, stencils->second, 1, half),
                          {}};
    curve.finish();
    return curve;
}

/// A function of the node index.
template <class S>
class LocalPolynomials {
  public:
    /// `parity`: 1 of even functions, -1 of odd ones.
    LocalPolynomials(const Vector<S>& values, int parity, Index half) : coefficients_(2 * half, values.size() - 1) {
        const auto stencils = local_stencils<S>(half);
        const Vector<S> all = continued(values, parity, half);
        for (Index e = 0; e < coefficients_.cols(); ++e) {
            coefficients_.col(e).noalias() = stencils->cardinals * all.segment(e + 1, 2 * half);
        }
    }

    Index elements() const { return coefficients_.cols(); }

    /// t in [0, 1] along element e.
    S value(Index e, const S& t) const {
        const S x = t - S(1) / 2;
        S sum = 0;
        for (Index k = coefficients_.rows() - 1; k >= 0; --k) {
            sum = sum * x + coefficients_(k, e);
        }
        return sum;
    }
    S slope(Index e, const S& t) const {
        const S x = t - S(1) / 2;
        S sum = 0;
        for (Index k = coefficients_.rows() - 1; k >= 1; --k) {
            sum = sum * x + S(k) * coefficients_(k, e);
        }
        return sum;
    }
    S second(Index e, const S& t) const {
        const S x = t - S(1) / 2;
        S sum = 0;
        for (Index k = coefficients_.rows() - 1; k >= 2; --k) {
            sum = sum * x + S(k * (k - 1)) * coefficients_(k, e);
        }
        return sum;
    }
    /// From the element's beginning to t.
    S integral(Index e, const S& t) const {
        const S half = S(1) / 2;
        const S x = t - half;
        S upper = 0;
        S lower = 0;
        for (Index k = coefficients_.rows() - 1; k >= 0; --k) {
            const S c = coefficients_(k, e) / S(k + 1);
            upper = upper * x + c;
            lower = lower * -half + c;
        }
        return upper * x + lower * half;
    }

  private:
    Matrix<S> coefficients_;
};

}  // namespace axistokes::detail
