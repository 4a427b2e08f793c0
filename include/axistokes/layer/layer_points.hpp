// SPDX-License-Identifier: MIT
// Quadrature points on a curve, as a layer's assembly asks for them and a basis answers; and the storage of kernel
// entries and rows that both use.
#pragma once

#include "../core.hpp"
#include "../quadrature/gauss_legendre.hpp"

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace axistokes::detail {

/// The basis is asked for `panel`, the parameter `t` there and the `weight` of Int ... dt. Its evaluate() fills in the
/// rest and multiplies the weight by |dx/dt|.
template <class S>
struct LayerPoints {
    std::vector<Index> panel;
    std::vector<S> t;
    std::vector<S> weight;
    std::vector<S> r;
    std::vector<S> z;
    std::vector<S> normal_r;  // the normal, outward, only if asked for
    std::vector<S> normal_z;
    AlignedNumbers<S> shares;  // of the nodal densities in that at a point, as many a point as the basis says

    Index size() const { return static_cast<Index>(t.size()); }

    void clear() {
        panel.clear();
        t.clear();
        weight.clear();
    }

    /// The rule on [begin, end] of a panel, from `begin` on; it may be the larger one.
    void add(Index p, const S& begin, const S& end, const GaussLegendreRule<S>& rule) {
        const S width = end - begin;
        const S length = width < S(0) ? S(-width) : width;
        const std::size_t old = t.size();
        const auto n = static_cast<std::size_t>(rule.nodes.size());
        panel.resize(old + n, p);
        t.resize(old + n);
        weight.resize(old + n);
        for (std::size_t q = 0; q < n; ++q) {
            t[old + q] = begin + width * rule.nodes.data()[q];
            weight[old + q] = length * rule.weights.data()[q];
        }
    }
};

/// Of a matrix of 2 points x 2 targets, where a target's rows are neighbouring columns: the entries of target i with
/// the points (or nodes) from `begin` on.
template <class S>
KernelArrays<S> entries_of(Matrix<S>& m, Index begin, Index i) {
    S* first = m.data() + 2 * i * m.rows() + begin;
    const Index points = m.rows() / 2;
    return {first, first + points, first + m.rows(), first + m.rows() + points};
}

/// Bases whose densities on panel p are polynomials through the nodes p stride, ..., p stride + width - 1 (`Width` if
/// it is known to the compiler).
template <class S, int Width>
class LocalShares {
  public:
    LocalShares(Index width, Index stride) : width_(width), stride_(stride) {}

    Index width() const {
        if constexpr (Width == Eigen::Dynamic) {
            return width_;
        } else {
            return Width;
        }
    }

    /// to += entries (2 points x columns) times weights and shares (2 nodes x columns). Points without shares are the
    /// nodes.
    void spread(const LayerPoints<S>& points, const Matrix<S>& entries, Eigen::Ref<Matrix<S>> to) const {
        const Index count = points.size();
        const Index nodes = to.rows() / 2;
        const S* weight = points.weight.data();
        const Index* panel = points.panel.data();
        for (Index c = 0; c < entries.cols(); c += 2) {
            const S* from = entries.data() + c * entries.rows();
            S* u_r = to.data() + c * to.outerStride();
            S* u_z = u_r + to.outerStride();
            const auto add = [&](Index q, Index node, const S& share) {
                u_r[node] += share * from[q];
                u_r[nodes + node] += share * from[count + q];
                u_z[node] += share * from[2 * count + q];
                u_z[nodes + node] += share * from[3 * count + q];
            };
            const S* share = points.shares.data();
            for (Index q = 0; q < count; ++q) {
                if (points.shares.empty()) {
                    add(q, q, weight[q]);
                    continue;
                }
                for (Index k = 0; k < width(); ++k, ++share) {
                    add(q, panel[q] * stride_ + k, weight[q] * *share);
                }
            }
        }
    }

    /// The same as a matrix: points x nodes.
    Eigen::SparseMatrix<S, Eigen::RowMajor> weights(const LayerPoints<S>& points, Index nodes) const {
        Eigen::SparseMatrix<S, Eigen::RowMajor> result(points.size(), nodes);
        result.reserve(points.size() * width());
        const S* share = points.shares.data();
        for (Index q = 0; q < points.size(); ++q) {
            const auto p = static_cast<std::size_t>(q);
            result.startVec(q);
            for (Index k = 0; k < width(); ++k, ++share) {
                result.insertBack(q, points.panel[p] * stride_ + k) = points.weight[p] * *share;
            }
        }
        result.finalize();
        return result;
    }

  private:
    Index width_;
    Index stride_;
};

}  // namespace axistokes::detail
