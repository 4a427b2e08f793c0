// SPDX-License-Identifier: MIT
// Products and sums with a surface's linear operators (Surface::Operator): dense or sparse matrices, or a type of your
// own with the operators * and +=.
//
// Functions instead of expressions, and loops for sparse matrices: Eigen instantiates each combination of operand types
// anew, sparse ones at several times the cost (docs/compile_time.md).
#pragma once

#include "core.hpp"

#include <Eigen/SparseCore>

#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes::detail {

template <class S>
using Sparse = Eigen::SparseMatrix<S>;
template <class S>
using Triplets = std::vector<Eigen::Triplet<S>>;

/// Calls use(row, column, value) for all entries.
template <class S, class Use>
void for_each_entry(const Sparse<S>& a, const Use& use) {
    for (Index j = 0; j < a.outerSize(); ++j) {
        for (typename Sparse<S>::InnerIterator it(a, j); it; ++it) {
            use(it.row(), j, it.value());
        }
    }
}

template <class S>
void add_entry(Triplets<S>& entries, Index row, Index column, const std::type_identity_t<S>& value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

/// Entries at the same place are summed.
template <class S>
Sparse<S> assembled(Index rows, Index columns, const Triplets<S>& entries) {
    Sparse<S> result(rows, columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// [a; b].
template <class S>
Vector<S> stacked(const Vector<S>& a, const Vector<S>& b) {
    Vector<S> both(a.size() + b.size());
    for (Index i = 0; i < a.size(); ++i) {
        both[i] = a[i];
    }
    for (Index i = 0; i < b.size(); ++i) {
        both[a.size() + i] = b[i];
    }
    return both;
}

/// a x.
template <class Operator, class S>
Vector<S> applied(const Operator& a, const Vector<S>& x) {
    return a * x;
}

/// a b.
template <class Operator>
Operator product(const Operator& a, const Operator& b) {
    return a * b;
}
template <class S>
Sparse<S> product(const Sparse<S>& a, const Sparse<S>& b) {
    Triplets<S> entries;
    for_each_entry(b, [&](Index k, Index j, const S& value) {
        for (typename Sparse<S>::InnerIterator it(a, k); it; ++it) {
            add_entry(entries, it.row(), j, it.value() * value);
        }
    });
    return assembled(a.rows(), b.cols(), entries);
}

/// [diag(r) a; diag(z) a].
template <class S>
Sparse<S> spread_along(const Vector<S>& r, const Vector<S>& z, const Sparse<S>& a) {
    Triplets<S> entries;
    for_each_entry(a, [&](Index i, Index j, const S& value) {
        add_entry(entries, i, j, value * r[i]);
        add_entry(entries, a.rows() + i, j, value * z[i]);
    });
    return assembled(2 * a.rows(), a.cols(), entries);
}

/// a + b.
template <class Operator>
Operator sum(Operator a, const Operator& b) {
    a += b;
    return a;
}
template <class S>
Sparse<S> sum(const Sparse<S>& a, const Sparse<S>& b) {
    Triplets<S> entries;
    const auto add = [&](Index i, Index j, const S& value) { add_entry(entries, i, j, value); };
    for_each_entry(a, add);
    for_each_entry(b, add);
    return assembled(a.rows(), a.cols(), entries);
}

/// factor a.
template <class Operator, class S>
Operator scaled(const S& factor, Operator a) {
    if constexpr (requires { a *= factor; }) {
        a *= factor;
        return a;
    } else {
        return factor * std::move(a);
    }
}

/// diag(factors) a.
template <class Operator, class S>
Operator rows_scaled(const Vector<S>& factors, const Operator& a) {
    return factors.asDiagonal() * a;
}
template <class S>
Sparse<S> rows_scaled(const Vector<S>& factors, Sparse<S> a) {
    for (Index j = 0; j < a.outerSize(); ++j) {
        for (typename Sparse<S>::InnerIterator it(a, j); it; ++it) {
            it.valueRef() *= factors[it.row()];
        }
    }
    return a;
}

/// A part of m.
template <class S>
Matrix<S> block_of(const Matrix<S>& m, Index row, Index column, Index rows, Index columns) {
    return m.block(row, column, rows, columns);
}

/// Sets a part of m, from `row` and `column` on, to a.
template <class S, class Operator>
void set_block(Matrix<S>& m, Index row, Index column, const Operator& a) {
    const Matrix<S> dense = a;
    m.block(row, column, a.rows(), a.cols()) = dense;
}
template <class S>
void set_block(Matrix<S>& m, Index row, Index column, const Matrix<S>& a) {
    m.block(row, column, a.rows(), a.cols()) = a;
}
template <class S>
void set_block(Matrix<S>& m, Index row, Index column, const Sparse<S>& a) {
    set_block(m, row, column, Matrix<S>(Matrix<S>::Zero(a.rows(), a.cols())));
    for_each_entry(a, [&](Index i, Index j, const S& value) { m(row + i, column + j) = value; });
}

/// Sets the columns of m from `column` on to g a.
template <class S, class Operator>
void set_columns(Matrix<S>& m, Index column, const Matrix<S>& g, const Operator& a) {
    m.middleCols(column, a.cols()) = g * a;
}
template <class S>
void set_columns(Matrix<S>& m, Index column, const Matrix<S>& g, const Sparse<S>& a) {
    m.middleCols(column, a.cols()).setZero();
    for_each_entry(a, [&](Index i, Index j, const S& value) { m.col(column + j) += value * g.col(i); });
}

/// a m.
template <class S, class Operator>
Matrix<S> applied(const Operator& a, const Matrix<S>& m) {
    return a * m;
}
template <class S>
Matrix<S> applied(const Sparse<S>& a, const Matrix<S>& m) {
    Matrix<S> result = Matrix<S>::Zero(a.rows(), m.cols());
    for (Index c = 0; c < m.cols(); ++c) {
        for_each_entry(a, [&](Index i, Index j, const S& value) { result(i, c) += value * m(j, c); });
    }
    return result;
}

}  // namespace axistokes::detail
