// SPDX-License-Identifier: MIT
// Cosine and sine series on [0, pi], given by their values at t_j = j pi/N (docs/spectral.md, section 1).
//
// A meridian is continued across the axis by symmetry: z and scalars are even in t, r and radial components odd. With
// x = cos t an even series of degree N is a polynomial of degree N on the Chebyshev-Lobatto points, and an odd one sin
// t times a polynomial of degree N - 2: interpolation is barycentric, differentiation exact.
#pragma once

#include "../quadrature/computed_once.hpp"
#include "../quadrature/gauss_legendre.hpp"
#include "curve_samples.hpp"

#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <utility>

namespace axistokes {

namespace detail {

/// sum_k c_k cos(kt) and sum_k c_k sin(kt), k from 0 on, by Clenshaw's recurrence.
template <class S>
std::pair<S, S> trigonometric_sums(const Vector<S>& c, const S& t) {
    using std::cos;
    using std::sin;
    const S x = cos(t);
    S b1 = 0;
    S b2 = 0;
    for (Index k = c.size() - 1; k >= 1; --k) {
        const S b0 = c[k] + 2 * x * b1 - b2;
        b2 = b1;
        b1 = b0;
    }
    return {S(c[0] + x * b1 - b2), S(sin(t) * b1)};
}

template <class S>
S cosine_series(const Vector<S>& c, const S& t) {
    return trigonometric_sums<S>(c, t).first;
}

template <class S>
S sine_series(const Vector<S>& c, const S& t) {
    return trigonometric_sums<S>(c, t).second;
}

/// d/dt of the sine series.
template <class S>
S sine_series_slope(const Vector<S>& c, const S& t) {
    return cosine_series<S>(Vector<S>::LinSpaced(c.size(), S(0), S(c.size() - 1)).cwiseProduct(c), t);
}

}  // namespace detail

/// Matrices of the series of degree N: n = N + 1 nodal values -> something. Odd series vanish at the first and the last
/// node; the columns of these two values are zero.
template <class S>
class TrigonometricBasis {
  public:
    /// Values and slopes of both kinds of series at `size()` other points.
    struct Sampling {
        Vector<S> t;
        Vector<S> weights;  // of Int_0^pi dt, if the points belong to a rule
        Matrix<S> even;
        Matrix<S> odd;
        Matrix<S> even_slope;
        Matrix<S> odd_slope;
        Matrix<S> even_second;
        Matrix<S> odd_second;

        Index size() const { return t.size(); }
    };

    explicit TrigonometricBasis(Index degree) : degree_(degree) {
        using std::cos;
        using std::sin;
        const Index n = degree + 1;
        const S pi = detail::pi_value<S>();
        cosines_.resize(2 * degree);
        sines_.resize(2 * degree);
        for (Index m = 0; m < 2 * degree; ++m) {
            cosines_[m] = 2 * m == degree || 2 * m == 3 * degree ? S(0) : S(cos(pi * S(m) / S(degree)));
            sines_[m] = m == 0 || m == degree ? S(0) : S(sin(pi * S(m) / S(degree)));
        }
        t_.resize(n);
        sin2_half_.resize(n);
        cos2_half_.resize(n);
        barycentric_.resize(n);
        for (Index j = 0; j < n; ++j) {
            t_[j] = pi * S(j) / S(degree);
            const S s = sin(t_[j] / 2);
            const S c = sin((pi - t_[j]) / 2);
            sin2_half_[j] = s * s;
            cos2_half_[j] = c * c;
            barycentric_[j] = S(j % 2 == 0 ? 1 : -1) / S(j == 0 || j == degree ? 2 : 1);
        }
        transforms();
        differentiation();
        clenshaw_curtis();
        fine();
    }

    /// The basis of that degree, computed once.
    static std::shared_ptr<const TrigonometricBasis> of_degree(Index degree) {
        return detail::computed_once<TrigonometricBasis>(degree);
    }

    Index degree() const { return degree_; }
    Index size() const { return degree_ + 1; }
    const Vector<S>& nodes() const { return t_; }
    S sine(Index node) const { return sines_[node]; }

    const Matrix<S>& even_coefficients() const { return even_coefficients_; }
    const Matrix<S>& odd_coefficients() const { return odd_coefficients_; }
    const Matrix<S>& even_first() const { return even_first_; }
    const Matrix<S>& even_second() const { return even_second_; }
    const Matrix<S>& odd_first() const { return odd_first_; }
    const Matrix<S>& odd_second() const { return odd_second_; }

    /// Weights of Int_0^pi g(t) sin(t) dt for even g (Clenshaw-Curtis), positive.
    const Vector<S>& sine_weights() const { return sine_weights_; }

    /// Points of the Gauss-Legendre rule in cos t with 2N nodes: exact for sine series of degree 4N.
    const Sampling& fine() const { return fine_; }

    /// The even cardinal functions at t: 1 at one node, 0 at the others. `out` has n values.
    template <class Out>
    void cardinals(const S& t, Out&& out) const {
        using std::cos;
        using std::sin;
        const S s = sin(t / 2);
        const S c = cos(t / 2);
        // (cos t_j - cos t)/2, free of cancellation near the poles.
        auto difference = (s * s) * cos2_half_.array() - (c * c) * sin2_half_.array();
        out = (barycentric_.array() / difference).matrix();
        const S sum = out.sum();
        using std::isfinite;
        if (isfinite(sum)) {
            out *= S(1) / sum;
            return;
        }
        for (Index j = 0; j < size(); ++j) {
            out[j] = difference[j] == S(0) ? S(1) : S(0);
        }
    }

    /// Values and slopes at the points t.
    Sampling sample(const Vector<S>& t) const {
        using std::cos;
        using std::sin;
        const Index n = size();
        const Index count = t.size();
        Matrix<S> c(count, n);
        Matrix<S> s(count, n);
        for (Index i = 0; i < count; ++i) {
            for (Index k = 0; k < n; ++k) {
                c(i, k) = cos(S(k) * t[i]);
                s(i, k) = sin(S(k) * t[i]);
            }
        }
        const Vector<S> k = Vector<S>::LinSpaced(n, S(0), S(degree_));
        Sampling result;
        result.t = t;
        result.even = c * even_coefficients_;
        result.odd = s * odd_coefficients_;
        result.even_slope = -(s * k.asDiagonal()) * even_coefficients_;
        result.odd_slope = (c * k.asDiagonal()) * odd_coefficients_;
        result.even_second = -(c * k.cwiseAbs2().asDiagonal()) * even_coefficients_;
        result.odd_second = -(s * k.cwiseAbs2().asDiagonal()) * odd_coefficients_;
        return result;
    }

  private:
    void transforms() {
        const Index n = size();
        even_coefficients_.resize(n, n);
        odd_coefficients_ = Matrix<S>::Zero(n, n);
        for (Index k = 0; k < n; ++k) {
            const bool end = k == 0 || k == degree_;
            for (Index j = 0; j < n; ++j) {
                const S half = S(j == 0 || j == degree_ ? 1 : 2) / S(end ? 2 : 1);
                even_coefficients_(k, j) = half * cosines_[k * j % (2 * degree_)] / S(degree_);
                if (!end) {
                    odd_coefficients_(k, j) = 2 * sines_[k * j % (2 * degree_)] / S(degree_);
                }
            }
        }
    }

    /// The derivatives of the interpolant through 2N equidistant points of a period (Trefethen, Spectral Methods in
    /// Matlab, chapter 3), folded: column k stands for t_k and its mirror image -t_k. Sums of the modes' derivatives
    /// are the same but for round-off, which here does not grow with the highest mode. A constant has no derivative.
    void differentiation() {
        const Index n = size();
        const auto sign = [](Index m) { return S(m % 2 == 0 ? 1 : -1); };
        // sin and cos of m pi/(2N).
        const auto half_sine = [&](Index m) {
            using std::sin;
            return S(sin(detail::pi_value<S>() * S(m > degree_ ? 2 * degree_ - m : m) / S(2 * degree_)));
        };
        const auto first = [&](Index m) {
            m = (m + 2 * degree_) % (2 * degree_);
            return m == 0 || m == degree_ ? S(0)
                                          : S(sign(m) * half_sine(m > degree_ ? m - degree_ : degree_ - m) *
                                              S(m > degree_ ? -1 : 1) / (2 * half_sine(m)));
        };
        const auto second = [&](Index m) {
            m = (m + 2 * degree_) % (2 * degree_);
            if (m == 0) {
                return S(-(S(degree_) * S(degree_) / S(3) + S(1) / S(6)));
            }
            const S s = half_sine(m);
            return S(-sign(m) / (2 * s * s));
        };
        for (Matrix<S>* d : {&even_first_, &even_second_, &odd_first_, &odd_second_}) {
            d->setZero(n, n);
        }
        for (Index j = 0; j < n; ++j) {
            even_first_(j, 0) = first(j);
            even_second_(j, 0) = second(j);
            even_first_(j, degree_) = first(j - degree_);
            even_second_(j, degree_) = second(j - degree_);
            for (Index k = 1; k < degree_; ++k) {
                even_first_(j, k) = first(j - k) + first(j + k);
                even_second_(j, k) = second(j - k) + second(j + k);
                odd_first_(j, k) = first(j - k) - first(j + k);
                odd_second_(j, k) = second(j - k) - second(j + k);
            }
        }
        for (Matrix<S>* d : {&even_first_, &even_second_}) {
            d->diagonal().setZero();
            d->diagonal() = -d->rowwise().sum();
        }
        // Likewise the second derivative of sin t is -sin t.
        for (Index j = 1; j < degree_; ++j) {
            const Vector<S> others = odd_second_.row(j).transpose().cwiseProduct(sines_.head(n));
            odd_second_(j, j) -= (sines_[j] + others.sum()) / sines_[j];
        }
        even_first_.row(0).setZero();
        even_first_.row(degree_).setZero();
        odd_second_.row(0).setZero();
        odd_second_.row(degree_).setZero();
    }

    /// Int_0^pi cos(kt) sin(t) dt = 2/(1 - k^2) for even k, 0 for odd.
    void clenshaw_curtis() {
        sine_weights_ = Vector<S>::Zero(size());
        for (Index k = 0; k <= degree_; k += 2) {
            sine_weights_ += (S(2) / S(1 - k * k)) * even_coefficients_.row(k).transpose();
        }
    }

    void fine() {
        using std::acos;
        using std::sqrt;
        const GaussLegendreRule<S> rule = gauss_legendre<S>(2 * degree_);
        const Index count = rule.nodes.size();
        Vector<S> t(count);
        Vector<S> weights(count);
        for (Index q = 0; q < count; ++q) {
            // cos t = 1 - 2 x; the sine is 2 sqrt(x (1 - x)).
            const S x = rule.nodes[q];
            t[q] = acos(S(1) - 2 * x);
            weights[q] = rule.weights[q] / sqrt(x * (S(1) - x));
        }
        fine_ = sample(t);
        fine_.weights = weights;
    }

    Index degree_;
    Vector<S> cosines_;  // cos(m pi/N)
    Vector<S> sines_;
    Vector<S> t_;
    Vector<S> sin2_half_;  // sin^2(t_j/2)
    Vector<S> cos2_half_;
    Vector<S> barycentric_;
    Matrix<S> even_coefficients_;
    Matrix<S> odd_coefficients_;
    Matrix<S> even_first_;
    Matrix<S> even_second_;
    Matrix<S> odd_first_;
    Matrix<S> odd_second_;
    Vector<S> sine_weights_;
    Sampling fine_;
};

namespace detail {

/// A meridian of series at its nodes.
template <class S>
CurveSamples<S> series_curve(const Meridian<S>& m) {
    const auto basis = TrigonometricBasis<S>::of_degree(m.elements());
    CurveSamples<S> curve{m.r,
                          m.z,
                          basis->odd_first() * m.r,
                          basis->even_first() * m.z,
                          basis->odd_second() * m.r,
                          basis->even_second() * m.z,
                          {}};
    curve.finish();
    return curve;
}

}  // namespace detail
}  // namespace axistokes
