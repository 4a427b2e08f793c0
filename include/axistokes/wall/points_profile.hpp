// SPDX-License-Identifier: MIT
// A channel profile through given points.
#pragma once

#include "profile.hpp"

// Boost 1.74's pchip calls isnan without a namespace: in this order.
// clang-format off
#include <math.h>  // NOLINT(modernize-deprecated-headers)
#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/special_functions/fpclassify.hpp>  // which pchip.hpp of Boost 1.74 uses and does not include
// clang-format on

#include <vector>

namespace axistokes {

/// Monotone cubic spline (PCHIP: no extrema but at the points) through (z_i, r_i), level at both ends.
template <class S = double>
class PointsProfile {
  public:
    using Scalar = S;
    static constexpr bool uniform = false;

    /// Throws InvalidArgument unless there are at least 4 points, equally many z and r, z increases and r > 0, all
    /// finite.
    PointsProfile(std::vector<S> z, std::vector<S> r)
        : begin_(checked(z, r)), end_(z.back()), spline_(std::move(z), std::move(r), S(0), S(0)) {}

    S radius(const S& z) const { return spline_(z); }
    S slope(const S& z) const { return spline_.prime(z); }
    S begin() const { return begin_; }
    S end() const { return end_; }

  private:
    static S checked(const std::vector<S>& z, const std::vector<S>& r) {
        using std::isfinite;
        detail::require(z.size() >= 4, "number of profile points", z.size(), "at least 4");
        detail::require(r.size() == z.size(), "number of profile radii", r.size(), "that of the z coordinates");
        for (std::size_t i = 0; i < z.size(); ++i) {
            const std::string point = " of profile point " + std::to_string(i);
            detail::require(isfinite(z[i]) && (i == 0 || z[i] > z[i - 1]), ("z" + point).c_str(), z[i],
                            "finite and increasing");
            detail::require_length(("r" + point).c_str(), r[i]);
        }
        return z.front();
    }

    S begin_, end_;
    boost::math::interpolators::pchip<std::vector<S>> spline_;
};

}  // namespace axistokes
