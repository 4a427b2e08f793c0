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
// Pressure and stress of the two modes (viscosity 1), u_z = f_z cos(zeta z), u_r = f_r sin(zeta z): only
// t I1 cos(zeta z), t I2 sin(zeta z) carries a pressure, 2 zeta I0 sin(zeta z). With beta that flow's share in a mode,
//
//   r sigma_rr = [2 zeta r (f_z - beta I0) - 2 f_r] sin(zeta z)     r sigma_zz = -2 zeta r (f_z + beta I0) sin(zeta z)
//   r sigma_rz = 2 zeta r (f_r + beta I1) cos(zeta z)                                                              (3)
//
// zeta may be complex: for zh of one sign the path of (1) can be turned into the quadrant where exp(i zeta |zh|)
// decays.
#pragma once

#include "../special/bessel.hpp"
#include "../special/bessel_table.hpp"

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

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

/// The stress (3) of a mode, times r, without the phase.
template <class C>
struct TubeStress {
    C rr{}, rz{}, zz{};
};
template <class C>
struct TubeStresses {
    TubeStress<C> p, q;
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

/// exp(-modulus direction length), direction 1 or exp(i pi/4); exp(i modulus direction length) is its conjugate there.
template <class C>
C ray_decay(const real_of<C>& modulus, const real_of<C>& length) {
    using std::cos;
    using std::exp;
    using std::sin;
    using std::sqrt;
    using S = real_of<C>;
    if constexpr (std::is_same_v<C, S>) {
        return exp(-modulus * length);
    } else {
        static const S root = sqrt(S(0.5));
        const S x = root * modulus * length;
        const S scale = exp(-x);
        return {scale * cos(x), -scale * sin(x)};
    }
}

/// Coefficients of I0, I1/(x/2), I2/(x^2/8) in powers of q = x^2/4, enough for |q| <= 1.
template <class S>
struct SmallArgumentSeries {
    SmallArgumentSeries() {
        S zero = 1;
        for (int k = 0; k < 2 || zero > std::numeric_limits<S>::epsilon() / 16; ++k) {
            if (k > 0) {
                zero /= S(k) * S(k);
            }
            i0.push_back(zero);
            first.push_back(zero / S(k + 1));
            second.push_back(2 * zero / (S(k + 1) * S(k + 2)));
        }
    }
    std::vector<S> i0, first, second;
};

/// At W, over the determinant: I0, I1, W I0, W I1, W I2, d = W (I0 - I1), (W + 2) I0 - d.
template <class C>
struct WallFactors {
    C i0{}, i1{}, wi0{}, wi1{}, wi2{}, d{}, outer{};
};

/// Evaluates both modes at one wave number for any radius. Scaled Bessel functions throughout; the remaining
/// exponential exp(-zeta (Rc - r)) comes from the distance to the wall, which the caller forms from the coordinates.
template <class C>
class TubeModeEvaluator {
  public:
    using S = real_of<C>;

    /// zeta = modulus * direction.
    TubeModeEvaluator(const S& modulus, const C& direction, const S& tube_radius)
        : modulus_(modulus), zeta_(modulus * direction), w_(zeta_ * tube_radius), tube_radius_(tube_radius) {
        using std::exp;
        series_ = modulus * tube_radius <= S(2);
        const ScaledI<C> i = scaled_bessel_i<C>(w_);
        const C d = w_ * i.difference;
        // Determinant of the two modes regular at 0, W (I0 I2 - I1^2), in the form that does not cancel.
        const C determinant = series_ ? C(w_ * (i.i0 * i.i2 - i.i1 * i.i1)) : C((i.i0 + i.i1) * d - S(2) * i.i0 * i.i1);
        // The series give unscaled functions of zeta r.
        const C scale = series_ ? C(exp(-w_) / determinant) : C(S(1) / determinant);
        wall_.i0 = scale * i.i0;
        wall_.i1 = scale * i.i1;
        wall_.wi2 = scale * w_ * i.i2;
        wall_.d = scale * d;
        wall_.wi1 = w_ * wall_.i1;
        wall_.wi0 = w_ * wall_.i0;
        wall_.outer = wall_.wi0 + S(2) * wall_.i0 - wall_.d;
    }

    const C& zeta() const { return zeta_; }
    const S& modulus() const { return modulus_; }
    const WallFactors<C>& wall() const { return wall_; }

    /// At radius r, `gap` from the wall; `table` gives the scaled Bessel functions along the ray of zeta.
    TubeModes<C> operator()(const S& r, const S& gap, const ScaledITable<C>& table) const {
        const WallFactors<C>& w = wall_;
        const C t = zeta_ * r;
        if (series_) {
            const SmallBessel b(t);
            return {w.wi2 * b.i0 - w.i1 * b.ti1, w.wi2 * b.i1 - w.i1 * b.ti2, w.i0 * b.ti1 - w.wi1 * b.i0,
                    w.i0 * b.ti2 - w.wi1 * b.i1};
        }
        // W - t = zeta gap taken out of the differences of products: no cancellation of large W against large t.
        const ScaledIPair<C> b = table(modulus_ * r);
        const C decay = ray_decay<C>(modulus_, gap);
        const C shift = zeta_ * gap * w.i0;
        const C p = shift + (r / tube_radius_) * w.d;
        const C q = w.d - shift;
        const C i0 = decay * b.i0;
        const C c = decay * b.difference;
        const C tc = t * c;
        return {i0 * (p - S(2) * w.i1) + tc * w.i1, i0 * p - c * w.wi0, i0 * q - tc * w.i0,
                i0 * (q - S(2) * w.i0) + c * w.outer};
    }

    /// The stresses (3) there.
    TubeStresses<C> stress(const S& r, const S& gap, const ScaledITable<C>& table) const {
        const TubeModes<C> u = (*this)(r, gap, table);
        const C t = zeta_ * r;
        C i0;
        C i1;
        if (series_) {
            const SmallBessel b(t);
            i0 = b.i0;
            i1 = b.i1;
        } else {
            const ScaledIPair<C> b = table(modulus_ * r);
            const C decay = ray_decay<C>(modulus_, gap);
            i0 = decay * b.i0;
            i1 = i0 - decay * b.difference;
        }
        // beta is -I1(W) over the determinant for P, I0(W) over it for Q.
        const auto mode = [&](const C& fz, const C& fr, const C& beta) {
            const C pressure = beta * i0;
            return TubeStress<C>{S(2) * (t * (fz - pressure) - fr), S(2) * t * (fr + beta * i1),
                                 S(-2) * t * (fz + pressure)};
        };
        return {mode(u.zp, u.rp, -wall_.i1), mode(u.zq, u.rq, wall_.i0)};
    }

  private:
    /// I0, I1, t I1 and t I2 by their power series, for |t| <= 2.
    struct SmallBessel {
        explicit SmallBessel(const C& t) {
            static const SmallArgumentSeries<S> series;
            const C q = t * t / S(4);
            std::size_t k = series.i0.size() - 1;
            i0 = C(series.i0[k]);
            C first = C(series.first[k]);
            C second = C(series.second[k]);
            while (k-- > 0) {
                i0 = i0 * q + series.i0[k];
                first = first * q + series.first[k];
                second = second * q + series.second[k];
            }
            i1 = t / S(2) * first;
            ti1 = S(2) * q * first;
            ti2 = q / S(2) * t * second;
        }
        C i0, i1, ti1, ti2;
    };

    S modulus_;
    C zeta_, w_;
    S tube_radius_;
    bool series_;
    WallFactors<C> wall_;
};

}  // namespace axistokes::detail
