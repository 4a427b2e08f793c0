// SPDX-License-Identifier: MIT
// Panels on the boundary of a finite piece of a channel: the wall, between two hemispherical ends.
//
// The ends carry the velocity of the undisturbed Poiseuille flow, which solves Stokes' equations on any surface: a
// hemisphere joins the wall without the corner, and the singular traction in it, that a flat disc would make.
#pragma once

#include "../geometry/meridian.hpp"
#include "panel_curve.hpp"
#include "profile.hpp"
#include "wall_params.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace axistokes {

template <ChannelProfile Profile>
class ChannelMesh {
  public:
    using Scalar = typename Profile::Scalar;
    using Params = WallMeshParams<Scalar>;

    /// A mesh for a particle, in the profile's coordinates (those of the particle's centre in a straight tube).
    ChannelMesh(const Profile& profile, const Params& params, const Meridian<Scalar>& particle)
        : profile_(profile),
          params_(params),
          curve_(params.nodes_per_panel.value_or(default_nodes(params.tolerance)),
                 quadrature_tolerance(params.tolerance)) {
        const Scalar low = particle.z.minCoeff();
        const Scalar high = particle.z.maxCoeff();
        lower_ = (profile.uniform ? low : std::min(low, Scalar(profile.begin()))) - margin(profile, params, low);
        upper_ = (profile.uniform ? high : std::max(high, Scalar(profile.end()))) + margin(profile, params, high);
        breaks_ = params.grading == WallGrading::quadratic ? quadratic_breaks((low + high) / 2)
                                                           : equidistributed_breaks(particle);
        if (!params.panels) {
            resolve_profile();
        }
        append_panels();
    }

    const PanelCurve<Scalar>& curve() const { return curve_; }
    /// The wall reaches from z = lower() to upper(), the ends a radius further.
    Scalar lower() const { return lower_; }
    Scalar upper() const { return upper_; }
    Index wall_panels() const { return breaks_.size() - 1; }

    /// Velocity at the nodes, stacked: Poiseuille flow of flow rate 1 on the ends, 0 on the wall.
    Vector<Scalar> boundary_velocity() const {
        const Index n = curve_.size();
        const Meridian<Scalar>& nodes = curve_.nodes();
        Vector<Scalar> g = Vector<Scalar>::Zero(2 * n);
        for (Index i = 0; i < n; ++i) {
            if (nodes.z[i] < lower_ || nodes.z[i] > upper_) {
                const Scalar radius = channel_radius(profile_, nodes.z[i] < lower_ ? lower_ : upper_);
                const Scalar x = nodes.r[i] / radius;
                g[n + i] = 2 / (detail::pi_value<Scalar>() * radius * radius) * (Scalar(1) - x * x);
            }
        }
        return g;
    }

    /// Whether the mesh still suits the particle: its panels are short enough where the particle is near, and the ends
    /// far enough away.
    bool suits(const Meridian<Scalar>& particle) const {
        const Scalar low = particle.z.minCoeff();
        const Scalar high = particle.z.maxCoeff();
        const Scalar slack = Scalar(0.9);
        if (!(low - lower_ >= slack * margin(profile_, params_, low) &&
              upper_ - high >= slack * margin(profile_, params_, high))) {
            return false;
        }
        if (params_.panels) {
            return true;
        }
        const Scalar film = film_thickness(particle);
        for (Index i = 0; i + 1 < breaks_.size(); ++i) {
            const Scalar middle = (breaks_[i] + breaks_[i + 1]) / 2;
            if (breaks_[i + 1] - breaks_[i] > Scalar(1.5) * wanted_length(middle, particle, film, Scalar(0))) {
                return false;
            }
        }
        return true;
    }

    /// The profile, continued by straight tubes.
    static Scalar channel_radius(const Profile& profile, const Scalar& z) {
        return profile.radius(profile.uniform ? z : std::clamp(z, Scalar(profile.begin()), Scalar(profile.end())));
    }

    /// Wall needed beyond a particle in a tube of the given radius: a perturbation that an end cuts off comes back to
    /// the particle after as long a way.
    static Scalar default_length(const Scalar& radius, const Scalar& tolerance) {
        using std::log;
        return radius * log(Scalar(1) / tolerance) / Scalar(2 * detail::tube_decay);
    }

  private:
    /// Panels of one radius resolve the tube's eigenfunctions.
    static constexpr double length_over_radius = 1.0;
    /// More than that would not fit into memory: the matrices are dense.
    static constexpr double most_panels = 10000;
    /// Longest panel over the particle's distance.
    static constexpr double length_over_distance = 3.0;
    /// The particle may move by this much, in wall radii, before the mesh has to follow it.
    static constexpr double slack_over_radius = 0.3;

    /// A thin film multiplies errors of the velocity, by a thousand at a gap of 1 % of the radius.
    static Scalar quadrature_tolerance(const Scalar& tolerance) {
        return std::max(Scalar(tolerance / 1000), Scalar(16 * std::numeric_limits<Scalar>::epsilon()));
    }

    static Index default_nodes(const Scalar& tolerance) {
        using std::ceil;
        using std::log10;
        return 3 + static_cast<Index>(ceil(static_cast<double>(-log10(tolerance))));
    }

    static Scalar channel_slope(const Profile& profile, const Scalar& z) {
        return profile.uniform || (z > profile.begin() && z < profile.end()) ? Scalar(profile.slope(z)) : Scalar(0);
    }

    static Scalar margin(const Profile& profile, const Params& params, const Scalar& z) {
        return params.length.value_or(default_length(channel_radius(profile, z), params.tolerance));
    }

    /// Smallest radial distance of the particle's nodes from the wall.
    Scalar film_thickness(const Meridian<Scalar>& particle) const {
        Scalar film = std::numeric_limits<Scalar>::infinity();
        for (Index i = 0; i < particle.nodes(); ++i) {
            film = std::min(film, Scalar(channel_radius(profile_, particle.z[i]) - particle.r[i]));
        }
        return film;
    }

    /// For the particle as it is, or after it has moved by at most `slack`.
    Scalar wanted_length(const Scalar& z, const Meridian<Scalar>& particle, const Scalar& film,
                         const Scalar& slack) const {
        using std::abs;
        using std::sqrt;
        const Scalar radius = channel_radius(profile_, z);
        Scalar nearest = radius * radius;
        for (Index i = 0; i < particle.nodes(); ++i) {
            const Scalar dr = radius - particle.r[i];
            const Scalar dz = std::max(Scalar(0), Scalar(abs(z - particle.z[i]) - slack));
            nearest = std::min(nearest, Scalar(dr * dr + dz * dz));
        }
        const Scalar slope = channel_slope(profile_, z);
        // A particle that has moved comes no closer to the wall than it is now.
        const Scalar distance = std::max(Scalar(sqrt(nearest)), film);
        const Scalar arc = std::min(Scalar(length_over_radius) * radius, Scalar(length_over_distance) * distance);
        return arc / sqrt(Scalar(1) + slope * slope);
    }

    Vector<Scalar> equidistributed_breaks(const Meridian<Scalar>& particle) const {
        using std::ceil;
        constexpr Index samples = 2000;
        const Scalar step = (upper_ - lower_) / Scalar(samples);
        const Scalar film = film_thickness(particle);
        Vector<Scalar> cumulative(samples + 1);
        cumulative[0] = 0;
        for (Index i = 0; i < samples; ++i) {
            const Scalar z = lower_ + step * (Scalar(i) + Scalar(0.5));
            const Scalar radius = channel_radius(profile_, z);
            const Scalar slack = profile_.uniform ? Scalar(0) : Scalar(slack_over_radius) * radius;
            const Scalar length =
                params_.grading == WallGrading::uniform ? Scalar(1) : wanted_length(z, particle, film, slack);
            cumulative[i + 1] = cumulative[i] + step / length;
        }
        const auto wanted = static_cast<double>(ceil(cumulative[samples]));
        if (!params_.panels && !(wanted < most_panels)) {
            throw SimulationFailure("the wall would take " + detail::text(wanted) +
                                    " panels: from z = " + detail::text(lower_) + " to " + detail::text(upper_) +
                                    ", for a film of " + detail::text(film));
        }
        const Index count = params_.panels.value_or(static_cast<Index>(wanted) + 1);
        Vector<Scalar> breaks(count + 1);
        breaks[0] = lower_;
        breaks[count] = upper_;
        Index i = 0;
        for (Index k = 1; k < count; ++k) {
            const Scalar target = cumulative[samples] * Scalar(k) / Scalar(count);
            while (cumulative[i + 1] < target) {
                ++i;
            }
            breaks[k] = lower_ + step * (Scalar(i) + (target - cumulative[i]) / (cumulative[i + 1] - cumulative[i]));
        }
        return breaks;
    }

    /// z - centre = +-(half length) s^2 with equal steps of s.
    Vector<Scalar> quadratic_breaks(const Scalar& centre) const {
        const Index count = *params_.panels;
        Vector<Scalar> breaks(count + 1);
        for (Index k = 0; k <= count; ++k) {
            const Scalar s = 2 * Scalar(k) / Scalar(count) - Scalar(1);
            breaks[k] = centre + (s < Scalar(0) ? -(centre - lower_) : upper_ - centre) * s * s;
        }
        return breaks;
    }

    CurvePoint<Scalar> wall_point(const Scalar& begin, const Scalar& end, const Scalar& t) const {
        const Scalar length = end - begin;
        const Scalar z = begin + t * length;
        CurvePoint<Scalar> x;
        x.position = {channel_radius(profile_, z), z};
        x.first = {channel_slope(profile_, z) * length, length};
        return x;
    }

    /// Halves panels until the polynomials through their nodes follow the profile, the length of arc included.
    void resolve_profile() {
        if (!profile_.uniform) {
            constexpr int deepest = 12;
            std::vector<Scalar> refined{breaks_[0]};
            const auto add = [&](const auto& self, const Scalar& begin, const Scalar& end, int depth) -> void {
                if (depth < deepest && !resolved(begin, end)) {
                    const Scalar middle = (begin + end) / 2;
                    self(self, begin, middle, depth + 1);
                    self(self, middle, end, depth + 1);
                } else {
                    refined.push_back(end);
                }
            };
            for (Index i = 0; i + 1 < breaks_.size(); ++i) {
                add(add, breaks_[i], breaks_[i + 1], 0);
            }
            breaks_ = Eigen::Map<const Vector<Scalar>>(refined.data(), static_cast<Index>(refined.size()));
        }
    }

    bool resolved(const Scalar& begin, const Scalar& end) const {
        using std::abs;
        PanelCurve<Scalar> panel = curve_;
        panel.append([&](const Scalar& t) { return wall_point(begin, end, t); });
        for (const double t : {0.0, 0.1, 0.27, 0.41, 0.59, 0.73, 0.9, 1.0}) {
            const Scalar exact = wall_point(begin, end, Scalar(t)).speed();
            if (!(abs(panel.speed(0, Scalar(t)) - exact) <= params_.tolerance * exact)) {
                return false;
            }
        }
        return true;
    }

    void append_panels() {
        using std::cos;
        using std::sin;
        // Two resolve the flow as well as panels of one radius on the wall do; a mesh asked for refines them too.
        const Index cap_panels = params_.panels ? std::max<Index>(2, wall_panels() / 8) : 2;
        const Scalar turn = detail::pi_value<Scalar>() / Scalar(2 * cap_panels);
        const auto cap = [&](const Scalar& start, const Scalar& centre, const Scalar& radius) {
            for (Index k = 0; k < cap_panels; ++k) {
                curve_.append([&](const Scalar& t) {
                    const Scalar angle = start + turn * (Scalar(k) + t);
                    CurvePoint<Scalar> x;
                    x.position = {radius * sin(angle), centre - radius * cos(angle)};
                    x.first = {radius * cos(angle) * turn, radius * sin(angle) * turn};
                    return x;
                });
            }
        };
        cap(Scalar(0), lower_, channel_radius(profile_, lower_));
        for (Index i = 0; i < wall_panels(); ++i) {
            curve_.append([&](const Scalar& t) { return wall_point(breaks_[i], breaks_[i + 1], t); });
        }
        cap(detail::pi_value<Scalar>() / 2, upper_, channel_radius(profile_, upper_));
    }

    Profile profile_;
    Params params_;
    PanelCurve<Scalar> curve_;
    Scalar lower_{};
    Scalar upper_{};
    Vector<Scalar> breaks_;
};

}  // namespace axistokes
