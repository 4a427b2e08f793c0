// SPDX-License-Identifier: MIT
// How a particle's disturbance of the flow in a tube decays along it (the paper's Fig. 12).
#pragma once

#include "report.hpp"
#include <axistokes/geometry/meridian.hpp>
#include <axistokes/quadrature/gauss_legendre.hpp>

#include <Eigen/LU>

#include <cmath>
#include <deque>

namespace examples {

/// Tables of the disturbance at distances z from the particle's centre, in tube radii: its mean over a section,
/// (1/Rc) Int |u'| dr / scale (the paper's equation 54 with a constant for u_inf), and its decay fitted there.
///
/// Far away u' = Re[A(r) exp(-k z/Rc)], k = a + i b the first root of the tube's eigenvalue equation, so that
///   u'(z + 2h) - 2 exp(-a h) cos(b h) u'(z + h) + exp(-2 a h) u'(z) = 0   (h in tube radii):
/// least squares over the points of three sections give a and b, whatever A.
class DecayReport {
  public:
    static constexpr double step = 0.25;  // in tube radii

    explicit DecayReport(const std::string& directory)
        : report_(directory, "wall_decay.csv", "case,tube_radius,z_over_tube_radius,mean,rate,wave_number") {}

    /// `disturbance(points)` are the velocities, stacked, at points with z relative to the centre. From `nearest` to
    /// `farthest` tube radii, on the side given by the sign of `direction`.
    template <class Disturbance>
    void add(const std::string& name, double tube_radius, double scale, double nearest, double farthest, int direction,
             const Disturbance& disturbance) {
        using axistokes::Vector;
        static const auto rule = axistokes::gauss_legendre<double>(20);
        const axistokes::Index n = rule.nodes.size();
        std::deque<Vector<double>> sections;
        const int count = static_cast<int>(std::lround((farthest - nearest) / step));
        for (int k = 0; k <= count; ++k) {
            const double z = nearest + k * step;
            const Vector<double> u = disturbance(axistokes::Meridian<double>{
                tube_radius * rule.nodes, Vector<double>::Constant(n, direction * z * tube_radius)});
            const double mean =
                rule.weights.dot((u.head(n).array().square() + u.tail(n).array().square()).sqrt().matrix()) / scale;
            sections.push_back(u);
            double rate = std::nan("");
            double wave_number = rate;
            if (sections.size() == 3) {
                fit(sections, rate, wave_number);
                sections.pop_front();
            }
            report_.row(name, tube_radius, direction * z, mean, rate, wave_number);
        }
    }

  private:
    static void fit(const std::deque<axistokes::Vector<double>>& u, double& rate, double& wave_number) {
        axistokes::Matrix<double> known(u[0].size(), 2);
        known << u[1], -u[0];
        const axistokes::Vector<double> c =
            (known.transpose() * known).partialPivLu().solve(known.transpose() * u[2]).eval();
        rate = -std::log(c[1]) / (2 * step);
        wave_number = std::acos(c[0] / (2 * std::sqrt(c[1]))) / step;
    }

    Report report_;
};

}  // namespace examples
