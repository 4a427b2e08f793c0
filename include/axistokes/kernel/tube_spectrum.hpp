// SPDX-License-Identifier: MIT
// The wave numbers that a batch of points in a tube takes, with the modes and the coupling at each.
#pragma once

#include "../quadrature/fourier_panels.hpp"
#include "tube_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// The complex type of a ray off the real axis; types without one stay on the axis.
template <class S>
struct RayScalar {
    using type = S;
    static constexpr bool turned = false;
};
template <class S>
requires std::is_floating_point_v<S>
struct RayScalar<S> {
    using type = std::complex<S>;
    static constexpr bool turned = true;
};

/// Wave numbers on a ray, their modes and their coupling times quadrature weight.
template <class C>
class TubeSpectrum {
  public:
    using S = real_of<C>;
    static constexpr bool turned = !std::is_same_v<C, S>;

    /// `closest`, `furthest`: bounds of |z - z0|; `gap`: least sum of the two points' distances to the wall.
    TubeSpectrum(const S& tube_radius, double closest, double furthest, double gap, double eps)
        : tube_radius_(tube_radius) {
        const auto radius = static_cast<double>(tube_radius);
        // (1 + y/2)^2 e^(-y) / y is what the modes of a pair with zeta gap = y can amount to; the tail, the first panel
        // and the others share the tolerance.
        eps /= 4;
        double y = std::log(1 / eps);
        for (int i = 0; i < 20; ++i) {
            y = std::log(1 / eps) + 2 * std::log(1 + y / 2) - std::log(y);
        }
        // Zeros of the determinant, the tube's eigenvalues: the first at zeta Rc = +-1.467 + 4.466 i, the others
        // beyond, between the directions of that one and of the imaginary axis.
        FourierIntegrand f{furthest, false, 4.46 / radius, 0.95, y / gap};
        if constexpr (turned) {
            const double slope = std::sqrt(0.5);
            f = {furthest, true, 2.1 / radius, 0.45, y / (slope * (gap + closest))};
        }
        f.range = std::max(f.range, 0.1 * gap);
        reach_ = y;
        FourierNodes<S> quadrature = fourier_nodes<S>(f, eps);
        panels_ = std::move(quadrature.panels);
        for (const FourierNode<S>& node : quadrature.nodes) {
            evaluators_.emplace_back(node.zeta, direction(), tube_radius);
            coupling_.push_back(weighted(node, direction() * (node.zeta * tube_radius)));
        }
    }

    std::size_t size() const { return evaluators_.size(); }
    const C& zeta(std::size_t k) const { return evaluators_[k].zeta(); }
    const S& modulus(std::size_t k) const { return evaluators_[k].modulus(); }

    const S& tube_radius() const { return tube_radius_; }
    const std::vector<FourierPanel<S>>& panels() const { return panels_; }
    const WallFactors<C>& wall(std::size_t k) const { return evaluators_[k].wall(); }
    /// S_kl with the quadrature weight.
    const TubeCoupling<C>& coupling(std::size_t k) const { return coupling_[k]; }
    /// Scaled Bessel functions along the ray of all wave numbers.
    static const ScaledITable<C>& bessel() {
        static const ScaledITable<C> shared(direction());
        return shared;
    }

    TubeModes<C> target(std::size_t k, const S& r, const S& gap) const { return evaluators_[k](r, gap, bessel()); }

    /// The modes' stresses, times r.
    TubeStresses<C> stress(std::size_t k, const S& r, const S& gap) const {
        return evaluators_[k].stress(r, gap, bessel());
    }

    /// sum_l S_kl u^l, with the quadrature weight.
    TubeModes<C> source(std::size_t k, const S& r, const S& gap) const {
        const TubeModes<C> u = target(k, r, gap);
        const TubeCoupling<C>& s = coupling_[k];
        return {s.pp * u.zp + s.pq * u.zq, s.pp * u.rp + s.pq * u.rq, s.pq * u.zp + s.qq * u.zq,
                s.pq * u.rp + s.qq * u.rq};
    }

    /// Number of wave numbers that matter for a pair whose distances to the wall sum to `gap`.
    std::size_t relevant(const S& gap) const {
        std::size_t n = size();
        if constexpr (!turned) {
            while (n > 1 && evaluators_[n - 1].zeta() * gap > S(reach_)) {
                --n;
            }
        }
        return n;
    }

  private:
    static C direction() {
        using std::sqrt;
        if constexpr (turned) {
            return C(sqrt(S(0.5)), sqrt(S(0.5)));
        } else {
            return S(1);
        }
    }

    /// On the first panel S = smooth + log(W) logarithm, log(W) = log(zeta modulus) + log(direction Rc).
    TubeCoupling<C> weighted(const FourierNode<S>& node, const C& w) const {
        using std::log;
        const C turn = direction();  // dzeta
        if (!node.first_panel) {
            const TubeCoupling<C> s = tube_coupling<C>(w);
            const C f = turn * node.weight;
            return {f * s.pp, f * s.pq, f * s.qq};
        }
        const TubeCouplingSplit<C> s(w);
        const C f = turn * node.weight;
        const C g = turn * (node.log_weight + node.weight * log(turn * tube_radius_));
        return {f * s.smooth.pp + g * s.logarithm.pp, f * s.smooth.pq + g * s.logarithm.pq,
                f * s.smooth.qq + g * s.logarithm.qq};
    }

    S tube_radius_;
    double reach_ = 0;
    std::vector<TubeModeEvaluator<C>> evaluators_;
    std::vector<TubeCoupling<C>> coupling_;
    std::vector<FourierPanel<S>> panels_;
};

}  // namespace axistokes::detail
