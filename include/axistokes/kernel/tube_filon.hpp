// SPDX-License-Identifier: MIT
// The tube's correction as the paper computes it (Trozzo et al. 2015, section 2.3.2), pair by pair: a reference for
// TubeKernel, which it is thousands of times slower than.
//
// The zz integrand behaves like -8 log(zeta) at 0 for all points: 8 K0(zeta Rc) is subtracted and its transform,
// 4 pi/sqrt(Rc^2 + zh^2), added (DLMF 10.43.21). The wave numbers are divided into four zones: [0, 1e-5/Rc] by
// Gauss-Legendre; two zones by Filon's rule, up to 2/Rc and up to where the integrand has decayed; the rest by
// Gauss-Laguerre. The points of Filon's rules are doubled until the result changes by less than the tolerance twice in
// a row: one small change, of an oscillating integrand on few points, may be an accident.
#pragma once

#include "../quadrature/filon.hpp"
#include "../quadrature/gauss_laguerre.hpp"
#include "tube.hpp"

#include <array>
#include <utility>
#include <vector>

namespace axistokes {

/// The images of a tube by the paper's quadrature.
template <class S = double>
class TubeFilonImages : public detail::TubeWall<S> {
  public:
    using typename detail::TubeWall<S>::Params;

    /// Throws InvalidArgument as TubeImages does, and unless most_points (of each Filon zone) is at least 64.
    explicit TubeFilonImages(S radius, Params params = {}, Index most_points = 1 << 17)
        : detail::TubeWall<S>(radius, params), most_points_(most_points) {
        detail::require(most_points >= 64, "most points of a zone", most_points, "at least 64");
    }

    TubeFilonImages loosened(const S& tolerance) const {
        return TubeFilonImages(this->radius(), this->loosened_params(tolerance), most_points_);
    }

    KernelBlock<S> correction(const Point<S>& target, const Point<S>& source) const {
        using std::abs;
        using std::cos;
        using std::exp;
        using std::log;
        using std::sin;
        using std::sqrt;
        const S target_gap = this->gap_inside(target.r, "target radius");
        const S source_gap = this->gap_inside(source.r, "source radius");
        this->require_clear(target_gap + source_gap);
        const S distance = abs(source.z - target.z);
        const auto integrand = [&](const S& zeta) {
            static const detail::ScaledITable<S> table(S(1));
            const detail::TubeModeEvaluator<S> modes(zeta, S(1), this->radius());
            const detail::TubeCoupling<S> c = detail::tube_coupling<S>(zeta * this->radius());
            const detail::TubeModes<S> u = modes(target.r, target_gap, table);
            const detail::TubeModes<S> v = modes(source.r, source_gap, table);
            const auto entry = [&](const S& up, const S& uq, const S& vp, const S& vq) {
                return S(c.pp * up * vp + c.pq * (up * vq + uq * vp) + c.qq * uq * vq);
            };
            const S w = zeta * this->radius();
            const S regularisation = 8 * exp(-w) * scaled_bessel_k<S>(w).k0;
            return Values{entry(u.rp, u.rq, v.rp, v.rq), entry(u.rp, u.rq, v.zp, v.zq), entry(u.zp, u.zq, v.rp, v.rq),
                          entry(u.zp, u.zq, v.zp, v.zq) - regularisation};
        };
        Values sum{};
        sum[3] = 4 * detail::pi_value<S>() / sqrt(this->radius() * this->radius() + distance * distance);
        const auto add = [&](const S& zeta, const S& weight) {
            const Values f = integrand(zeta);
            const S c = weight * cos(zeta * distance);
            const S d = weight * sin(zeta * distance);
            sum[0] += c * f[0];
            sum[1] += d * f[1];
            sum[2] += d * f[2];
            sum[3] += c * f[3];
        };

        const S first = S(1e-5) / this->radius();
        const S second = 2 / this->radius();
        const S decay = std::min<S>(target_gap + source_gap, this->radius());
        const S third = std::max<S>(2 * second, log(S(1) / this->params().tolerance) / decay);
        static const GaussLegendreRule<S> legendre = gauss_legendre<S>(16);
        static const GaussLaguerreRule<S> laguerre = gauss_laguerre<S>(16);
        for (Index q = 0; q < legendre.nodes.size(); ++q) {
            add(first * legendre.nodes[q], first * legendre.weights[q]);
        }
        for (const Values& zone :
             {filon_zone(integrand, first, second, distance), filon_zone(integrand, second, third, distance)}) {
            for (std::size_t i = 0; i < 4; ++i) {
                sum[i] += zone[i];
            }
        }
        for (Index q = 0; q < laguerre.nodes.size(); ++q) {
            add(third + laguerre.nodes[q] / decay, laguerre.weights[q] * exp(laguerre.nodes[q]) / decay);
        }
        const S sign = source.z < target.z ? S(-1) : S(1);
        return {-source.r * sum[0], sign * source.r * sum[1], -sign * source.r * sum[2], -source.r * sum[3]};
    }

  private:
    using Values = std::array<S, 4>;  // rr, rz, zr, zz

    /// rr and zz with the cosine, rz and zr with the sine.
    template <class Integrand>
    Values filon_zone(const Integrand& integrand, const S& a, const S& b, const S& k) const {
        using std::abs;
        std::array<std::vector<S>, 4> f;
        const auto sample = [&](Index intervals, Index from, Index step) {
            for (Index i = from; i <= intervals; i += step) {
                const Values v = integrand(a + (b - a) * S(i) / S(intervals));
                for (std::size_t e = 0; e < 4; ++e) {
                    f[e][static_cast<std::size_t>(i)] = v[e];
                }
            }
        };
        Index intervals = 16;
        for (std::vector<S>& entry : f) {
            entry.resize(static_cast<std::size_t>(intervals) + 1);
        }
        sample(intervals, 0, 1);
        Values result = integrate(f, a, b, k);
        int small_changes = 0;
        while (small_changes < 2 && 2 * intervals < most_points_) {
            intervals *= 2;
            for (std::vector<S>& entry : f) {
                std::vector<S> finer(static_cast<std::size_t>(intervals) + 1);
                for (std::size_t i = 0; i < entry.size(); ++i) {
                    finer[2 * i] = entry[i];
                }
                entry = std::move(finer);
            }
            sample(intervals, 1, 2);
            const Values better = integrate(f, a, b, k);
            S change = 0;
            for (std::size_t e = 0; e < 4; ++e) {
                change = std::max<S>(change, abs(better[e] - result[e]));
            }
            result = better;
            small_changes = change < this->params().tolerance ? small_changes + 1 : 0;
        }
        return result;
    }

    static Values integrate(const std::array<std::vector<S>, 4>& f, const S& a, const S& b, const S& k) {
        return {filon(f[0], a, b, k).cosine, filon(f[1], a, b, k).sine, filon(f[2], a, b, k).sine,
                filon(f[3], a, b, k).cosine};
    }

    Index most_points_;
};

/// As TubeKernel, with the correction by the paper's quadrature.
template <class S = double>
class TubeFilonKernel : public ImagedKernel<S, TubeFilonImages<S>> {
  public:
    using Params = typename TubeFilonImages<S>::Params;

    /// Throws InvalidArgument as TubeFilonImages does.
    explicit TubeFilonKernel(S tube_radius, Params params = {}, Index most_points = 1 << 17)
        : TubeFilonKernel(TubeFilonImages<S>(tube_radius, params, most_points)) {}
    explicit TubeFilonKernel(TubeFilonImages<S> images) : ImagedKernel<S, TubeFilonImages<S>>(std::move(images)) {}

    const S& tube_radius() const { return this->images().radius(); }
    const Params& params() const { return this->images().params(); }

    /// The same with the error `tolerance`, or the present one if that is larger.
    TubeFilonKernel loosened(const S& tolerance) const { return TubeFilonKernel(this->images().loosened(tolerance)); }
};

}  // namespace axistokes
