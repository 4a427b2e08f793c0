// SPDX-License-Identifier: MIT
// The wall's part of the Green function of a tube, mode by mode (docs/tube_kernel.md).
//
// For a wave number zeta the correction is a Stokes flow that is regular on the axis: a combination of two modes. They
// are normalised at the wall, P: (u_z, u_r) = (1, 0) and Q: (0, 1) there, so that they stay independent at both ends of
// the spectrum. With W = zeta Rc, t = zeta r, zh = z - z0,
//
//   M_c(x0, x) = -r Int_0^inf dzeta sum_{k,l in {P,Q}} S_kl(W) u^k_a(t0) u^l_b(t) phase_ab                         (1)
//   phase: rr, zz: cos(zeta zh)    zr: sin(zeta zh)    rz: -sin(zeta zh)
//   S_PP = 4 [2 I0 K0 - 1 + 2 W I1 K0]    S_QQ = 4 [2 I1 K1 - 1 + 2 W I1 K0]    S_PQ = 4 W [I0 K0 - I1 K1]   (at W) (2)
//
// zeta may be complex: for zh of one sign the path of (1) can be turned into the quadrant where exp(i zeta |zh|)
// decays.
#pragma once

#include "../special/bessel.hpp"
#include "../special/bessel_table.hpp"

namespace axistokes::detail {

/// S of eq. (2), symmetric; combined with the weight of a quadrature in zeta.
template <class C>
struct TubeCoupling {
    C pp{}, pq{}, qq{};
};

/// The two modes at one radius: first letter component, second mode.
template <class C>
struct TubeModes {
    C zp{}, rp{}, zq{}, rq{};
};

/// S at W, for any |W|. Away from zero 1 = W (I0 K1 + I1 K0) is used to form the small results from small terms.
template <class C>
TubeCoupling<C> tube_coupling(const C& w) {
    using S = real_of<C>;
    const ScaledI<C> i = scaled_bessel_i<C>(w);
    const ScaledK<C> k = scaled_bessel_k<C>(w);
    const C d = w * i.difference;
    const C e = w * k.difference;
    const C common = d * k.k1 + i.i1 * e;  // W (I0 K1 - I1 K0)
    return {S(4) * (S(2) * i.i0 * k.k0 - common), S(4) * (d * k.k0 - i.i1 * e), S(4) * (S(2) * i.i1 * k.k1 - common)};
}

/// S = smooth + log(W) logarithm for |W| <= 4, both analytic at 0.
template <class C>
struct TubeCouplingSplit {
    explicit TubeCouplingSplit(const C& w) {
        using S = real_of<C>;
        const BesselSeries<C> i(w);
        const LogFreeK<C> k(w);
        const C mixed = S(2) * w * i.i1;
        smooth.pp = S(4) * (S(2) * i.i0 * k.k0 - S(1) + mixed * k.k0);
        smooth.pq = S(4) * w * (i.i0 * k.k0 - i.i1 * k.k1 - i.first / S(2));
        // 2 I1/W - 1 = first_excess: what is left is O(W^2), as it must be.
        smooth.qq = S(4) * (i.first_excess + S(2) * i.i1 * k.k1 + mixed * k.k0);
        logarithm.pp = -S(4) * (S(2) * i.i0 * i.i0 + mixed * i.i0);
        logarithm.pq = -S(4) * w * (i.i0 * i.i0 + i.i1 * i.i1);
        logarithm.qq = S(4) * (S(2) * i.i1 * i.i1 - mixed * i.i0);
    }
    TubeCoupling<C> smooth;
    TubeCoupling<C> logarithm;
};

/// Evaluates both modes at one wave number for any radius. Scaled Bessel functions throughout; the remaining
/// exponential exp(-zeta (Rc - r)) comes from the distance to the wall, which the caller forms from the coordinates.
template <class C>
class TubeModeEvaluator {
  public:
    using S = real_of<C>;

    TubeModeEvaluator(const C& zeta, const S& tube_radius)
        : zeta_(zeta), w_(zeta * tube_radius), tube_radius_(tube_radius) {
        using std::abs;
        modulus_ = abs(zeta);
        const ScaledI<C> i = scaled_bessel_i<C>(w_);
        series_ = abs(w_) <= S(2);
        const C d = w_ * i.difference;
        // Determinant of the two modes regular at 0, W (I0 I2 - I1^2), in the form that does not cancel.
        const C determinant = series_ ? C(w_ * (i.i0 * i.i2 - i.i1 * i.i1)) : C((i.i0 + i.i1) * d - S(2) * i.i0 * i.i1);
        const C scale = S(1) / determinant;
        i0_ = scale * i.i0;
        i1_ = scale * i.i1;
        i2_ = scale * i.i2;
        d_over_det_ = scale * d;
    }

    const C& zeta() const { return zeta_; }

    /// At radius r, `gap` from the wall; `table` gives the scaled Bessel functions along the ray of zeta.
    TubeModes<C> operator()(const S& r, const S& gap, const ScaledITable<C>& table) const {
        using std::exp;
        const C t = zeta_ * r;
        const C delta = zeta_ * gap;
        const C decay = exp(-delta);
        if (series_) {
            const ScaledI<C> b = scaled_bessel_i<C>(t);
            const C ti1 = t * b.i1;
            const C ti2 = t * b.i2;
            return {decay * (w_ * i2_ * b.i0 - i1_ * ti1), decay * (w_ * i2_ * b.i1 - i1_ * ti2),
                    decay * (i0_ * ti1 - w_ * i1_ * b.i0), decay * (i0_ * ti2 - w_ * i1_ * b.i1)};
        }
        // W - t = delta taken out of the differences of products: no cancellation of large W against large t.
        const ScaledIPair<C> b = table(modulus_ * r);
        const C shift = delta * i0_;
        const C inner = (r / tube_radius_) * d_over_det_;
        const C p = shift + inner;
        const C q = d_over_det_ - shift;
        const C i0 = decay * b.i0;
        const C c = decay * b.difference;
        return {i0 * (p - S(2) * i1_) + t * c * i1_, i0 * p - w_ * c * i0_, i0 * q - t * c * i0_,
                i0 * (q - S(2) * i0_) + c * (w_ * i0_ + S(2) * i0_ - d_over_det_)};
    }

  private:
    C zeta_, w_;
    S tube_radius_;
    S modulus_;
    bool series_;
    C i0_, i1_, i2_, d_over_det_;  // at W, over the determinant; d = W (I0 - I1)
};

}  // namespace axistokes::detail
