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
//
// The stress of the same rings, for the double layer: Q_ab(x0, x) = r Int T_abc n_c dphi, T_ijk = -6 X_i X_j X_k/|X|^5,
// X = x0 - x, n the normal at the source. With A = r0 - r cos t and B = r0 cos t - r, the r components of X at target
// and source, J_* = Int */|X|^5 dt and dr = r - r0, e = (r - r0)(r + r0), m = 4 r r0/D^2 (docs/double_layer.md):
//
//   Q_rr = -6 r      (n_r J_ABB - n_z zh J_AB)     Q_rz =  6 r zh   (n_r J_AB - n_z zh J_A)
//   Q_zr =  6 r zh   (n_r J_BB  - n_z zh J_B)      Q_zz = -6 r zh^2 (n_r J_B  - n_z zh J_1)
//
//   J_1   =  4/(3 D d^4)     { 2 (1 + m1 + m1^2) c + 3 m1 (1 + m1) h }
//   J_A   =  8 r0/(3 D^3 d^4) { (zh^2 - e) [2 (1 + m1) c + 3 m1 h] - d^2 c }
//   J_B   = -8 r /(3 D^3 d^4) { (zh^2 + e) [2 (1 + m1) c + 3 m1 h] - d^2 c }
//   J_AB  = 32 r r0/(3 D^3)  { c dr^2/d^4 - zh^2/(d^2 D^2) (c + 3 h/2) }
//   J_BB  =  4/(D d^2)       { (2 c/3) [dr^2/d^2 + (2 r dr + m zh^2)/D^2] + h (2 dr^2 + m zh^2)/D^2 }
//   J_ABB =  8 r0/(D^3 d^2)  { c [zh^2 + (2/3)(zh^2 - e)(dr^2/d^2 - zh^2/D^2)] - h zh^2 (zh^2 - e)/D^2 }
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

/// What the stress needs besides a RingBlock.
template <class S>
struct RingNormals {
    typename RingBlock<S>::Array r;
    typename RingBlock<S>::Array z;
    typename RingBlock<S>::Array dr;     // r - r0, scaled
    typename RingBlock<S>::Array scale;  // what lengths were multiplied by: Q is homogeneous of degree -1
};

template <class S>
void fill_normals(const Point<S>& target, const S* r, const S* z, const S* normal_r, const S* normal_z, std::size_t n,
                  RingNormals<S>& normals) {
    using std::abs;
    for (std::size_t i = 0; i < n; ++i) {
        const S scale = S(1) / (r[i] + target.r + abs(z[i] - target.z));
        normals.r[i] = normal_r[i];
        normals.z[i] = normal_z[i];
        normals.dr[i] = (r[i] - target.r) * scale;
        normals.scale[i] = scale;
    }
}

/// The entries of Q for a block of n sources, stored from element `begin` of `out` on.
template <class S>
void store_stress(const RingBlock<S>& block, const RingNormals<S>& normals, const RingChannel<S>& channel, Index begin,
                  std::size_t n, const KernelArrays<S>& out) {
    S* __restrict rr = out.rr + begin;
    S* __restrict rz = out.rz + begin;
    S* __restrict zr = out.zr + begin;
    S* __restrict zz = out.zz + begin;
    const S third = S(1) / S(3);
    for (std::size_t i = 0; i < n; ++i) {
        const S r = block.r[i];
        const S r0 = block.r0[i];
        const S zh = block.zh[i];
        const S h = channel.h[i];
        const S c_over_d2 = channel.c_over_d2[i];
        const S e = block.r2_minus_r02[i];
        const S inv_d2 = block.inv_d2[i];
        const S inv_big_d2 = block.inv_big_d2[i];
        const S m1 = block.m1[i];
        const S dr = normals.dr[i];
        const S zh2 = zh * zh;
        const S radial = dr * dr * inv_d2;  // radial + axial = 1
        const S axial = zh2 * inv_d2;
        const S over_d = 4 * block.inv_big_d[i];
        const S over_d3 = 2 * (over_d * inv_big_d2);
        const S ratio = 4 * (r * r0) * inv_big_d2;  // m
        const S common = 2 * (S(1) + m1) * c_over_d2 + 3 * (h * inv_big_d2);
        // zh J_1, zh J_A, zh J_B: J_1 and J_A alone are too large where d is small.
        const S zh_over_d2 = zh * inv_d2;
        const S j1 = third * over_d * zh_over_d2 *
                     (2 * (S(1) + m1 * (S(1) + m1)) * c_over_d2 + 3 * (S(1) + m1) * (h * inv_big_d2));
        const S ja = third * over_d3 * r0 * (zh_over_d2 * (zh2 - e) * common - zh * c_over_d2);
        const S jb = -third * over_d3 * r * (zh_over_d2 * (zh2 + e) * common - zh * c_over_d2);
        const S jab =
            over_d3 * (r * r0) * (4 * third * (c_over_d2 * (radial - zh2 * inv_big_d2)) - 2 * (axial * inv_big_d2 * h));
        const S jbb = over_d * (2 * third * c_over_d2 * (radial + (2 * (r * dr) + ratio * zh2) * inv_big_d2) +
                                (2 * radial + ratio * axial) * inv_big_d2 * h);
        const S jabb = over_d3 * r0 *
                       (c_over_d2 * (zh2 + 2 * third * (zh2 - e) * (radial - zh2 * inv_big_d2)) -
                        axial * inv_big_d2 * h * (zh2 - e));
        const S nr = normals.r[i];
        const S nz = normals.z[i];
        const S factor = 6 * (r * normals.scale[i]);
        rr[i] = factor * (nz * (zh * jab) - nr * jabb);
        rz[i] = factor * zh * (nr * jab - nz * ja);
        zr[i] = factor * zh * (nr * jbb - nz * jb);
        zz[i] = factor * zh * (nz * (zh * j1) - nr * jb);
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
            set_zero(log_coefficient, n);
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

    /// The double layer's Q(target, (r[i], z[i])) for unit normals (normal_r[i], normal_z[i]) at the sources, i < n:
    /// u_a(x0) = 1/(8 pi) sum_b Int Q_ab(x0, x) u_b(x) dl(x). Contains the ring's Jacobian r, not 1/(8 pi). Over a
    /// closed surface with outward normals Q integrates a uniform e_z to 8 pi e_z for a target inside and to 0 outside.
    /// Preconditions as for `singular`; points closer than 1e-75 (double) of their distance to the axis count as equal.
    void stress(Point<S> target, const S* r, const S* z, const S* normal_r, const S* normal_z, Index n,
                KernelArrays<S> out) const {
        for_each_block(target, r, z, n, [&](const detail::RingBlock<S>& block, Index begin, std::size_t count) {
            detail::RingChannel<S> channel;
            detail::RingNormals<S> normals;
            detail::fill_channel(block, count, channel);
            detail::fill_normals(target, r + begin, z + begin, normal_r + begin, normal_z + begin, count, normals);
            detail::store_stress(block, normals, channel, begin, count, out);
        });
    }

    /// Q(target, source).
    KernelBlock<S> stress(Point<S> target, Point<S> source, Point<S> normal) const {
        KernelBlock<S> q;
        stress(target, &source.r, &source.z, &normal.r, &normal.z, 1, {&q.rr, &q.rz, &q.zr, &q.zz});
        return q;
    }

    /// Q = smooth + log_coefficient * log(m1), as singular_split. Along a smooth curve with its own normals both are
    /// bounded, as X.n = O(|X|^2) there, and analytic where the curve is; across curves they depend on the direction.
    void stress_split(Point<S> target, const S* r, const S* z, const S* normal_r, const S* normal_z, Index n,
                      KernelArrays<S> smooth, KernelArrays<S> log_coefficient) const {
        if (target.r == S(0)) {
            stress(target, r, z, normal_r, normal_z, n, smooth);
            set_zero(log_coefficient, n);
            return;
        }
        for_each_block(target, r, z, n, [&](const detail::RingBlock<S>& block, Index begin, std::size_t count) {
            detail::RingChannel<S> regular;
            detail::RingChannel<S> logarithm;
            detail::RingNormals<S> normals;
            detail::fill_split_channels(block, count, regular, logarithm);
            detail::fill_normals(target, r + begin, z + begin, normal_r + begin, normal_z + begin, count, normals);
            detail::store_stress(block, normals, regular, begin, count, smooth);
            detail::store_stress(block, normals, logarithm, begin, count, log_coefficient);
        });
    }

  private:
    static void set_zero(const KernelArrays<S>& out, Index n) {
        for (S* entry : {out.rr, out.rz, out.zr, out.zz}) {
            std::fill_n(entry, n, S(0));
        }
    }

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
