// SPDX-License-Identifier: MIT
// Types shared by every header: dense vectors and matrices, points of the meridian half-plane, 2x2 kernel blocks, and
// the errors the library throws.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace axistokes {

/// Of the library.
inline constexpr const char* version = "0.1.0";

using Index = Eigen::Index;

template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// A point of the meridian half-plane: r >= 0 is the distance to the axis, z runs along it (both in units of R0).
template <class S>
struct Point {
    S r{};
    S z{};
};

/// A kernel with images, or a wall: it tells a point's distance from the wall, on the axis of a tube its radius.
template <class T, class S>
concept HasGap = requires(const T& wall, const Point<S>& point) {
    { wall.gap(point) } -> std::convertible_to<S>;
};

/// The four entries of an axisymmetric Green function M_ab(x0, x): first index target velocity, second source force.
template <class S>
struct KernelBlock {
    S rr{};
    S rz{};
    S zr{};
    S zz{};

    friend KernelBlock operator+(const KernelBlock& a, const KernelBlock& b) {
        return {a.rr + b.rr, a.rz + b.rz, a.zr + b.zr, a.zz + b.zz};
    }
};

/// Views of four arrays of equal length that receive kernel entries, one per source point.
template <class S>
struct KernelArrays {
    S* rr = nullptr;
    S* rz = nullptr;
    S* zr = nullptr;
    S* zz = nullptr;
};

/// Bad input. The message names the argument, the value it had and the accepted range.
class InvalidArgument : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

/// A computation that cannot go on (NaN, self-intersection, step too small); the message gives the cause.
class SimulationFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A computation that was asked to stop: nothing is wrong with it.
class SimulationStopped : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace detail {

template <class S>
S pi_value() {
    if constexpr (std::is_floating_point_v<S>) {
        return std::numbers::pi_v<S>;
    } else {
        using std::acos;
        static const S value = acos(S(-1));
        return value;
    }
}

/// Numbers that Eigen maps. The order in which it adds them up depends on where packets begin, and results must not
/// depend on where in memory they lie.
template <class S>
using AlignedNumbers = std::vector<S, Eigen::aligned_allocator<S>>;

template <class T>
std::string text(const T& value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

/// Throws InvalidArgument unless `ok`. Written so that NaN fails every comparison a caller passes in.
template <class T>
void require(bool ok, const char* argument, const T& value, const char* accepted) {
    if (ok) {
        return;
    }
    std::ostringstream message;
    message.precision(17);
    message << argument << " = " << value << ": must be " << accepted;
    throw InvalidArgument(message.str());
}

/// Throws InvalidArgument unless a length is positive and finite, as are products of eight of its size or its
/// inverse's.
template <class S>
void require_length(const char* argument, const S& value) {
    using std::isfinite;
    using std::sqrt;
    require(value > S(0) && isfinite(value), argument, value, "> 0 and finite");
    const S largest = sqrt(sqrt(sqrt(std::numeric_limits<S>::max())));
    const bool representable = value <= largest && value >= S(1) / largest;
    require(representable, argument, value, ("from " + text(S(1) / largest) + " to " + text(largest)).c_str());
}

/// Throws InvalidArgument unless the value is a relative error that the type can tell.
template <class S>
void require_tolerance(const char* argument, const S& value) {
    require(value >= std::numeric_limits<S>::epsilon() && value <= S(0.1), argument, value, "in [eps, 0.1]");
}

}  // namespace detail
}  // namespace axistokes
