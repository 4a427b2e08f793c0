// SPDX-License-Identifier: MIT
// The factors of one point for all real wave numbers, in loops that vectorise.
//
// Wave numbers are zeta = centre + offset on panels of equal length, so exp(zeta (i z - gap)) is the product of one
// exponential per panel and one per offset, and offsets are symmetric. Where zeta r is large the Bessel functions are
// one polynomial in 1/(zeta r).
#pragma once

#include "tube_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace axistokes::detail {

/// Rows have four columns per wave number, in four blocks: P cos, Q cos, P sin, Q sin.
template <class S>
class TubeWaves {
  public:
    explicit TubeWaves(const TubeSpectrum<S>& spectrum)
        : spectrum_(spectrum), cosine_(spectrum.size()), sine_(spectrum.size()) {
        using std::sqrt;
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            const WallFactors<S>& wall = spectrum.wall(k);
            const TubeCoupling<S>& coupling = spectrum.coupling(k);
            const S& zeta = spectrum.zeta(k);
            const std::array<S, coefficients> values{
                zeta,   S(1) / zeta, S(1) / sqrt(zeta), wall.i0,     wall.i1,    wall.wi0,
                wall.d, wall.outer,  coupling.pp,       coupling.pq, coupling.qq};
            for (std::size_t i = 0; i < coefficients; ++i) {
                coefficient_[i].push_back(values[i]);
            }
        }
    }

    Index columns() const { return static_cast<Index>(4 * spectrum_.size()); }

    /// z: u cos, u sin     r: u sin, -u cos, for the first `relevant` wave numbers.
    void target(const S& r, const S& gap, const S& z, std::size_t relevant, S* row_r, S* row_z) {
        fill<false>(r, gap, z, relevant, row_r, row_z);
    }

    /// The same with sum_l S_kl u^l.
    void source(const S& r, const S& gap, const S& z, std::size_t relevant, S* row_r, S* row_z) {
        fill<true>(r, gap, z, relevant, row_r, row_z);
    }

  private:
    static constexpr std::size_t coefficients = 11;
    static constexpr std::size_t block = 32;
    using Block = std::array<S, block>;
    using Rows = Eigen::Map<Eigen::Array<S, Eigen::Dynamic, 1>>;
    using Values = Eigen::Map<const Eigen::Array<S, Eigen::Dynamic, 1>>;

    template <bool is_source>
    void fill(const S& r, const S& gap, const S& z, std::size_t relevant, S* row_r, S* row_z) {
        using std::cos;
        using std::sin;
        const std::size_t n = spectrum_.size();
        const std::size_t split = first_asymptotic(r, relevant);
        for (std::size_t k = 0; k < split; ++k) {
            const TubeModes<S> u = is_source ? spectrum_.source(k, r, gap) : spectrum_.target(k, r, gap);
            const S angle = spectrum_.zeta(k) * z;
            const S c = cos(angle);
            const S s = sin(angle);
            row_z[k] = u.zp * c;
            row_z[k + n] = u.zq * c;
            row_z[k + 2 * n] = u.zp * s;
            row_z[k + 3 * n] = u.zq * s;
            row_r[k] = u.rp * s;
            row_r[k + n] = u.rq * s;
            row_r[k + 2 * n] = -u.rp * c;
            row_r[k + 3 * n] = -u.rq * c;
        }
        if constexpr (ScaledITable<S>::asymptotic) {
            if (split == relevant) {
                return;
            }
            phases(split, relevant, gap, z);
            for (std::size_t k = split; k < relevant; k += block) {
                modes<is_source>(r, gap, k, std::min(block, relevant - k), row_r, row_z);
            }
        }
    }

    /// The first wave number whose Bessel functions are given by the asymptotic polynomial.
    std::size_t first_asymptotic(const S& r, std::size_t relevant) const {
        if constexpr (ScaledITable<S>::asymptotic) {
            const std::vector<S>& zeta = coefficient_[0];
            const auto large = [&](const S& value) { return value * r >= S(ScaledITable<S>::cells); };
            return static_cast<std::size_t>(std::partition_point(zeta.begin(),
                                                                 zeta.begin() + static_cast<std::ptrdiff_t>(relevant),
                                                                 [&](const S& value) { return !large(value); }) -
                                            zeta.begin());
        } else {
            return relevant;
        }
    }

    /// Real and imaginary part of exp(zeta (i z - gap)).
    void phases(std::size_t begin, std::size_t end, const S& gap, const S& z) {
        using std::cos;
        using std::exp;
        using std::sin;
        double length = 0;
        std::size_t count = 0;
        for (const FourierPanel<S>& panel : spectrum_.panels()) {
            if (panel.first + panel.count <= begin || panel.first >= end) {
                continue;
            }
            if (panel.length != length || panel.count != count) {
                length = panel.length;
                count = panel.count;
                for (std::size_t j = count / 2; j < count; ++j) {
                    const S offset = coefficient_[0][panel.first + j] - panel.centre;
                    const S growth = exp(offset * gap);
                    const S c = cos(offset * z);
                    const S s = sin(offset * z);
                    offset_cosine_[j] = c / growth;
                    offset_sine_[j] = s / growth;
                    offset_cosine_[count - 1 - j] = c * growth;
                    offset_sine_[count - 1 - j] = -s * growth;
                }
            }
            const S decay = exp(-panel.centre * gap);
            const S c = decay * cos(panel.centre * z);
            const S s = decay * sin(panel.centre * z);
            const auto m = static_cast<Index>(count);
            const Values oc(offset_cosine_.data(), m);
            const Values os(offset_sine_.data(), m);
            Rows(cosine_.data() + panel.first, m) = c * oc - s * os;
            Rows(sine_.data() + panel.first, m) = s * oc + c * os;
        }
    }

    /// tube_modes.hpp's evaluator for wave numbers [k, k + count), with everything that depends on zeta precomputed.
    template <bool is_source>
    void modes(const S& r, const S& gap, std::size_t k, std::size_t count, S* row_r, S* row_z) const {
        using std::sqrt;
        const ScaledITable<S>& table = spectrum_.bessel();
        const std::size_t n = spectrum_.size();
        const S ratio = r / spectrum_.tube_radius();
        const S inverse = S(1) / r;
        const S root = S(1) / sqrt(r);
        const auto at = [&](std::size_t i) { return coefficient_[i].data() + k; };
        const S* const zeta = at(0);
        const S* const inv_zeta = at(1);
        const S* const inv_root = at(2);
        const S* const wall_i0 = at(3);
        const S* const wall_i1 = at(4);
        const S* const wall_wi0 = at(5);
        const S* const wall_d = at(6);
        const S* const outer = at(7);
        const S* const pp = at(8);
        const S* const pq = at(9);
        const S* const qq = at(10);
        Block zp;
        Block zq;
        Block rp;
        Block rq;
        for (std::size_t i = 0; i < count; ++i) {
            const S inv_t = inv_zeta[i] * inverse;
            const ScaledIPair<S> b = table.beyond(inv_t);
            const S scale = inv_root[i] * root;
            const S i0 = scale * b.i0;
            const S tc = scale * b.difference;
            const S c = tc * inv_t;
            const S shift = zeta[i] * gap * wall_i0[i];
            const S p = shift + ratio * wall_d[i];
            const S q = wall_d[i] - shift;
            zp[i] = i0 * (p - 2 * wall_i1[i]) + tc * wall_i1[i];
            rp[i] = i0 * p - c * wall_wi0[i];
            zq[i] = i0 * q - tc * wall_i0[i];
            rq[i] = i0 * (q - 2 * wall_i0[i]) + c * outer[i];
        }
        if constexpr (is_source) {
            for (std::size_t i = 0; i < count; ++i) {
                const S z = zp[i];
                const S r_part = rp[i];
                zp[i] = pp[i] * z + pq[i] * zq[i];
                rp[i] = pp[i] * r_part + pq[i] * rq[i];
                zq[i] = pq[i] * z + qq[i] * zq[i];
                rq[i] = pq[i] * r_part + qq[i] * rq[i];
            }
        }
        const auto m = static_cast<Index>(count);
        const Values c(cosine_.data() + k, m);
        const Values s(sine_.data() + k, m);
        const auto product = [&](S* out, const Block& u, const Values& phase) {
            Rows(out, m) = Values(u.data(), m) * phase;
        };
        product(row_z + k, zp, c);
        product(row_z + k + n, zq, c);
        product(row_z + k + 2 * n, zp, s);
        product(row_z + k + 3 * n, zq, s);
        product(row_r + k, rp, s);
        product(row_r + k + n, rq, s);
        Rows(row_r + k + 2 * n, m) = -Values(rp.data(), m) * c;
        Rows(row_r + k + 3 * n, m) = -Values(rq.data(), m) * c;
    }

    const TubeSpectrum<S>& spectrum_;
    std::array<std::vector<S>, coefficients> coefficient_;
    AlignedNumbers<S> cosine_, sine_;
    std::array<S, most_panel_nodes> offset_cosine_{}, offset_sine_{};
};

}  // namespace axistokes::detail
