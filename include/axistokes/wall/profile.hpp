// SPDX-License-Identifier: MIT
// Profiles of channels: the wall's distance from the axis, r(z), in units of R0.
#pragma once

#include "../core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace axistokes {

/// ChannelProfile: `radius(z)` and its derivative `slope(z)` for begin() <= z <= end(). Outside, the channel goes on as
/// a straight tube of radius radius(begin()) or radius(end()). `uniform` marks the straight tube, which has no such
/// range.
template <class P>
concept ChannelProfile = requires(const P& profile, typename P::Scalar z) {
    { profile.uniform } -> std::convertible_to<bool>;
    { profile.radius(z) } -> std::convertible_to<typename P::Scalar>;
    { profile.slope(z) } -> std::convertible_to<typename P::Scalar>;
    { profile.begin() } -> std::convertible_to<typename P::Scalar>;
    { profile.end() } -> std::convertible_to<typename P::Scalar>;
};

/// Where the profile is narrowest, of many samples; the middle one of equal ones. Throws InvalidArgument where the
/// radius is not positive and finite.
template <ChannelProfile Profile>
typename Profile::Scalar narrowest_section(const Profile& profile) {
    using S = typename Profile::Scalar;
    constexpr int samples = 2000;
    S narrowest = std::numeric_limits<S>::infinity();
    S first = 0;
    S last = 0;
    for (int i = 0; i <= samples; ++i) {
        const S x = S(i) / S(samples);
        const S z = profile.begin() * (S(1) - x) + profile.end() * x;
        const S radius = profile.radius(z);
        detail::require_length(("profile radius at z = " + std::to_string(static_cast<double>(z))).c_str(), radius);
        if (radius < narrowest) {
            narrowest = radius;
            first = z;
        }
        if (radius == narrowest) {
            last = z;
        }
    }
    return (first + last) / 2;
}

/// The radius there.
template <ChannelProfile Profile>
typename Profile::Scalar narrowest_radius(const Profile& profile) {
    return profile.radius(narrowest_section(profile));
}

/// r(z) = radius.
template <class S = double>
class StraightTube {
  public:
    using Scalar = S;
    static constexpr bool uniform = true;

    /// Throws InvalidArgument unless the radius is positive and finite.
    explicit StraightTube(S radius) : radius_(radius) { detail::require_length("tube radius", radius); }

    S radius(const S&) const { return radius_; }
    S slope(const S&) const { return S(0); }
    S begin() const { return S(0); }
    S end() const { return S(0); }

  private:
    S radius_;
};

/// A throat of constant radius around z = 0 between wide ends. The transitions are polynomials with three continuous
/// derivatives: with x = (|z| - length/2) / transition in [0, 1], r = throat + (wide - throat) x^4 (35 - 84 x + 70 x^2
/// - 20 x^3).
template <class S = double>
class Pore {
  public:
    using Scalar = S;
    static constexpr bool uniform = false;

    /// Throws InvalidArgument unless 0 < throat <= wide, length >= 0 and transition > 0, all finite.
    Pore(S throat, S wide, S length, S transition)
        : throat_(throat), wide_(wide), length_(length), transition_(transition) {
        using std::isfinite;
        detail::require_length("throat radius", throat);
        detail::require(wide >= throat, "radius of the wide ends", wide, "finite and at least the throat's");
        detail::require_length("radius of the wide ends", wide);
        detail::require(length >= S(0) && isfinite(length), "length of the throat", length, ">= 0 and finite");
        detail::require_length("length of the transition", transition);
    }

    S radius(const S& z) const {
        const S x = coordinate(z);
        return throat_ + (wide_ - throat_) * x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x)));
    }
    S slope(const S& z) const {
        const S x = coordinate(z);
        const S y = x * (S(1) - x);
        return (z < S(0) ? -140 : 140) * (wide_ - throat_) * y * y * y / transition_;
    }
    S begin() const { return -end(); }
    S end() const { return length_ / 2 + transition_; }

  private:
    S coordinate(const S& z) const {
        using std::abs;
        return std::clamp(S((abs(z) - length_ / 2) / transition_), S(0), S(1));
    }

    S throat_, wide_, length_, transition_;
};

/// A smooth narrowing around z = 0: r = wide - (wide - throat) (1 - (z/half_length)^2)^4 for |z| < half_length.
template <class S = double>
class Constriction {
  public:
    using Scalar = S;
    static constexpr bool uniform = false;

    /// Throws InvalidArgument unless 0 < throat <= wide and half_length > 0, all finite.
    Constriction(S throat, S wide, S half_length) : throat_(throat), wide_(wide), half_length_(half_length) {
        detail::require_length("throat radius", throat);
        detail::require(wide >= throat, "radius of the wide ends", wide, "finite and at least the throat's");
        detail::require_length("radius of the wide ends", wide);
        detail::require_length("half length of the constriction", half_length);
    }

    S radius(const S& z) const {
        const S b = bump(z);
        return wide_ - (wide_ - throat_) * b * b * b * b;
    }
    S slope(const S& z) const {
        const S b = bump(z);
        return 8 * (wide_ - throat_) * b * b * b * z / (half_length_ * half_length_);
    }
    S begin() const { return -half_length_; }
    S end() const { return half_length_; }

  private:
    S bump(const S& z) const {
        const S x = z / half_length_;
        return std::max(S(0), S(S(1) - x * x));
    }

    S throat_, wide_, half_length_;
};

/// r(z) and dr/dz given as functions on [begin, end].
template <class S, class Radius, class Slope>
class CallableProfile {
  public:
    using Scalar = S;
    static constexpr bool uniform = false;

    /// Throws InvalidArgument unless begin < end, where the radius is not positive and finite, and where the slope is
    /// not its derivative, as far as samples tell.
    CallableProfile(S begin, S end, Radius radius, Slope slope)
        : begin_(begin), end_(end), radius_(std::move(radius)), slope_(std::move(slope)) {
        using std::isfinite;
        detail::require(isfinite(begin), "begin of the profile", begin, "finite");
        detail::require(end > begin && isfinite(end), "end of the profile", end, "finite and beyond its begin");
        narrowest_radius(*this);
        check_slope();
    }

    S radius(const S& z) const { return radius_(z); }
    S slope(const S& z) const { return slope_(z); }
    S begin() const { return begin_; }
    S end() const { return end_; }

  private:
    void check_slope() const {
        using std::abs;
        using std::cbrt;
        constexpr int samples = 200;
        const S step = cbrt(std::numeric_limits<S>::epsilon()) * (end_ - begin_);
        for (int i = 0; i < samples; ++i) {
            const S z = begin_ + (end_ - begin_) * (S(i) + S(0.5)) / S(samples);
            const S chord = (radius_(z + step) - radius_(z - step)) / (2 * step);
            const S given = slope_(z);
            const std::string slope = "profile slope at z = " + std::to_string(static_cast<double>(z));
            const std::string accepted = "the radius' derivative, " + std::to_string(static_cast<double>(chord));
            detail::require(abs(given - chord) <= S(1e-2) * (S(1) + abs(chord)), slope.c_str(), given,
                            accepted.c_str());
        }
    }

    S begin_, end_;
    Radius radius_;
    Slope slope_;
};

template <class S, class Radius, class Slope>
CallableProfile(S, S, Radius, Slope) -> CallableProfile<S, Radius, Slope>;

}  // namespace axistokes
