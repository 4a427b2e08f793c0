// SPDX-License-Identifier: MIT
// Storage that the assembly of a single layer fills for one target after the other.
#pragma once

#include "../core.hpp"

#include <cstddef>
#include <vector>

namespace axistokes::detail {

/// Kernel entries of one target with many sources.
template <class S>
struct KernelEntries {
    std::vector<S> rr, rz, zr, zz;

    KernelArrays<S> arrays(Index n) {
        for (std::vector<S>* entry : {&rr, &rz, &zr, &zz}) {
            entry->resize(static_cast<std::size_t>(n));
        }
        return {rr.data(), rz.data(), zr.data(), zz.data()};
    }
    KernelBlock<S> operator[](std::size_t i) const { return {rr[i], rz[i], zr[i], zz[i]}; }
};

/// Two rows of the matrix, those of one target, accumulated in four contiguous vectors.
template <class S>
struct KernelRow {
    explicit KernelRow(Index n) : rr(n), rz(n), zr(n), zz(n) {}

    void set_zero() {
        for (Vector<S>* entry : {&rr, &rz, &zr, &zz}) {
            entry->setZero();
        }
    }
    /// Adds `weight` M to the entries of node j.
    void add(Index j, const S& weight, const KernelBlock<S>& m) {
        rr[j] += weight * m.rr;
        rz[j] += weight * m.rz;
        zr[j] += weight * m.zr;
        zz[j] += weight * m.zz;
    }
    /// Stores the rows of target i of `targets`, times `scale`.
    void store(const S& scale, Index i, Index targets, Matrix<S>& g) const {
        g.row(i).head(rr.size()) = scale * rr;
        g.row(i).tail(rr.size()) = scale * rz;
        g.row(targets + i).head(rr.size()) = scale * zr;
        g.row(targets + i).tail(rr.size()) = scale * zz;
    }

    Vector<S> rr, rz, zr, zz;
};

}  // namespace axistokes::detail
