// SPDX-License-Identifier: MIT
// What the motion of an interface conserves, and how a shape that has lost it gets it back: the one owner of both.
#pragma once

#include "measures.hpp"
#include "meridian.hpp"

#include <optional>

namespace axistokes {

/// Volume, and area if the interface keeps that.
template <class S>
struct Conserved {
    S volume{};
    std::optional<S> area;

    Conserved() = default;
    Conserved(const Measures<S>& measures, bool keeps_area)
        : volume(measures.volume), area(keeps_area ? std::optional<S>(measures.area) : std::nullopt) {}

    /// False if that fails; the shape then is of no use.
    template <class Discretization>
    bool restore(const Discretization& discretization, Meridian<S>& shape) const {
        return area ? discretization.restore(shape, *area, volume) : discretization.restore(shape, volume);
    }
};

}  // namespace axistokes
