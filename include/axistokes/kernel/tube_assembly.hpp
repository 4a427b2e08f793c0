// SPDX-License-Identifier: MIT
// The batch evaluation of the tube's correction; included by tube.hpp.
#pragma once

#include "tube.hpp"

#include <algorithm>
#include <cmath>

namespace axistokes {

/// Factors of all points of a batch, slab by slab. A point's two velocity components are two rows; a wave number is
/// four columns, (P, Q) x (cos, sin) or (P, Q) x (Re, Im), so arranged that -out is the product of target and source
/// rows:
///   target  z: u cos, u sin     r: u sin, -u cos       source  z: s cos, s sin     r: s sin, -s cos.
template <class S>
class TubeKernel<S>::Assembly {
  public:
    using Rows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Weights = Eigen::SparseMatrix<S, Eigen::RowMajor>;

    Assembly(const TubeKernel& kernel, const Meridian<S>& targets, const Meridian<S>& points, const Weights& weights)
        : kernel_(kernel), targets_(targets), points_(points), weights_(weights) {
        target_gap_ = gaps(targets, "target radius");
        point_gap_ = gaps(points, "source radius");
        nearest_target_ = target_gap_.minCoeff();
        nearest_point_ = point_gap_.minCoeff();
        require_clear(nearest_target_ + nearest_point_);
        bottom_ = std::min(targets.z.minCoeff(), points.z.minCoeff());
        top_ = std::max(targets.z.maxCoeff(), points.z.maxCoeff());
        sort_into_slabs();
    }

    void add_to(Matrix<S>& out) {
        const auto slabs = static_cast<Index>(target_slabs_.size());
        const double height = static_cast<double>(top_ - bottom_) / static_cast<double>(slabs);
        const auto gap = static_cast<double>(nearest_target_ + nearest_point_);
        const auto eps = static_cast<double>(kernel_.params_.tolerance);
        near(detail::TubeSpectrum<S>(kernel_.tube_radius_, 0, height * static_cast<double>(std::min<Index>(slabs, 2)),
                                     gap, eps),
             out);
        if constexpr (detail::RayScalar<S>::turned) {
            if (slabs > 2) {
                far(detail::TubeSpectrum<std::complex<S>>(kernel_.tube_radius_, height,
                                                          static_cast<double>(top_ - bottom_), gap, eps),
                    out);
            }
        }
    }

  private:
    /// Wider slabs need more wave numbers for close pairs, narrower ones more for distant pairs.
    static constexpr double slab_height = 0.4;  // in Rc

    Vector<S> gaps(const Meridian<S>& m, const char* what) const {
        Vector<S> result(m.nodes());
        for (Index i = 0; i < m.nodes(); ++i) {
            result[i] = kernel_.gap(m.r[i], what);
        }
        return result;
    }

    void sort_into_slabs() {
        const auto height = static_cast<double>((top_ - bottom_) / kernel_.tube_radius_);
        const auto count =
            detail::RayScalar<S>::turned ? std::max<Index>(1, static_cast<Index>(height / slab_height)) : 1;
        target_slabs_.resize(static_cast<std::size_t>(count));
        point_slabs_.resize(static_cast<std::size_t>(count));
        edges_.resize(static_cast<std::size_t>(count) + 1);
        for (Index k = 0; k <= count; ++k) {
            edges_[static_cast<std::size_t>(k)] = bottom_ + (top_ - bottom_) * S(k) / S(count);
        }
        const auto slab = [&](const S& z) {
            const auto k = static_cast<Index>(std::upper_bound(edges_.begin(), edges_.end(), z) - edges_.begin()) - 1;
            return static_cast<std::size_t>(std::clamp<Index>(k, 0, count - 1));
        };
        for (Index i = 0; i < targets_.nodes(); ++i) {
            target_slabs_[slab(targets_.z[i])].push_back(i);
        }
        for (Index q = 0; q < points_.nodes(); ++q) {
            point_slabs_[slab(points_.z[q])].push_back(q);
        }
    }

    /// Nodes that the points of a slab carry forces of, ascending.
    std::vector<Index> nodes_of(const std::vector<Index>& points) const {
        std::vector<Index> nodes;
        for (const Index q : points) {
            for (typename Weights::InnerIterator it(weights_, q); it; ++it) {
                nodes.push_back(it.col());
            }
        }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
    }

    /// Adds weight times a point's two rows to each of its nodes.
    void contract(Index q, const Rows& point_rows, const std::vector<Index>& nodes, Rows& rows) const {
        for (typename Weights::InnerIterator it(weights_, q); it; ++it) {
            const auto j = static_cast<Index>(std::lower_bound(nodes.begin(), nodes.end(), it.col()) - nodes.begin());
            rows.middleRows(2 * j, 2) += (it.value() * points_.r[q]) * point_rows;
        }
    }

    /// out -= rows of a target slab times rows of a source slab.
    void scatter(const Rows& target_rows, const std::vector<Index>& targets, const Rows& source_rows,
                 const std::vector<Index>& nodes, Matrix<S>& out) const {
        const Matrix<S> block = target_rows * source_rows.transpose();
        const Index n_targets = targets_.nodes();
        const Index n_nodes = weights_.cols();
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            const auto bj = static_cast<Index>(2 * j);
            for (std::size_t i = 0; i < targets.size(); ++i) {
                const auto bi = static_cast<Index>(2 * i);
                out(targets[i], nodes[j]) -= block(bi, bj);
                out(targets[i], n_nodes + nodes[j]) -= block(bi, bj + 1);
                out(n_targets + targets[i], nodes[j]) -= block(bi + 1, bj);
                out(n_targets + targets[i], n_nodes + nodes[j]) -= block(bi + 1, bj + 1);
            }
        }
    }

    static void write(S* r, S* z, const detail::TubeModes<S>& u, const S& c, const S& s) {
        z[0] = u.zp * c;
        z[1] = u.zq * c;
        z[2] = u.zp * s;
        z[3] = u.zq * s;
        r[0] = u.rp * s;
        r[1] = u.rq * s;
        r[2] = -u.rp * c;
        r[3] = -u.rq * c;
    }

    void near(const detail::TubeSpectrum<S>& spectrum, Matrix<S>& out) const {
        using std::cos;
        using std::sin;
        const auto columns = static_cast<Index>(4 * spectrum.size());
        const S centre = (bottom_ + top_) / 2;
        // Rows (r, z) of one point; wave numbers past its reach are zero.
        const auto fill = [&](const S& z, std::size_t relevant, S* row_r, S* row_z, const auto& modes) {
            for (std::size_t k = 0; k < relevant; ++k) {
                const S angle = spectrum.zeta(k) * (z - centre);
                write(row_r + 4 * k, row_z + 4 * k, modes(k), cos(angle), sin(angle));
            }
        };
        std::vector<Rows> target_rows;
        for (const std::vector<Index>& slab : target_slabs_) {
            Rows rows = Rows::Zero(static_cast<Index>(2 * slab.size()), columns);
            for (std::size_t i = 0; i < slab.size(); ++i) {
                const S r = targets_.r[slab[i]];
                const S gap = target_gap_[slab[i]];
                const auto row = static_cast<Index>(2 * i);
                fill(targets_.z[slab[i]], spectrum.relevant(gap + nearest_point_), &rows(row, 0), &rows(row + 1, 0),
                     [&](std::size_t k) { return spectrum.target(k, r, gap); });
            }
            target_rows.push_back(std::move(rows));
        }
        Rows point_rows(2, columns);
        for (std::size_t j = 0; j < point_slabs_.size(); ++j) {
            const std::vector<Index> nodes = nodes_of(point_slabs_[j]);
            Rows rows = Rows::Zero(static_cast<Index>(2 * nodes.size()), columns);
            for (const Index q : point_slabs_[j]) {
                const S r = points_.r[q];
                const S gap = point_gap_[q];
                point_rows.setZero();
                fill(points_.z[q], spectrum.relevant(gap + nearest_target_), &point_rows(0, 0), &point_rows(1, 0),
                     [&](std::size_t k) { return spectrum.source(k, r, gap); });
                contract(q, point_rows, nodes, rows);
            }
            for (std::size_t i = j == 0 ? 0 : j - 1; i < std::min(j + 2, target_slabs_.size()); ++i) {
                scatter(target_rows[i], target_slabs_[i], rows, nodes, out);
            }
        }
    }

    using C = std::complex<S>;

    /// u times phase; an r row carries the factor `turn`, i for sources above the target and -i for those below (a
    /// source's row the inverse of it), which makes Im of the mixed entries and keeps Re of the others.
    static void write(S* r, S* z, const detail::TubeModes<C>& u, const C& phase, const C& turn,
                      const S& imaginary_sign) {
        const std::array<C, 2> zs{u.zp * phase, u.zq * phase};
        const std::array<C, 2> rs{turn * u.rp * phase, turn * u.rq * phase};
        for (std::size_t m = 0; m < 2; ++m) {
            z[m] = zs[m].real();
            z[m + 2] = imaginary_sign * zs[m].imag();
            r[m] = rs[m].real();
            r[m + 2] = imaginary_sign * rs[m].imag();
        }
    }

    void far(const detail::TubeSpectrum<C>& spectrum, Matrix<S>& out) const {
        using std::exp;
        const auto columns = static_cast<Index>(4 * spectrum.size());
        const std::size_t slabs = target_slabs_.size();
        const C i_unit(0, 1);
        // Phases are taken from the slab's edge that faces the other slab: exponentials that only decay.
        std::vector<Rows> from_above;
        std::vector<Rows> from_below;
        for (std::size_t slab = 0; slab < slabs; ++slab) {
            const std::vector<Index>& members = target_slabs_[slab];
            Rows above(static_cast<Index>(2 * members.size()), columns);
            Rows below(above.rows(), columns);
            for (std::size_t i = 0; i < members.size(); ++i) {
                const S r = targets_.r[members[i]];
                const S z = targets_.z[members[i]];
                const auto row = static_cast<Index>(2 * i);
                for (std::size_t k = 0; k < spectrum.size(); ++k) {
                    const detail::TubeModes<C> u = spectrum.target(k, r, target_gap_[members[i]]);
                    const auto column = static_cast<Index>(4 * k);
                    const C iz = i_unit * spectrum.zeta(k);
                    write(&above(row, column), &above(row + 1, column), u, exp(iz * (edges_[slab + 1] - z)), i_unit,
                          S(1));
                    write(&below(row, column), &below(row + 1, column), u, exp(iz * (z - edges_[slab])), -i_unit, S(1));
                }
            }
            from_above.push_back(std::move(above));
            from_below.push_back(std::move(below));
        }
        Rows up(2, columns);
        Rows down(2, columns);
        for (std::size_t j = 0; j < slabs; ++j) {
            const std::vector<Index> nodes = nodes_of(point_slabs_[j]);
            Rows to_above = Rows::Zero(static_cast<Index>(2 * nodes.size()), columns);
            Rows to_below = to_above;
            for (const Index q : point_slabs_[j]) {
                for (std::size_t k = 0; k < spectrum.size(); ++k) {
                    const detail::TubeModes<C> s = spectrum.source(k, points_.r[q], point_gap_[q]);
                    const auto column = static_cast<Index>(4 * k);
                    const C iz = i_unit * spectrum.zeta(k);
                    write(&down(0, column), &down(1, column), s, exp(iz * (points_.z[q] - edges_[j])), -i_unit, S(-1));
                    write(&up(0, column), &up(1, column), s, exp(iz * (edges_[j + 1] - points_.z[q])), i_unit, S(-1));
                }
                contract(q, down, nodes, to_below);
                contract(q, up, nodes, to_above);
            }
            for (std::size_t i = 0; i + 1 < j; ++i) {
                scatter(shifted(from_above[i], spectrum, edges_[j] - edges_[i + 1]), target_slabs_[i], to_below, nodes,
                        out);
            }
            for (std::size_t i = j + 2; i < slabs; ++i) {
                scatter(shifted(from_below[i], spectrum, edges_[i] - edges_[j + 1]), target_slabs_[i], to_above, nodes,
                        out);
            }
        }
    }

    /// Target rows times exp(i zeta distance).
    static Rows shifted(const Rows& rows, const detail::TubeSpectrum<C>& spectrum, const S& distance) {
        using std::exp;
        Rows result(rows.rows(), rows.cols());
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            const C phase = exp(C(0, 1) * spectrum.zeta(k) * distance);
            const auto column = static_cast<Index>(4 * k);
            for (Index m = column; m < column + 2; ++m) {
                result.col(m) = phase.real() * rows.col(m) - phase.imag() * rows.col(m + 2);
                result.col(m + 2) = phase.real() * rows.col(m + 2) + phase.imag() * rows.col(m);
            }
        }
        return result;
    }

    const TubeKernel& kernel_;
    const Meridian<S>& targets_;
    const Meridian<S>& points_;
    const Weights& weights_;
    Vector<S> target_gap_, point_gap_;
    S nearest_target_{}, nearest_point_{};
    S bottom_{}, top_{};
    std::vector<S> edges_;
    std::vector<std::vector<Index>> target_slabs_, point_slabs_;
};

template <class S>
void TubeKernel<S>::regular(const Meridian<S>& targets, const Meridian<S>& points,
                            const Eigen::SparseMatrix<S, Eigen::RowMajor>& weights, Matrix<S>& out) const {
    Assembly(*this, targets, points, weights).add_to(out);
}

}  // namespace axistokes
