// SPDX-License-Identifier: MIT
#include "catch.hpp"
#include <axistokes/special/bessel.hpp>
#include <axistokes/special/bessel_table.hpp>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace {

using axistokes::scaled_bessel_i;
using axistokes::scaled_bessel_k;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

constexpr std::size_t kFunctions = 7;
constexpr std::array<const char*, kFunctions> kNames{"I0", "I1", "I2", "I0-I1", "K0", "K1", "K1-K0"};

template <class X>
std::array<X, kFunctions> all(const X& x) {
    const auto i = scaled_bessel_i<X>(x);
    const auto k = scaled_bessel_k<X>(x);
    return {i.i0, i.i1, i.i2, i.difference, k.k0, k.k1, k.difference};
}

/// Boost's functions are not scaled: the range is limited, and the differences lose digits that 50 digits can spare.
std::array<Wide, kFunctions> boost_all(const Wide& x) {
    using boost::math::cyl_bessel_i;
    using boost::math::cyl_bessel_k;
    const Wide down = exp(-x);
    const Wide up = exp(x);
    const Wide i0 = cyl_bessel_i(0, x) * down;
    const Wide i1 = cyl_bessel_i(1, x) * down;
    const Wide k0 = cyl_bessel_k(0, x) * up;
    const Wide k1 = cyl_bessel_k(1, x) * up;
    return {i0, i1, Wide(cyl_bessel_i(2, x) * down), Wide(i0 - i1), k0, k1, Wide(k1 - k0)};
}

template <class S>
std::array<double, kFunctions> worst_errors(double lowest, double highest) {
    std::array<double, kFunctions> worst{};
    for (double exponent = lowest; exponent <= highest; exponent += (highest - lowest) / 700) {
        const S x = S(std::pow(10.0L, static_cast<long double>(exponent)));
        const auto exact = all<Wide>(Wide(x));
        const auto computed = all<S>(x);
        for (std::size_t f = 0; f < kFunctions; ++f) {
            if (exact[f] >= Wide((std::numeric_limits<S>::min)())) {
                const Wide error = abs(Wide(computed[f]) / exact[f] - 1) / std::numeric_limits<S>::epsilon();
                worst[f] = std::max(worst[f], static_cast<double>(error));
            }
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("50 digits agree with Boost's Bessel functions", "[bessel]") {
    for (double exponent = -12; exponent < 2.3; exponent += 0.11) {
        const Wide x = pow(Wide(10), Wide(exponent));
        const auto ours = all<Wide>(x);
        const auto boosts = boost_all(x);
        for (std::size_t f = 0; f < kFunctions; ++f) {
            INFO(kNames[f] << " at 10^" << exponent);
            // The subtraction in the reference loses as many digits as x has.
            CHECK(abs(ours[f] / boosts[f] - 1) < Wide(1e-46) * (1 + x));
        }
    }
}

TEST_CASE("double, float and long double are good to a few eps from 1e-300 to 1e6", "[bessel]") {
    for (const double error : worst_errors<double>(-300, 6)) {
        CHECK(error < 20);
    }
    for (const double error : worst_errors<double>(-2, 3)) {
        CHECK(error < 20);
    }
    for (const double error : worst_errors<long double>(-3, 6)) {
        CHECK(error < 20);
    }
    for (const double error : worst_errors<float>(-30, 5)) {
        CHECK(error < 20);
    }
}

TEST_CASE("print the worst errors of the Bessel functions", "[.report]") {
    const auto print = [](const std::string& type, const std::array<double, kFunctions>& worst) {
        std::cout << std::setw(12) << type;
        for (const double error : worst) {
            std::cout << std::setw(8) << std::setprecision(2) << error;
        }
        std::cout << '\n';
    };
    std::cout << "worst relative error / eps\n            ";
    for (const char* name : kNames) {
        std::cout << std::setw(8) << name;
    }
    std::cout << '\n';
    print("float", worst_errors<float>(-30, 5));
    print("double", worst_errors<double>(-300, 6));
    print("double, mid", worst_errors<double>(-2, 3));
    print("long double", worst_errors<long double>(-3, 6));
}

TEST_CASE("on the ray arg x = pi/4 Wronskian and recurrence hold", "[bessel]") {
    using C = std::complex<double>;
    for (double exponent = -8; exponent < 6; exponent += 0.013) {
        const C x = std::pow(10.0, exponent) * C(std::sqrt(0.5), std::sqrt(0.5));
        const auto i = scaled_bessel_i(x);
        const auto k = scaled_bessel_k(x);
        INFO("|x| = 10^" << exponent);
        CHECK(std::abs((i.i0 * k.k1 + i.i1 * k.k0) * x - 1.0) < 5e-15);
        CHECK(std::abs(i.i0 - 2.0 * i.i1 / x - i.i2) < 1e-15 * std::max(1.0, 1 / std::abs(x)) * std::abs(i.i0) * 10);
        const std::complex<long double> wide(x.real(), x.imag());
        const auto exact = all<std::complex<long double>>(wide);
        const auto computed = all<C>(x);
        for (std::size_t f = 0; f < kFunctions; ++f) {
            const std::complex<long double> value(computed[f].real(), computed[f].imag());
            CHECK(std::abs(value - exact[f]) < 1e-14L * std::abs(exact[f]));
        }
    }
}

TEST_CASE("the parts without logarithm add up", "[bessel]") {
    for (const double x : {1e-12, 1e-3, 0.5, 2.0, 3.9}) {
        const axistokes::LogFreeK<double> smooth(x);
        const axistokes::detail::BesselSeries<double> i(x);
        const auto k = scaled_bessel_k(x);
        CHECK(smooth.k0 - std::log(x) * i.i0 == Approx(std::exp(-x) * k.k0).epsilon(1e-13));
        CHECK(1 / x + smooth.k1 + std::log(x) * i.i1 == Approx(std::exp(-x) * k.k1).epsilon(1e-13));
    }
}

TEST_CASE("tables reproduce the functions along both rays", "[bessel]") {
    using C = std::complex<double>;
    const C diagonal(std::sqrt(0.5), std::sqrt(0.5));
    const axistokes::detail::ScaledITable<double> real(1.0);
    const axistokes::detail::ScaledITable<C> turned(diagonal);
    const axistokes::detail::ScaledITable<float> single(1.0F);
    for (double x = 0; x < 1e5; x = 1.01 * x + 1e-3) {
        INFO("x = " << x);
        const auto exact = scaled_bessel_i<long double>(x);
        CHECK(std::abs(real(x).i0 / exact.i0 - 1) < 2e-15L);
        CHECK(std::abs(real(x).difference / exact.difference - 1) < 2e-15L);
        if (x >= axistokes::detail::ScaledITable<double>::cells) {
            const auto beyond = real.beyond(1 / x);
            CHECK(std::abs(beyond.i0 / std::sqrt(x) / exact.i0 - 1) < 2e-15L);
            CHECK(std::abs(beyond.difference / (x * std::sqrt(x)) / exact.difference - 1) < 2e-15L);
        }
        const auto exact_single = scaled_bessel_i<double>(static_cast<double>(static_cast<float>(x)));
        CHECK(std::abs(static_cast<double>(single(static_cast<float>(x)).i0) / exact_single.i0 - 1) < 1e-6);
        const auto exact_turned = scaled_bessel_i<std::complex<long double>>(std::complex<long double>(diagonal) *
                                                                             static_cast<long double>(x));
        CHECK(std::abs(std::complex<long double>(turned(x).i0) / exact_turned.i0 - 1.0L) < 2e-15L);
        CHECK(std::abs(std::complex<long double>(turned(x).difference) / exact_turned.difference - 1.0L) < 2e-15L);
    }
}
