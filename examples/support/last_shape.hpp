// SPDX-License-Identifier: MIT
// The shape a run ended with, as a table.
#pragma once

#include <axistokes/io/csv.hpp>

#include <optional>
#include <vector>

namespace examples {

/// Without an instant (the last shape may be the cause of a failure) at least the nodes.
template <class Instant>
std::vector<axistokes::Column<double>> last_shape_columns(const axistokes::Configuration<double>& configuration,
                                                          const std::optional<Instant>& instant) {
    if (instant) {
        return axistokes::shape_columns(configuration, *instant);
    }
    return {{"r", configuration.shape.r}, {"z", configuration.shape.z}};
}

}  // namespace examples
