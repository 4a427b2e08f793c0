// SPDX-License-Identifier: MIT
// Shear stress and pressure along the wall of a straight tube.
//
// At a distance d from the wall, where u = 0, u_z = a_1 d + a_2 d^2 + ...: the fluid pulls at the wall with the shear
// stress eta a_1 along z, and Stokes' equation there, where u_z does not change along z, gives dp/dz = eta (2 a_2 -
// a_1/Rc).
#pragma once

#include "flow_field.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace axistokes {

/// Along z, relative to the centroid, in kappa/R0^3; the pressure is 0 at the last point.
template <class S>
struct WallStress {
    Vector<S> z;
    Vector<S> shear;
    Vector<S> pressure;
};

/// Around the one body of a scene, up to `beyond` (R0) from its ends, at `points` equally spaced places. Throws
/// InvalidArgument for fewer than 16 points or a scene without a straight tube's wall.
template <class SceneType, class S, class Surface>
WallStress<S> wall_stress(const SceneType& scene, const Configuration<S>& configuration,
                          const Instant<S, Surface>& instant, const S& beyond, Index points = 400) {
    using std::isfinite;
    const S radius = scene.gap({S(0), configuration.position});
    detail::require(isfinite(radius), "tube radius", radius, "finite: the scene has no wall");
    detail::require(points >= 16, "points along the wall", points, "at least 16");
    const Index last = configuration.shape.elements();
    const S low = configuration.shape.z[0] - beyond;
    const S high = configuration.shape.z[last] + beyond;
    const S film = scene.film_thickness(configuration).min;
    // Within a third of the film u_z is a polynomial of low degree; much closer its digits would be lost.
    constexpr Index degree = 5;
    const S depth = std::min(S(film / 3), S(radius / 10));
    Matrix<S> powers(degree, degree);
    Vector<S> distance(degree);
    for (Index i = 0; i < degree; ++i) {
        distance[i] = depth * S(i + 1) / S(degree);
        S power = 1;
        for (Index k = 0; k < degree; ++k) {
            power *= S(i + 1) / S(degree);
            powers(i, k) = power;
        }
    }
    const Matrix<S> coefficients = powers.inverse();
    WallStress<S> result{Vector<S>::LinSpaced(points, low, high), Vector<S>(points), Vector<S>(points)};
    const auto fluid = fluid_velocity(scene, configuration, instant, std::max(S(-low), high));
    Vector<S> slope(points);
    // One distance from the wall at a time.
    Matrix<S> velocity(degree, points);
    for (Index i = 0; i < degree; ++i) {
        const Meridian<S> line{Vector<S>::Constant(points, radius - distance[i]), result.z};
        velocity.row(i) = fluid(line).tail(points).transpose();
    }
    const Matrix<S> a = coefficients * velocity;
    for (Index j = 0; j < points; ++j) {
        result.shear[j] = a(0, j) / depth;
        slope[j] = 2 * a(1, j) / (depth * depth) - result.shear[j] / radius;
    }
    result.pressure[points - 1] = 0;
    const S step = (high - low) / S(points - 1);
    for (Index j = points - 2; j >= 0; --j) {
        result.pressure[j] = result.pressure[j + 1] - step * (slope[j] + slope[j + 1]) / 2;
    }
    return result;
}

}  // namespace axistokes
