// SPDX-License-Identifier: MIT
// Meridians with other numbers of nodes of the same relative spacing, by trigonometric series in the node's index.
#pragma once

#include "meridian.hpp"
#include "trigonometric.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace axistokes::detail {

/// From nodal values of series of one degree to those of another one, the parameter kept: cut off or continued by 0.
/// Exact for as long as the series is; nodes that are spaced smoothly are enough for fast decay of its amplitudes.
template <class S>
struct SeriesTransfer {
    Matrix<S> even;
    Matrix<S> odd;

    SeriesTransfer(Index from, Index to) {
        using std::cos;
        using std::sin;
        const auto basis = TrigonometricBasis<S>::of_degree(from);
        const Index modes = std::min(from, to) + 1;
        Matrix<S> cosines(to + 1, modes);
        Matrix<S> sines(to + 1, modes);
        for (Index i = 0; i <= to; ++i) {
            for (Index k = 0; k < modes; ++k) {
                const S angle = pi_value<S>() * S(i * k % (2 * to)) / S(to);
                cosines(i, k) = cos(angle);
                sines(i, k) = i == 0 || i == to ? S(0) : S(sin(angle));
            }
        }
        even = cosines * basis->even_coefficients().topRows(modes);
        odd = sines * basis->odd_coefficients().topRows(modes);
    }

    static std::shared_ptr<const SeriesTransfer> between(Index from, Index to) {
        return computed_once<SeriesTransfer>(from, to);
    }
};

template <class S>
Meridian<S> resampled(const Meridian<S>& shape, Index elements) {
    const auto there = SeriesTransfer<S>::between(shape.elements(), elements);
    return {there->odd * shape.r, there->even * shape.z};
}

}  // namespace axistokes::detail
