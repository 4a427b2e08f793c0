// SPDX-License-Identifier: MIT
// Necks of a meridian.
#pragma once

#include <axistokes/geometry/meridian.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace examples {

struct Neck {
    double z;
    double radius;
    double element;  // length of the longer element beside it
};

/// The thinnest place between two wider ones.
inline std::optional<Neck> thinnest_neck(const axistokes::Meridian<double>& shape) {
    std::optional<Neck> thinnest;
    for (axistokes::Index i = 2; i + 2 < shape.nodes(); ++i) {
        if (shape.r[i] > shape.r[i - 1] || shape.r[i] > shape.r[i + 1] || (thinnest && shape.r[i] > thinnest->radius)) {
            continue;
        }
        const auto length = [&](axistokes::Index e) {
            return std::hypot(shape.r[e + 1] - shape.r[e], shape.z[e + 1] - shape.z[e]);
        };
        thinnest = Neck{shape.z[i], shape.r[i], std::max(length(i - 1), length(i))};
    }
    return thinnest;
}

}  // namespace examples
