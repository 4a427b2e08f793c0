// SPDX-License-Identifier: MIT
// The batch evaluation of the tube's correction; included by tube.hpp.
#pragma once

#include "tube.hpp"
#include "tube_waves.hpp"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

namespace axistokes::detail {

/// Factors of all points of a batch, slab by slab. A point's two velocity components are two rows; a wave number is
/// four columns, (P, Q) x (cos, sin) or (P, Q) x (Re, Im), so arranged that -out is the product of target and source
/// rows.
template <class S>
class TubeAssembly {
  public:
    TubeAssembly(const TubeImages<S>& images, const Meridian<S>& targets)
        : images_(images), targets_(targets), target_gap_(gaps(targets, "target radius")) {}

    using Quadrature = std::function<RegularQuadrature<S>(const S&)>;
    void add_to(Matrix<S>& out, const Quadrature& quadrature);

  private:
    using Rows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Weights = Eigen::SparseMatrix<S, Eigen::RowMajor>;

    /// Slab height over sqrt(gap Rc). Close pairs cost height/gap wave numbers, distant ones more products the more
    /// slabs there are; the best height, measured for films from 0.4 to 0.005 Rc, follows the geometric mean.
    static constexpr double slab_height = 2.5;

    struct Sources {
        Sources(const TubeAssembly& assembly, const RegularQuadrature<S>& q)
            : points(q.points), panel(q.panel), weights(q.weights), gap(assembly.gaps(q.points, "source radius")) {}
        const Meridian<S>& points;
        const Vector<S>& panel;
        const Weights& weights;
        Vector<S> gap;
    };

    Vector<S> gaps(const Meridian<S>& m, const char* what) const {
        Vector<S> result(m.nodes());
        for (Index i = 0; i < m.nodes(); ++i) {
            result[i] = images_.gap_inside(m.r[i], what);
        }
        return result;
    }

    /// Points stray at most a quarter of a slab's height out of their panel's slab.
    void make_slabs(const S& bottom, const S& top, const S& stray, const S& gap) {
        using std::sqrt;
        const S least = std::max<S>(S(slab_height) * sqrt(gap * images_.radius()), 4 * stray);
        const auto count = RayScalar<S>::turned
                               ? std::max<Index>(1, static_cast<Index>(static_cast<double>((top - bottom) / least)))
                               : 1;
        edges_.resize(static_cast<std::size_t>(count) + 1);
        for (Index k = 0; k <= count; ++k) {
            edges_[static_cast<std::size_t>(k)] = bottom + (top - bottom) * S(k) / S(count);
        }
        target_slabs_ = sorted(targets_.z);
    }

    std::vector<std::vector<Index>> sorted(const Vector<S>& z) const {
        const std::size_t count = edges_.size() - 1;
        std::vector<std::vector<Index>> slabs(count);
        for (Index i = 0; i < z.size(); ++i) {
            const auto above =
                static_cast<std::size_t>(std::upper_bound(edges_.begin(), edges_.end(), z[i]) - edges_.begin());
            slabs[std::clamp<std::size_t>(above, 1, count) - 1].push_back(i);
        }
        return slabs;
    }

    /// Nodes that the points of a slab carry forces of, ascending.
    static std::vector<Index> nodes_of(const Weights& weights, const std::vector<Index>& points) {
        std::vector<Index> nodes;
        for (const Index q : points) {
            for (typename Weights::InnerIterator it(weights, q); it; ++it) {
                nodes.push_back(it.col());
            }
        }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
    }

    /// Adds weight times a point's two rows to each of its nodes.
    static void contract(const Sources& sources, Index q, const Rows& point_rows, const std::vector<Index>& nodes,
                         Rows& rows) {
        for (typename Weights::InnerIterator it(sources.weights, q); it; ++it) {
            const auto j = static_cast<Index>(std::lower_bound(nodes.begin(), nodes.end(), it.col()) - nodes.begin());
            const S factor = it.value() * sources.points.r[q];
            // The two rows follow each other.
            Eigen::Map<Vector<S>>(&rows(2 * j, 0), point_rows.size()) +=
                factor * Eigen::Map<const Vector<S>>(point_rows.data(), point_rows.size());
        }
    }

    /// out -= rows of a target slab times rows of a source slab. The product has the operand types of those in Eigen's
    /// LU decomposition: one instantiation for both.
    void scatter(Matrix<S>& target_rows, const std::vector<Index>& targets, Rows& source_rows,
                 const std::vector<Index>& nodes, Matrix<S>& out) const {
        using Operand = Eigen::Ref<Matrix<S>>;
        Matrix<S> minus_block = Matrix<S>::Zero(target_rows.rows(), source_rows.rows());
        Operand product(minus_block);
        const Operand left(target_rows);
        const Operand right(Eigen::Map<Matrix<S>>(source_rows.data(), source_rows.cols(), source_rows.rows()));
        product.noalias() -= left * right;
        const Index n_targets = targets_.nodes();
        const Index n_nodes = out.cols() / 2;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            const auto bj = static_cast<Index>(2 * j);
            for (std::size_t i = 0; i < targets.size(); ++i) {
                const auto bi = static_cast<Index>(2 * i);
                out(targets[i], nodes[j]) += minus_block(bi, bj);
                out(targets[i], n_nodes + nodes[j]) += minus_block(bi, bj + 1);
                out(n_targets + targets[i], nodes[j]) += minus_block(bi + 1, bj);
                out(n_targets + targets[i], n_nodes + nodes[j]) += minus_block(bi + 1, bj + 1);
            }
        }
    }

    void near(const TubeSpectrum<S>& spectrum, const Sources& sources, Matrix<S>& out) const {
        TubeWaves<S> waves(spectrum);
        const Index columns = waves.columns();
        const S centre = (edges_.front() + edges_.back()) / 2;
        const S nearest_target = target_gap_.minCoeff();
        const S nearest_point = sources.gap.minCoeff();
        const std::vector<std::vector<Index>> point_slabs = sorted(sources.panel);
        // Wave numbers past a point's reach stay zero.
        std::vector<Matrix<S>> target_rows;
        for (const std::vector<Index>& slab : target_slabs_) {
            Rows rows = Rows::Zero(static_cast<Index>(2 * slab.size()), columns);
            for (std::size_t i = 0; i < slab.size(); ++i) {
                const S gap = target_gap_[slab[i]];
                const auto row = static_cast<Index>(2 * i);
                waves.target(targets_.r[slab[i]], gap, targets_.z[slab[i]] - centre,
                             spectrum.relevant(gap + nearest_point), &rows(row, 0), &rows(row + 1, 0));
            }
            target_rows.emplace_back(rows);
        }
        Rows point_rows(2, columns);
        for (std::size_t j = 0; j < point_slabs.size(); ++j) {
            const std::vector<Index> nodes = nodes_of(sources.weights, point_slabs[j]);
            Rows rows = Rows::Zero(static_cast<Index>(2 * nodes.size()), columns);
            for (const Index q : point_slabs[j]) {
                const S gap = sources.gap[q];
                point_rows.setZero();
                waves.source(sources.points.r[q], gap, sources.points.z[q] - centre,
                             spectrum.relevant(gap + nearest_target), &point_rows(0, 0), &point_rows(1, 0));
                contract(sources, q, point_rows, nodes, rows);
            }
            for (std::size_t i = j == 0 ? 0 : j - 1; i < std::min(j + 2, target_slabs_.size()); ++i) {
                scatter(target_rows[i], target_slabs_[i], rows, nodes, out);
            }
        }
    }

    using C = std::complex<S>;

    /// An r row carries the factor i turn, turn = 1 facing up and -1 facing down. A target facing up meets a source
    /// facing down: the product of their factors is 1, and the mixed entries become Im instead of Re. side is -1 for a
    /// source's imaginary parts, which makes the real product of rows the real part of the complex one.
    static void write(S* r, S* z, const TubeModes<C>& u, const S& turn, const S& side) {
        z[0] = u.zp.real();
        z[1] = u.zq.real();
        z[2] = side * u.zp.imag();
        z[3] = side * u.zq.imag();
        r[0] = -turn * u.rp.imag();
        r[1] = -turn * u.rq.imag();
        r[2] = side * turn * u.rp.real();
        r[3] = side * turn * u.rq.real();
    }

    static TubeModes<C> scaled(const TubeModes<C>& u, const C& factor) {
        return {u.zp * factor, u.rp * factor, u.zq * factor, u.rq * factor};
    }

    void far(const TubeSpectrum<C>& spectrum, const Sources& sources, Matrix<S>& out) const {
        const auto columns = static_cast<Index>(4 * spectrum.size());
        const std::size_t slabs = target_slabs_.size();
        // Phases are taken from the slab's edge that faces the other slab: exponentials that only decay.
        const std::vector<C> across = phases(spectrum, edges_[1] - edges_[0]);
        const auto write_both = [&](std::size_t k, const TubeModes<C>& u, const S& to_bottom, const S& side,
                                    Rows& facing_up, Rows& facing_down, Index row) {
            const C from_bottom = std::conj(ray_decay<C>(spectrum.modulus(k), to_bottom));
            const C from_top = across[k] * std::conj(from_bottom) / std::norm(from_bottom);
            const auto column = static_cast<Index>(4 * k);
            write(&facing_up(row, column), &facing_up(row + 1, column), scaled(u, from_top), S(1), side);
            write(&facing_down(row, column), &facing_down(row + 1, column), scaled(u, from_bottom), S(-1), side);
        };
        std::vector<Matrix<S>> targets_up;
        std::vector<Matrix<S>> targets_down;
        for (std::size_t slab = 0; slab < slabs; ++slab) {
            const std::vector<Index>& members = target_slabs_[slab];
            Rows up(static_cast<Index>(2 * members.size()), columns);
            Rows down(up.rows(), columns);
            for (std::size_t i = 0; i < members.size(); ++i) {
                const Index target = members[i];
                for (std::size_t k = 0; k < spectrum.size(); ++k) {
                    write_both(k, spectrum.target(k, targets_.r[target], target_gap_[target]),
                               targets_.z[target] - edges_[slab], S(1), up, down, static_cast<Index>(2 * i));
                }
            }
            targets_up.emplace_back(up);
            targets_down.emplace_back(down);
        }
        const std::vector<std::vector<Index>> point_slabs = sorted(sources.panel);
        Rows up(2, columns);
        Rows down(2, columns);
        for (std::size_t j = 0; j < slabs; ++j) {
            const std::vector<Index> nodes = nodes_of(sources.weights, point_slabs[j]);
            Rows sources_up = Rows::Zero(static_cast<Index>(2 * nodes.size()), columns);
            Rows sources_down = sources_up;
            for (const Index q : point_slabs[j]) {
                for (std::size_t k = 0; k < spectrum.size(); ++k) {
                    write_both(k, spectrum.source(k, sources.points.r[q], sources.gap[q]),
                               sources.points.z[q] - edges_[j], S(-1), up, down, 0);
                }
                contract(sources, q, up, nodes, sources_up);
                contract(sources, q, down, nodes, sources_down);
            }
            for (std::size_t i = 0; i + 1 < j; ++i) {
                Matrix<S> moved = shifted(targets_up[i], phases(spectrum, edges_[j] - edges_[i + 1]));
                scatter(moved, target_slabs_[i], sources_down, nodes, out);
            }
            for (std::size_t i = j + 2; i < slabs; ++i) {
                Matrix<S> moved = shifted(targets_down[i], phases(spectrum, edges_[i] - edges_[j + 1]));
                scatter(moved, target_slabs_[i], sources_up, nodes, out);
            }
        }
    }

    /// exp(i zeta distance) for all wave numbers.
    static std::vector<C> phases(const TubeSpectrum<C>& spectrum, const S& distance) {
        std::vector<C> result;
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            result.push_back(std::conj(ray_decay<C>(spectrum.modulus(k), distance)));
        }
        return result;
    }

    /// Target rows times `phase`, one factor per wave number.
    static Matrix<S> shifted(const Matrix<S>& rows, const std::vector<C>& phase) {
        Matrix<S> result(rows.rows(), rows.cols());
        for (std::size_t k = 0; k < phase.size(); ++k) {
            for (auto m = static_cast<Index>(4 * k); m < static_cast<Index>(4 * k + 2); ++m) {
                for (Index i = 0; i < rows.rows(); ++i) {
                    result(i, m) = phase[k].real() * rows(i, m) - phase[k].imag() * rows(i, m + 2);
                    result(i, m + 2) = phase[k].real() * rows(i, m + 2) + phase[k].imag() * rows(i, m);
                }
            }
        }
        return result;
    }

    const TubeImages<S>& images_;
    const Meridian<S>& targets_;
    Vector<S> target_gap_;
    std::vector<S> edges_;
    std::vector<std::vector<Index>> target_slabs_;
};

template <class S>
void TubeAssembly<S>::add_to(Matrix<S>& out, const Quadrature& quadrature) {
    const RegularQuadrature<S> close = quadrature(S(0));
    const Sources sources(*this, close);
    const S gap = target_gap_.minCoeff() + sources.gap.minCoeff();
    images_.require_clear(gap);
    const S bottom = std::min(targets_.z.minCoeff(), close.points.z.minCoeff());
    const S top = std::max(targets_.z.maxCoeff(), close.points.z.maxCoeff());
    const S stray = (close.points.z - close.panel).cwiseAbs().maxCoeff();
    make_slabs(bottom, top, stray, gap);
    const auto height = static_cast<double>(edges_[1] - edges_[0]);
    const auto slack = static_cast<double>(stray);
    const auto slabs = static_cast<Index>(edges_.size()) - 1;
    const auto eps = static_cast<double>(images_.params().tolerance);
    const auto extent = static_cast<double>(top - bottom);
    const S radius = images_.radius();
    near(TubeSpectrum<S>(radius, 0, std::min(extent, 2 * height + slack), static_cast<double>(gap), eps), sources, out);
    if constexpr (RayScalar<S>::turned) {
        if (slabs > 2) {
            const RegularQuadrature<S> distant = quadrature(S(height - slack));
            far(TubeSpectrum<std::complex<S>>(radius, height - slack, extent, static_cast<double>(gap), eps),
                Sources(*this, distant), out);
        }
    }
}

}  // namespace axistokes::detail
