// SPDX-License-Identifier: MIT
// Natural logarithm of float and double without branches, calls or tables, so that compilers vectorise loops over it
// (std::log in a loop is a scalar call unless -ffast-math is given).
//
// Method of fdlibm's e_log.c: x = 2^k f with f in [sqrt(1/2), sqrt(2)), log f = 2 artanh s, s = (f - 1)/(f + 1).
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

namespace axistokes::detail {

/// log(x), within 1 unit in the last place or so, for normal x > 0; other x give an unspecified finite value.
inline double fast_log(double x) noexcept {
    constexpr std::uint64_t kSqrtHalf = 0x3FE6A09E667F3BCDULL;
    constexpr std::uint64_t kBias = 1024ULL << 52;           // keeps the shifted exponent positive
    constexpr std::uint64_t kTwo52 = 0x4330000000000000ULL;  // 2^52: its low bits hold an integer
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t shifted = bits - kSqrtHalf + kBias;
    const std::uint64_t exponent = shifted >> 52;
    const double k = std::bit_cast<double>(exponent | kTwo52) - (0x1p52 + 1024.0);
    const double f = std::bit_cast<double>(bits - (exponent << 52) + kBias) - 1.0;

    // Taylor coefficients 1/(2j+1) corrected for the interval: fdlibm's Lg1..Lg7, error below 2^-58.
    const double s = f / (2.0 + f);
    const double y = s * s;
    const double tail =
        y * (0.6666666666666735130 +
             y * (0.3999999999940941908 +
                  y * (0.2857142874366239149 +
                       y * (0.2222219843214978396 +
                            y * (0.1818357216161805012 + y * (0.1531383769920937332 + y * 0.1479819860511658591))))));
    const double half_square = 0.5 * f * f;
    constexpr double kLn2High = 6.93147180369123816490e-01;
    constexpr double kLn2Low = 1.90821492927058770002e-10;
    return k * kLn2High - ((half_square - (s * (half_square + tail) + k * kLn2Low)) - f);
}

/// As above, for float: the series is cut where it falls below the type's precision.
inline float fast_log(float x) noexcept {
    constexpr std::uint32_t kSqrtHalf = 0x3F3504F3U;
    constexpr std::uint32_t kBias = 128U << 23;
    constexpr std::uint32_t kTwo23 = 0x4B000000U;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t shifted = bits - kSqrtHalf + kBias;
    const std::uint32_t exponent = shifted >> 23;
    const float k = std::bit_cast<float>(exponent | kTwo23) - (0x1p23F + 128.0F);
    const float f = std::bit_cast<float>(bits - (exponent << 23) + kBias) - 1.0F;

    // musl's e_logf.c, error below 2^-34.
    const float s = f / (2.0F + f);
    const float y = s * s;
    const float tail = y * (0.66666662693F + y * (0.40000972152F + y * (0.28498786688F + y * 0.24279078841F)));
    const float half_square = 0.5F * f * f;
    constexpr float kLn2High = 6.9313812256e-01F;
    constexpr float kLn2Low = 9.0580006145e-06F;
    return k * kLn2High - ((half_square - (s * (half_square + tail) + k * kLn2Low)) - f);
}

}  // namespace axistokes::detail
