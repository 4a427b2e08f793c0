// SPDX-License-Identifier: MIT
// The Green function of Stokes flow inside an infinite tube: free space plus the wall's correction, which vanishes on
// the wall together with it (a policy for the Green kernel).
//
// The correction (tube_modes.hpp, eq. 1) is separable in target and source at each wave number. Points are sorted into
// slabs along the axis. Pairs of the same or adjacent slabs take real wave numbers: a product of matrices of rank 4 n.
// Pairs further apart turn the path of integration to arg zeta = pi/4, where the integrand decays like exp(-zeta |zh|)
// and a few dozen nodes serve all of them (docs/tube_kernel.md).
#pragma once

#include "../geometry/meridian.hpp"
#include "../quadrature/fourier_panels.hpp"
#include "../quadrature/regular_quadrature.hpp"
#include "free_space.hpp"
#include "tube_modes.hpp"

#include <Eigen/SparseCore>

#include <complex>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

namespace axistokes {

namespace detail {

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
        for (const FourierNode<S>& node : fourier_nodes<S>(f, eps)) {
            evaluators_.emplace_back(node.zeta, direction(), tube_radius);
            coupling_.push_back(weighted(node, direction() * (node.zeta * tube_radius)));
        }
    }

    std::size_t size() const { return evaluators_.size(); }
    const C& zeta(std::size_t k) const { return evaluators_[k].zeta(); }
    const S& modulus(std::size_t k) const { return evaluators_[k].modulus(); }

    TubeModes<C> target(std::size_t k, const S& r, const S& gap) const { return evaluators_[k](r, gap, table()); }

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

    static const ScaledITable<C>& table() {
        static const ScaledITable<C> shared(direction());
        return shared;
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
};

template <class S, class Kernel>
class TubeAssembly;

}  // namespace detail

/// Tube of radius Rc around the axis, no slip on its wall. Velocities decay like exp(-4.466 |z|/Rc) away from a force;
/// there is no net flux, and the pressure tends to two constants.
template <class S = double>
class TubeKernel : public FreeSpaceKernel<S> {
  public:
    using Scalar = S;
    static constexpr bool has_regular_part = true;

    struct Params {
        /// Error of the correction, relative to the velocity of the free-space kernel, in [8 eps, 0.1].
        S tolerance = default_tolerance();

        static S default_tolerance() {
            const S wanted = S(1e-8);
            const S reachable = 64 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument unless the tube radius (in R0) is positive and finite and the tolerance in range.
    explicit TubeKernel(S tube_radius, Params params = {}) : tube_radius_(tube_radius), params_(params) {
        using std::isfinite;
        detail::require(tube_radius > S(0) && isfinite(tube_radius), "tube radius", tube_radius, "> 0 and finite");
        const S least = 8 * std::numeric_limits<S>::epsilon();
        detail::require(params.tolerance >= least && params.tolerance <= S(0.1), "tube kernel tolerance",
                        params.tolerance, "in [8 eps, 0.1]");
    }

    const S& tube_radius() const { return tube_radius_; }
    const Params& params() const { return params_; }

    /// The wall's correction M_c(target, source), for probing: the batch below is much faster per pair.
    /// Throws InvalidArgument for a point with r < 0, r > Rc, or when both are on the wall.
    KernelBlock<S> correction(const Point<S>& target, const Point<S>& source) const {
        using std::abs;
        using std::exp;
        using Ray = detail::RayScalar<S>;
        using C = typename Ray::type;
        const S target_gap = gap(target.r, "target radius");
        const S source_gap = gap(source.r, "source radius");
        require_clear(target_gap + source_gap);
        const S zh = source.z - target.z;
        const auto far = static_cast<double>(abs(zh));
        const detail::TubeSpectrum<C> spectrum(tube_radius_, far, far, static_cast<double>(target_gap + source_gap),
                                               static_cast<double>(params_.tolerance));
        KernelBlock<S> m;
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            const detail::TubeModes<C> u = spectrum.target(k, target.r, target_gap);
            const detail::TubeModes<C> s = spectrum.source(k, source.r, source_gap);
            add_phase(m, spectrum.zeta(k), abs(zh), u, s);
        }
        const S sign = zh < S(0) ? S(-1) : S(1);
        return {-source.r * m.rr, sign * source.r * m.rz, -sign * source.r * m.zr, -source.r * m.zz};
    }

    /// Free space plus correction: M_T(target, source).
    KernelBlock<S> total(const Point<S>& target, const Point<S>& source) const {
        return this->singular(target, source) + correction(target, source);
    }

    /// out += M_c integrated over the sources, 2 targets x 2 nodes, stacked [r; z]. `quadrature(distance)` is a
    /// RegularQuadrature whose integrands are analytic within `distance` and within their distance to the nearest
    /// image. Throws InvalidArgument for a point outside the tube or a target and a source both on the wall.
    template <class Quadrature>
    void regular(const Meridian<S>& targets, const Quadrature& quadrature, Matrix<S>& out) const {
        Assembly(*this, targets).add_to(out, quadrature);
    }

    /// What nodal force densities (stacked, kappa/R0^3) on `surface` add to the pressure drop along the tube: by the
    /// reciprocal theorem with Poiseuille flow of unit flux, -Int f_z 2 (1 - r^2/Rc^2)/(pi Rc^2) dA.
    template <class Surface>
    S pressure_drop(const Surface& surface, const Vector<S>& force) const {
        const S area = detail::pi_value<S>() * tube_radius_ * tube_radius_;
        S sum = 0;
        for (Index i = 0; i < surface.size(); ++i) {
            const S x = surface.nodes.r[i] / tube_radius_;
            sum += surface.weight[i] * force[surface.size() + i] * (S(1) - x * x);
        }
        return -2 * sum / area;
    }

  protected:
    S gap(const S& r, const char* what) const {
        detail::require(r >= S(0) && r <= tube_radius_, what, r, "in [0, tube radius]");
        return tube_radius_ - r;
    }
    static void require_clear(const S& gap) {
        detail::require(gap > S(0), "sum of the distances of target and source to the wall", gap, "> 0");
    }

  private:
    using Assembly = detail::TubeAssembly<S, TubeKernel>;
    friend Assembly;

    /// Adds Re or Im of u s exp(i zeta |zh|).
    template <class C>
    static void add_phase(KernelBlock<S>& m, const C& zeta, const S& distance, const detail::TubeModes<C>& u,
                          const detail::TubeModes<C>& s) {
        using std::cos;
        using std::exp;
        using std::sin;
        const C rr = u.rp * s.rp + u.rq * s.rq;
        const C rz = u.rp * s.zp + u.rq * s.zq;
        const C zr = u.zp * s.rp + u.zq * s.rq;
        const C zz = u.zp * s.zp + u.zq * s.zq;
        if constexpr (std::is_same_v<C, S>) {
            const S c = cos(zeta * distance);
            const S d = sin(zeta * distance);
            m = {m.rr + c * rr, m.rz + d * rz, m.zr + d * zr, m.zz + c * zz};
        } else {
            const C phase = exp(C(0, 1) * zeta * distance);
            m = {m.rr + (phase * rr).real(), m.rz + (phase * rz).imag(), m.zr + (phase * zr).imag(),
                 m.zz + (phase * zz).real()};
        }
    }

    S tube_radius_;
    Params params_;
};

}  // namespace axistokes

#include "tube_assembly.hpp"
