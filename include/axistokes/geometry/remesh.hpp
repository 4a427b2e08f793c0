// SPDX-License-Identifier: MIT
// Redistribution of the nodes along a meridian.
#pragma once

#include "meridian_spline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace axistokes {

/// How closely nodes follow the curvature: the spacing is proportional to 1 / sqrt(1 + (a k)^2), where k is the
/// meridional curvature (in 1/R0) and a = curvature_weight in R0; the root is smoothed over `smoothing` of the curve's
/// length, at least two intervals: what the nodes do not resolve must not move them. 0 gives equal arc lengths.
template <class S>
struct NodeSpacing {
    S curvature_weight = S(0.5);
    S smoothing = S(0.05);
};

namespace detail {

/// Smooths nodal values by one implicit diffusion step of length `width`, with zero slope at the ends.
template <class S>
Vector<S> diffuse(const Vector<S>& t, const Vector<S>& values, const S& width) {
    const Index n = t.size();
    Vector<S> result = values;
    Vector<S> diagonal(n);
    Vector<S> upper(n);
    for (Index i = 0; i < n; ++i) {
        const S below = i > 0 ? S(t[i] - t[i - 1]) : S(t[1] - t[0]);
        const S above = i + 1 < n ? S(t[i + 1] - t[i]) : below;
        S lower = -2 * width * width / (below * (below + above));
        upper[i] = -2 * width * width / (above * (below + above));
        diagonal[i] = S(1) - lower - upper[i];
        if (i == 0) {
            upper[i] += lower;
            continue;
        }
        if (i + 1 == n) {
            lower += upper[i];
        }
        const S factor = lower / diagonal[i - 1];
        diagonal[i] -= factor * upper[i - 1];
        result[i] -= factor * result[i - 1];
    }
    result[n - 1] /= diagonal[n - 1];
    for (Index i = n - 2; i >= 0; --i) {
        result[i] = (result[i] - upper[i] * result[i + 1]) / diagonal[i];
    }
    return result;
}

/// The wanted density of nodes per unit of the spline's parameter, up to a factor, for a mesh of `elements` intervals.
template <class S>
CubicSpline<S> node_density(const MeridianSpline<S>& spline, const NodeSpacing<S>& spacing, Index elements) {
    using std::sqrt;
    const Vector<S>& t = spline.parameters();
    Vector<S> density(t.size());
    for (Index i = 0; i < t.size(); ++i) {
        const S k = spacing.curvature_weight * spline.at_node(i).meridional_curvature();
        density[i] = sqrt(S(1) + k * k);
    }
    density = diffuse<S>(t, density, std::max<S>(spacing.smoothing, S(2) / S(elements)) * t[t.size() - 1]);
    for (Index i = 0; i < t.size(); ++i) {
        density[i] *= spline.at_node(i).speed();
    }
    return CubicSpline<S>(t, density, Parity::even);
}

}  // namespace detail

/// Largest ratio between a node interval and the one `spacing` asks for, or its inverse; 1 is perfect.
template <class S>
S spacing_distortion(const Meridian<S>& meridian, const NodeSpacing<S>& spacing) {
    const CubicSpline<S> density = detail::node_density(MeridianSpline<S>(meridian), spacing, meridian.elements());
    S total = 0;
    S smallest = density.integral(0, S(1));
    S largest = smallest;
    for (Index e = 0; e < density.elements(); ++e) {
        const S part = density.integral(e, S(1));
        total += part;
        smallest = std::min(smallest, part);
        largest = std::max(largest, part);
    }
    const S mean = total / S(density.elements());
    return std::max(S(largest / mean), S(mean / smallest));
}

/// `elements` elements on the same curve (its cubic spline), spaced as `spacing` asks for. The shape moves by
/// O(h^4) at most. `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too. Throws
/// InvalidArgument for fewer than 8 elements.
template <class S>
Meridian<S> redistribute(const Meridian<S>& meridian, const NodeSpacing<S>& spacing, Index elements,
                         Meridian<S>& carried) {
    detail::require_elements(elements);
    const MeridianSpline<S> spline(meridian);
    const CubicSpline<S> density = detail::node_density(spline, spacing, elements);
    S total = 0;
    for (Index e = 0; e < density.elements(); ++e) {
        total += density.integral(e, S(1));
    }
    std::vector<std::pair<Index, S>> places;  // an element and the local coordinate on it
    Index e = 0;
    S before = 0;
    for (Index i = 1; i < elements; ++i) {
        const S wanted = total * S(i) / S(elements);
        while (e + 1 < density.elements() && before + density.integral(e, S(1)) < wanted) {
            before += density.integral(e, S(1));
            ++e;
        }
        // The density is positive: the integral is monotonic in x, and bisection cannot fail.
        S low = 0;
        S high = 1;
        for (int k = 0; k < std::numeric_limits<S>::digits + 2; ++k) {
            const S middle = (low + high) / 2;
            (before + density.integral(e, middle) < wanted ? low : high) = middle;
        }
        places.emplace_back(e, low);
    }
    const auto nodes_at = [&](const Meridian<S>& shape, const auto& point) {
        Meridian<S> result{Vector<S>::Zero(elements + 1), Vector<S>(elements + 1)};
        result.z[0] = shape.z[0];
        result.z[elements] = shape.z[shape.nodes() - 1];
        for (Index i = 1; i < elements; ++i) {
            const auto& [element, x] = places[static_cast<std::size_t>(i - 1)];
            const Point<S> p = point(element, x);
            result.r[i] = p.r;
            result.z[i] = p.z;
        }
        return result;
    };
    if (carried.z.size() > 0) {
        const CubicSpline<S> r(spline.parameters(), carried.r, Parity::odd);
        const CubicSpline<S> z(spline.parameters(), carried.z, Parity::even);
        carried = nodes_at(carried, [&](Index element, const S& x) {
            return Point<S>{r.value(element, x), z.value(element, x)};
        });
    }
    return nodes_at(meridian, [&](Index element, const S& x) { return spline.at(element, x).position; });
}
template <class S>
Meridian<S> redistribute(const Meridian<S>& meridian, const NodeSpacing<S>& spacing, Index elements) {
    Meridian<S> nothing;
    return redistribute(meridian, spacing, elements, nothing);
}

}  // namespace axistokes
