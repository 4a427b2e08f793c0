// SPDX-License-Identifier: MIT
// Velocity, flow rate and pressure in a channel whose force densities on wall and particle are known.
#pragma once

#include "panel_curve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axistokes {

template <class Discretization, class Kernel>
class ChannelField {
  public:
    using S = typename Kernel::Scalar;

    /// Wall and particle are shifted by `offset` along z with respect to the coordinates of the evaluation.
    ChannelField(const Discretization& discretization, const Kernel& kernel, const PanelCurve<S>& wall,
                 Vector<S> traction, Meridian<S> particle, Vector<S> force, S offset)
        : discretization_(discretization),
          kernel_(kernel),
          wall_(wall),
          traction_(std::move(traction)),
          particle_(std::move(particle)),
          force_(std::move(force)),
          offset_(offset) {}

    const Vector<S>& wall_traction() const { return traction_; }

    /// Velocities, stacked [r; z], at points off the wall and off the particle's nodes.
    Vector<S> velocity(const Meridian<S>& points) const {
        Meridian<S> local = points;
        local.z.array() -= offset_;
        return wall_.single_layer_at(local, kernel_) * traction_ +
               discretization_.single_layer_at(local, particle_, kernel_) * force_;
    }

    /// Int u_z dA over the cross-section of the given radius at z. The velocity has kinks where the section cuts the
    /// particle: the rule is composite, with intervals that end there.
    S flow_rate(const S& z, const S& radius) const {
        constexpr Index intervals = 6;
        static const GaussLegendreRule<S> rule = gauss_legendre<S>(10);
        std::vector<S> ends = cuts(z - offset_);
        for (Index k = 0; k <= intervals; ++k) {
            ends.push_back(radius * S(k) / S(intervals));
        }
        std::sort(ends.begin(), ends.end());
        const Index n = static_cast<Index>(ends.size() - 1) * rule.nodes.size();
        Meridian<S> points{Vector<S>(n), Vector<S>::Constant(n, z)};
        Vector<S> weight(n);
        Index i = 0;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            for (Index q = 0; q < rule.nodes.size(); ++q, ++i) {
                points.r[i] = ends[k] + (ends[k + 1] - ends[k]) * rule.nodes[q];
                weight[i] = 2 * detail::pi_value<S>() * points.r[i] * (ends[k + 1] - ends[k]) * rule.weights[q];
            }
        }
        return weight.dot(velocity(points).tail(n));
    }

    /// Pressure on the axis at z, up to a constant of the field: a force F at x makes F . (x0 - x)/(4 pi |x0 - x|^3) at
    /// x0. `weight` are the particle's quadrature weights of Int dA; the point must be away from its surface.
    S axis_pressure(const S& z, const Vector<S>& weight) const {
        return axis_pressure(z - offset_, wall_.nodes(), wall_.weights(), traction_) +
               axis_pressure(z - offset_, particle_, weight, force_);
    }

  private:
    static S axis_pressure(const S& z, const Meridian<S>& nodes, const Vector<S>& weight, const Vector<S>& force) {
        using std::sqrt;
        const Index n = nodes.nodes();
        S sum = 0;
        for (Index i = 0; i < n; ++i) {
            const S dz = z - nodes.z[i];
            const S d2 = nodes.r[i] * nodes.r[i] + dz * dz;
            sum += weight[i] * (force[n + i] * dz - force[i] * nodes.r[i]) / (d2 * sqrt(d2));
        }
        return sum / (4 * detail::pi_value<S>());
    }

    /// Radii at which the particle's elements cross a section.
    std::vector<S> cuts(const S& z) const {
        std::vector<S> radii;
        for (Index e = 0; e < particle_.elements(); ++e) {
            const S below = particle_.z[e] - z;
            const S above = particle_.z[e + 1] - z;
            if ((below < S(0)) != (above < S(0))) {
                radii.push_back((above * particle_.r[e] - below * particle_.r[e + 1]) / (above - below));
            }
        }
        return radii;
    }

    const Discretization& discretization_;
    const Kernel& kernel_;
    const PanelCurve<S>& wall_;
    Vector<S> traction_;
    Meridian<S> particle_;
    Vector<S> force_;
    S offset_;
};

}  // namespace axistokes
