// SPDX-License-Identifier: MIT
// Velocity of a ring of point forces in unbounded Stokes flow, integrated over the azimuth: M_ab(x0, x), first index
// target velocity, second source force.
//
// With h, c of special/ring_integrals.hpp, zh = z - z0, d the distance of the two points in the meridian half-plane and
// D^2 = (r + r0)^2 + zh^2 (docs/free_space_kernel.md, eqs. 7-10):
//
//   M_rr = 16 r^2 r0 / D^3 [ h - (zh^2/d^2) c ]
//   M_rz =  8 r r0 zh / D^3 [ ((r - r0)(r + r0) - zh^2)/d^2 c - h ]
//   M_zr =  8 r^2  zh / D^3 [ ((r - r0)(r + r0) + zh^2)/d^2 c + h ]
//   M_zz =  4 r / D [ K + (zh^2/d^2) E ],   K = (1 + m1) h + 2 c,   E = (1 + m1) c + 2 m1 h
//
// No entry subtracts nearly equal numbers except at its own zeros, so the usual losses near the source (eps/d^2) and
// near the axis (eps/r0) do not occur.
#pragma once

#include "../core.hpp"
#include "../special/elliptic.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axistokes {

namespace detail {

/// Sources are treated in blocks that stay in the first-level cache; each stage is a loop the compiler vectorises.
template <class S>
struct RingBlock {
    static constexpr Index capacity = 64;
    using Array = std::array<S, static_cast<std::size_t>(capacity)>;

    Array r;             // source radius, scaled
    Array r0;            // target radius, scaled
    Array zh;            // z - z0, scaled
    Array r2_minus_r02;  // (r - r0)(r + r0), scaled
    Array inv_d2;        // 1/d^2
    Array inv_big_d2;    // 1/D^2
    Array inv_big_d;     // 1/D
    Array m1;
};

/// What the entries are linear in: h, c and c/d^2, or the parts of these that make up the smooth or the log factor.
template <class S>
struct RingChannel {
    typename RingBlock<S>::Array h;
    typename RingBlock<S>::Array c;
    typename RingBlock<S>::Array c_over_d2;
};

/// Lengths are divided by r + r0 + |zh|: M is homogeneous of degree 0, and squares neither overflow nor underflow.
template <class S>
void fill_block(const Point<S>& target, const S* r, const S* z, std::size_t n, RingBlock<S>& block) {
    using std::abs;
    using std::sqrt;
    for (std::size_t i = 0; i < n; ++i) {
        const S difference = z[i] - target.z;
        const S sum = r[i] + target.r;
        const S scale = S(1) / (sum + abs(difference));
        const S zh = difference * scale;
        const S dr = (r[i] - target.r) * scale;
        const S rs = sum * scale;
        const S zh2 = zh * zh;
        const S d2 = dr * dr + zh2;
        const S big_d2 = rs * rs + zh2;
        block.r[i] = r[i] * scale;
        block.r0[i] = target.r * scale;
        block.zh[i] = zh;
        block.r2_minus_r02[i] = dr * rs;
        block.m1[i] = d2 / big_d2;
        block.inv_d2[i] = S(1) / d2;
        block.inv_big_d2[i] = S(1) / big_d2;
    }
    // Kept apart: sqrt may set errno, which stops compilers from vectorising the loop it is in.
    for (std::size_t i = 0; i < n; ++i) {
        block.inv_big_d[i] = sqrt(block.inv_big_d2[i]);
    }
}

template <class S>
void fill_channel(const RingBlock<S>& block, std::size_t n, RingChannel<S>& channel) {
    for (std::size_t i = 0; i < n; ++i) {
        const S m1 = block.m1[i];
        RingIntegrals<S> ring;
        if constexpr (RingFit<S>::available) {
            ring = ring_from_split(ring_split_fit(m1), m1, fast_log(m1));
        } else {
            ring = ring_integrals_agm<S>(m1);
        }
        channel.h[i] = ring.h;
        channel.c[i] = ring.c;
        channel.c_over_d2[i] = ring.c * block.inv_d2[i];
    }
}

/// `logarithm` receives the factor of log(m1): there c is -m1 qc, so c/d^2 is -qc/D^2, without division by d.
template <class S>
void fill_split_channels(const RingBlock<S>& block, std::size_t n, RingChannel<S>& smooth, RingChannel<S>& logarithm) {
    for (std::size_t i = 0; i < n; ++i) {
        const S m1 = block.m1[i];
        const RingSplit<S> split = ring_split<S>(m1);
        smooth.h[i] = split.ph;
        smooth.c[i] = split.pc;
        smooth.c_over_d2[i] = split.pc * block.inv_d2[i];
        logarithm.h[i] = -split.qh;
        logarithm.c[i] = -m1 * split.qc;
        logarithm.c_over_d2[i] = -split.qc * block.inv_big_d2[i];
    }
}

/// The entries of a block of n sources, stored from element `begin` of `out` on.
template <class S>
void store_entries(const RingBlock<S>& block, const RingChannel<S>& channel, Index begin, std::size_t n,
                   const KernelArrays<S>& out) {
    S* __restrict rr = out.rr + begin;
    S* __restrict rz = out.rz + begin;
    S* __restrict zr = out.zr + begin;
    S* __restrict zz = out.zz + begin;
    for (std::size_t i = 0; i < n; ++i) {
        const S r = block.r[i];
        const S r0 = block.r0[i];
        const S zh = block.zh[i];
        const S h = channel.h[i];
        const S c_over_d2 = channel.c_over_d2[i];
        const S difference = block.r2_minus_r02[i];
        const S zh2 = zh * zh;
        const S one_plus_m1 = S(1) + block.m1[i];
        const S over_d = 4 * (r * block.inv_big_d[i]);
        const S over_d3 = 2 * (over_d * block.inv_big_d2[i]);
        const S k = one_plus_m1 * h + 2 * channel.c[i];
        const S e_over_d2 = one_plus_m1 * c_over_d2 + 2 * (h * block.inv_big_d2[i]);
        rr[i] = 2 * (over_d3 * (r * r0)) * (h - zh2 * c_over_d2);
        rz[i] = over_d3 * (r0 * zh) * (c_over_d2 * (difference - zh2) - h);
        zr[i] = over_d3 * (r * zh) * (c_over_d2 * (difference + zh2) + h);
        zz[i] = over_d * (k + zh2 * e_over_d2);
    }
}

}  // namespace detail

/// Free-space kernel (a policy for the Green function): u_a(x0) = 1/(8 pi mu) sum_b Int M_ab(x0, x) f_b(x) dl(x) for an
/// axisymmetric force density f per unit area. M contains the ring's Jacobian r but not 1/(8 pi), and is
/// dimensionless: scaling all lengths leaves it unchanged. Source: Pozrikidis, Boundary Integral and Singularity
/// Methods (1992), section 2.4, regrouped as derived in docs/free_space_kernel.md.
///
/// Preconditions, not checked: r >= 0, all coordinates finite, and target != source (M is infinite there; the entries
/// returned are infinite or NaN). In double, points closer than 1e-154 of their distance to the axis count as equal.
/// A target with r < 0 or NaN throws InvalidArgument. A source on the axis gives exactly 0 in all entries.
template <class S = double>
class FreeSpaceKernel {
  public:
    using Scalar = S;
    static constexpr bool has_images = false;
    static constexpr bool laboratory_frame = false;

    /// M(target, (r[i], z[i])) for i < n. The four output arrays must not overlap one another or the input.
    void singular(Point<S> target, const S* r, const S* z, Index n, KernelArrays<S> out) const {
        for_each_block(target, r, z, n, [&](const detail::RingBlock<S>& block, Index begin, std::size_t count) {
            detail::RingChannel<S> channel;
            detail::fill_channel(block, count, channel);
            detail::store_entries(block, channel, begin, count, out);
        });
    }

    /// M(target, source).
    KernelBlock<S> singular(Point<S> target, Point<S> source) const {
        KernelBlock<S> m;
        singular(target, &source.r, &source.z, 1, {&m.rr, &m.rz, &m.zr, &m.zz});
        return m;
    }

    /// M = smooth + log_coefficient * log(m1), m1 = ((r-r0)^2 + (z-z0)^2)/((r+r0)^2 + (z-z0)^2), for i < n.
    ///
    /// log_coefficient is analytic in the source position wherever r + r0 > 0. smooth is analytic along any analytic
    /// curve through the target; across curves it depends on the direction, through bounded terms such as
    /// (z-z0)^2/d^2. (Types other than float and double: smooth keeps a remainder m1^(N+1) log(m1), N a fifth of the
    /// type's binary digits.) log_coefficient is 0 for a target on the axis, where M has no logarithm.
    void singular_split(Point<S> target, const S* r, const S* z, Index n, KernelArrays<S> smooth,
                        KernelArrays<S> log_coefficient) const {
        if (target.r == S(0)) {
            singular(target, r, z, n, smooth);
            for (S* entry : {log_coefficient.rr, log_coefficient.rz, log_coefficient.zr, log_coefficient.zz}) {
                std::fill_n(entry, n, S(0));
            }
            return;
        }
        for_each_block(target, r, z, n, [&](const detail::RingBlock<S>& block, Index begin, std::size_t count) {
            detail::RingChannel<S> regular;
            detail::RingChannel<S> logarithm;
            detail::fill_split_channels(block, count, regular, logarithm);
            detail::store_entries(block, regular, begin, count, smooth);
            detail::store_entries(block, logarithm, begin, count, log_coefficient);
        });
    }

  private:
    template <class Use>
    static void for_each_block(const Point<S>& target, const S* r, const S* z, Index n, Use use) {
        detail::require(target.r >= S(0), "target radius", target.r, ">= 0");
        detail::RingBlock<S> block;
        for (Index begin = 0; begin < n; begin += detail::RingBlock<S>::capacity) {
            const auto count = static_cast<std::size_t>(std::min(n - begin, detail::RingBlock<S>::capacity));
            detail::fill_block(target, r + begin, z + begin, count, block);
            use(block, begin, count);
        }
    }
};

}  // namespace axistokes
