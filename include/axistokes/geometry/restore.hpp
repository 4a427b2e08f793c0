// SPDX-License-Identifier: MIT
// Correction of the area and the volume that time stepping has lost.
#pragma once

#include "meridian_spline.hpp"

#include <Eigen/QR>

namespace axistokes {

/// Displaces the nodes by (a + b H) n, the smallest normal displacement that changes area and volume, until both have
/// the values given (to `tolerance`, relative; measured on the spline through the nodes). On a sphere, where the two
/// cannot be changed independently, the volume and area are restored in the least-squares sense.
/// Returns false if Newton's iteration does not get there.
template <class S>
bool restore_area_and_volume(Meridian<S>& meridian, const S& area, const S& volume, const S& tolerance) {
    using std::abs;
    for (int iteration = 0; iteration < 8; ++iteration) {
        const MeridianSpline<S> spline(meridian);
        const Measures<S> now = spline.measures();
        Eigen::Matrix<S, 2, 1> defect{(area - now.area) / area, (volume - now.volume) / volume};
        if (abs(defect[0]) <= tolerance && abs(defect[1]) <= tolerance) {
            return true;
        }
        // dA = Int 2H phi dA, dV = Int phi dA for a normal displacement phi.
        S total_curvature = 0;
        S squared_curvature = 0;
        const S two_pi = 2 * detail::pi_value<S>();
        spline.for_each_quadrature_point([&](const CurvePoint<S>& p, const S& weight) {
            const S da = two_pi * p.position.r * p.speed() * weight;
            const S h = (p.meridional_curvature() + p.normal().r / p.position.r) / 2;
            total_curvature += h * da;
            squared_curvature += h * h * da;
        });
        Eigen::Matrix<S, 2, 2> jacobian;
        jacobian << 2 * total_curvature / area, 2 * squared_curvature / area, now.area / volume,
            total_curvature / volume;
        // Of fixed size, in float, it makes g++ 12 warn inside Eigen.
        Eigen::CompleteOrthogonalDecomposition<Matrix<S>> decomposition;
        decomposition.setThreshold(S(1e-5));
        decomposition.compute(jacobian);
        const Vector<S> change = decomposition.solve(Vector<S>(defect));
        if (decomposition.rank() < 2 && change.cwiseAbs().maxCoeff() < tolerance) {
            return true;
        }
        for (Index i = 0; i < meridian.nodes(); ++i) {
            const CurvePoint<S> p = spline.at_node(i);
            const bool pole = i == 0 || i + 1 == meridian.nodes();
            const S k = p.meridional_curvature();
            const S h = pole ? k : S((k + p.normal().r / p.position.r) / 2);
            const S shift = change[0] + change[1] * h;
            if (!pole) {
                meridian.r[i] += shift * p.normal().r;
            }
            meridian.z[i] += shift * p.normal().z;
        }
        if (!meridian.r.allFinite() || !meridian.z.allFinite()) {
            return false;
        }
    }
    return false;
}

}  // namespace axistokes
