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
#include "../quadrature/regular_quadrature.hpp"
#include "free_space.hpp"
#include "tube_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace axistokes {

namespace detail {

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

    /// The same with the error `tolerance`, or the present one if that is larger.
    TubeKernel loosened(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return TubeKernel(tube_radius_, params);
    }

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
