// SPDX-License-Identifier: MIT
// What a Driver is told.
#pragma once

#include "../core.hpp"

#include <optional>

namespace axistokes {

/// How to a stationary state: marching until its branch is settled and finishing by Newton's method, marching on where
/// that fails; marching alone; or Newton's method after a few steps.
enum class WayToStationary { automatic, march, newton };

template <class S>
struct DriverParams {
    /// Relative error wanted of velocity and length, which the number of elements follows from; share of the last modes
    /// that goes with it.
    S eps = S(1e-4);
    S unresolved = S(2e-4);
    /// A fixed number of elements.
    std::optional<Index> elements;
    /// The first number that is tried.
    std::optional<Index> first_elements;
    /// The way matters, not only where it ends.
    bool transient = false;
    WayToStationary way = WayToStationary::automatic;
    /// Residual at which Newton's method has converged; then on to round-off.
    S newton_tolerance = S(1e-9);
    bool to_round_off = false;
    /// Relative error allowed in the integrals. A tenth of it is what reached the results in trials (docs/accuracy.md).
    S integrals = S(0);
};

}  // namespace axistokes
