// SPDX-License-Identifier: MIT
// The Green function of Stokes flow inside an infinite tube: free space plus the images of the wall, whose sum vanishes
// on the wall (a policy for the Green kernel).
//
// The correction (tube_modes.hpp, eq. 1) is separable in target and source at each wave number. Points are sorted into
// slabs along the axis. Pairs of the same or adjacent slabs take real wave numbers: a product of matrices of rank 4 n.
// Pairs further apart turn the path of integration to arg zeta = pi/4, where the integrand decays like exp(-zeta |zh|)
// and a few dozen nodes serve all of them (docs/tube_kernel.md).
#pragma once

#include "imaged.hpp"
#include "tube_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace axistokes {

namespace detail {

template <class S>
class TubeAssembly;

/// What all images of a tube share: its radius, the accuracy asked for, the undisturbed flow.
template <class S>
class TubeWall {
  public:
    using Scalar = S;

    struct Params {
        /// Error of the correction, relative to the velocity of the free-space kernel, in [8 eps, 0.1].
        S tolerance = default_tolerance();

        static S default_tolerance() {
            const S wanted = S(1e-8);
            const S reachable = 64 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument unless the radius (in R0) is positive and finite and the tolerance in range.
    TubeWall(S radius, Params params) : radius_(radius), params_(params) {
        require_length("tube radius", radius);
        const S least = 8 * std::numeric_limits<S>::epsilon();
        require(params.tolerance >= least && params.tolerance <= S(0.1), "tube kernel tolerance", params.tolerance,
                "in [8 eps, 0.1]");
    }

    const S& radius() const { return radius_; }
    const Params& params() const { return params_; }

    S gap(const Point<S>& x) const { return radius_ - x.r; }

    /// Poiseuille flow of flow rate 1.
    Point<S> unit_flow(const Point<S>& x) const {
        const S ratio = x.r / radius_;
        return {S(0), 2 * (S(1) - ratio * ratio) / (pi_value<S>() * radius_ * radius_)};
    }

    /// The distance to the wall of a point that must be inside. Throws InvalidArgument if it is not.
    S gap_inside(const S& r, const char* what) const {
        require(r >= S(0) && r <= radius_, what, r, "in [0, tube radius]");
        return radius_ - r;
    }
    /// Throws InvalidArgument when target and source are both on the wall.
    static void require_clear(const S& gap) {
        require(gap > S(0), "sum of the distances of target and source to the wall", gap, "> 0");
    }

  protected:
    /// The parameters with the error `tolerance`, or the present one if that is larger.
    Params loosened_params(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return params;
    }

  private:
    S radius_;
    Params params_;
};

}  // namespace detail

/// The images of a tube of radius Rc around the axis, by modes: fast for many pairs.
template <class S = double>
class TubeImages : public detail::TubeWall<S> {
  public:
    using typename detail::TubeWall<S>::Params;

    /// Throws InvalidArgument unless the radius (in R0) is positive and finite and the tolerance in range.
    explicit TubeImages(S radius, Params params = {}) : detail::TubeWall<S>(radius, params) {}

    TubeImages loosened(const S& tolerance) const {
        return TubeImages(this->radius(), this->loosened_params(tolerance));
    }

    /// The wall's correction M_c(target, source), for probing: the batch below is much faster per pair.
    /// Throws InvalidArgument for a point with r < 0, r > Rc, or when both are on the wall.
    KernelBlock<S> correction(const Point<S>& target, const Point<S>& source) const {
        using std::abs;
        using std::exp;
        using Ray = detail::RayScalar<S>;
        using C = typename Ray::type;
        const S target_gap = this->gap_inside(target.r, "target radius");
        const S source_gap = this->gap_inside(source.r, "source radius");
        this->require_clear(target_gap + source_gap);
        const S zh = source.z - target.z;
        const auto far = static_cast<double>(abs(zh));
        const detail::TubeSpectrum<C> spectrum(this->radius(), far, far, static_cast<double>(target_gap + source_gap),
                                               static_cast<double>(this->params().tolerance));
        KernelBlock<S> m;
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            const detail::TubeModes<C> u = spectrum.target(k, target.r, target_gap);
            const detail::TubeModes<C> s = spectrum.source(k, source.r, source_gap);
            add_phase(m, spectrum.zeta(k), abs(zh), u, s);
        }
        const S sign = zh < S(0) ? S(-1) : S(1);
        return {-source.r * m.rr, sign * source.r * m.rz, -sign * source.r * m.zr, -source.r * m.zz};
    }

    /// The wall's part of the double layer's kernel for a ring at `source` with the unit normal `normal`; added to
    /// FreeSpaceKernel::stress it makes 0 for a target on the wall. Minus the stress, at the source, of the flow of a
    /// force at the target, which the modes give (tube_modes.hpp, eq. 3). For probing, like `correction`, and throws
    /// as it does; the tolerance is relative to the free-space kernel.
    KernelBlock<S> stress_correction(const Point<S>& target, const Point<S>& source, const Point<S>& normal) const {
        using std::abs;
        using Ray = detail::RayScalar<S>;
        using C = typename Ray::type;
        const S target_gap = this->gap_inside(target.r, "target radius");
        const S source_gap = this->gap_inside(source.r, "source radius");
        this->require_clear(target_gap + source_gap);
        const S zh = source.z - target.z;
        const auto far = static_cast<double>(abs(zh));
        // Twice zeta times the velocity's integrand, so that the tail, where zeta is some 30/gap, weighs more.
        const auto eps = static_cast<double>(this->params().tolerance) / 64;
        const detail::TubeSpectrum<C> spectrum(this->radius(), far, far, static_cast<double>(target_gap + source_gap),
                                               eps);
        KernelBlock<S> radial;  // of n_r; the second one of n_z, in the order rz, rr, zz, zr
        KernelBlock<S> axial;
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            // The coupling is symmetric and may as well be taken with the target.
            const detail::TubeModes<C> u = spectrum.source(k, target.r, target_gap);
            const detail::TubeStresses<C> s = spectrum.stress(k, source.r, source_gap);
            add_phase(radial, spectrum.zeta(k), abs(zh), u, {s.p.rz, s.p.rr, s.q.rz, s.q.rr});
            add_phase(axial, spectrum.zeta(k), abs(zh), u, {s.p.rz, s.p.zz, s.q.rz, s.q.zz});
        }
        const S sign = zh < S(0) ? S(-1) : S(1);
        if constexpr (Ray::turned) {
            // Far away the pressure is +-16 pi (1 - r0^2/Rc^2)/Rc^2, an integral of sin(zeta zh)/zeta. The path turned
            // away from this pole leaves out an eighth of a circle about it: half of that pressure.
            const S inverse = S(1) / this->radius();
            const S share = target_gap * inverse * (S(1) + target.r * inverse);  // 1 - r0^2/Rc^2
            const S pressure = 8 * detail::pi_value<S>() * share * (inverse * inverse);
            radial.zr += source.r * pressure;
            axial.zr += source.r * pressure;
        }
        return {normal.r * radial.rr - sign * normal.z * axial.rz, normal.z * axial.rr - sign * normal.r * radial.rz,
                normal.z * axial.zz + sign * normal.r * radial.zr, normal.r * radial.zz + sign * normal.z * axial.zr};
    }

    /// As ImagedKernel::regular. Throws InvalidArgument for a point outside the tube or a target and a source both on
    /// the wall.
    template <class Quadrature>
    void regular(const Meridian<S>& targets, const Quadrature& quadrature, Matrix<S>& out) const {
        detail::TubeAssembly<S>(*this, targets).add_to(out, quadrature);
    }

  private:
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
};

/// Tube of radius Rc around the axis, no slip on its wall. Velocities decay like exp(-4.466 |z|/Rc) away from a force;
/// there is no net flux, and the pressure tends to two constants.
template <class S = double>
class TubeKernel : public ImagedKernel<S, TubeImages<S>> {
  public:
    using Params = typename TubeImages<S>::Params;

    /// Throws InvalidArgument as TubeImages does.
    explicit TubeKernel(S tube_radius, Params params = {}) : TubeKernel(TubeImages<S>(tube_radius, params)) {}
    explicit TubeKernel(TubeImages<S> images) : ImagedKernel<S, TubeImages<S>>(std::move(images)) {}

    const S& tube_radius() const { return this->images().radius(); }
    const Params& params() const { return this->images().params(); }

    /// The same with the error `tolerance`, or the present one if that is larger.
    TubeKernel loosened(const S& tolerance) const { return TubeKernel(this->images().loosened(tolerance)); }
};

}  // namespace axistokes

#include "tube_assembly.hpp"
