// SPDX-License-Identifier: MIT
// K and E against the textbook arithmetic-geometric mean in 100 digits (Abramowitz & Stegun 17.6) and Boost.Math.
#include "catch.hpp"
#include <axistokes/special/elliptic.hpp>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using axistokes::elliptic_ke;
using axistokes::EllipticKE;
using axistokes::Index;
using Real50 = boost::multiprecision::cpp_bin_float_50;
using Real100 = boost::multiprecision::cpp_bin_float_100;

EllipticKE<Real100> reference(const Real100& m1) {
    Real100 a = 1;
    Real100 b = sqrt(m1);
    Real100 half_power = 0.5;
    Real100 sum = (1 - m1) / 2;
    while (abs(a - b) > Real100(1e-95) * a) {
        const Real100 c = (a - b) / 2;
        const Real100 mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
        half_power *= 2;
        sum += half_power * c * c;
    }
    const Real100 k = acos(Real100(-1)) / (2 * a);
    return {k, k * (1 - sum)};
}

/// Log-uniform values of m1 (and of 1 - m1) plus the end points of the range.
template <class S>
std::vector<S> sample(double smallest_exponent, int count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> wide(smallest_exponent, 0.0);
    std::uniform_real_distribution<double> near(-17.0, 0.0);
    std::uniform_real_distribution<double> flat(0.0, 1.0);
    std::vector<S> values{S(1), S(0.5), S(0.25), S(std::pow(10.0, smallest_exponent))};
    for (int i = 0; i < count; ++i) {
        values.push_back(static_cast<S>(std::pow(10.0, wide(random))));
        values.push_back(static_cast<S>(1.0 - std::pow(10.0, near(random))));
        values.push_back(static_cast<S>(flat(random)));
    }
    std::erase_if(values, [](const S& x) { return !(x > S(0)); });
    return values;
}

struct WorstError {
    double k = 0;  // in units of the type's epsilon
    double e = 0;
};

template <class S>
double error_in_eps(const S& value, const Real100& exact) {
    const Real100 relative = abs(Real100(value) - exact) / abs(exact);
    return static_cast<double>(relative / Real100(std::numeric_limits<S>::epsilon()));
}

template <class S>
WorstError worst_error(const std::vector<S>& m1, bool batched) {
    const auto n = static_cast<Index>(m1.size());
    std::vector<S> k(m1.size());
    std::vector<S> e(m1.size());
    if (batched) {
        elliptic_ke(m1.data(), n, k.data(), e.data());
    }
    WorstError worst;
    for (std::size_t i = 0; i < m1.size(); ++i) {
        const EllipticKE<S> value = batched ? EllipticKE<S>{k[i], e[i]} : elliptic_ke<S>(m1[i]);
        const EllipticKE<Real100> exact = reference(Real100(m1[i]));
        worst.k = std::max(worst.k, error_in_eps(value.k, exact.k));
        worst.e = std::max(worst.e, error_in_eps(value.e, exact.e));
    }
    return worst;
}

template <class S>
void check_all(double smallest_exponent, int count) {
    const std::vector<S> m1 = sample<S>(smallest_exponent, count);
    for (const bool batched : {false, true}) {
        const WorstError worst = worst_error(m1, batched);
        CHECK(worst.k < 4);
        CHECK(worst.e < 4);
    }
}

template <class S>
void print_row(const std::string& name, double smallest_exponent, int count) {
    const std::vector<S> m1 = sample<S>(smallest_exponent, count);
    for (const bool batched : {false, true}) {
        const WorstError worst = worst_error(m1, batched);
        std::cout << std::setw(12) << name << std::setw(8) << (batched ? "array" : "scalar") << std::fixed
                  << std::setprecision(2) << std::setw(10) << worst.k << std::setw(10) << worst.e << '\n';
    }
}

}  // namespace

TEST_CASE("K and E are accurate to 4 eps over the whole range", "[elliptic]") {
    SECTION("float") {
        check_all<float>(-37, 500);
    }
    SECTION("double") {
        check_all<double>(-300, 500);
    }
    SECTION("long double") {
        check_all<long double>(-300, 300);
    }
    SECTION("50 digits") {
        check_all<Real50>(-300, 100);
    }
}

TEST_CASE("K and E agree with Boost.Math", "[elliptic]") {
    for (const double m1 : {1e-9, 1e-3, 0.1, 0.37, 0.5, 0.9, 1.0}) {
        const Real50 modulus = sqrt(1 - Real50(m1));
        const EllipticKE<Real50> value = elliptic_ke(Real50(m1));
        CHECK(abs(value.k / boost::math::ellint_1(modulus) - 1) < Real50(1e-38));
        CHECK(abs(value.e / boost::math::ellint_2(modulus) - 1) < Real50(1e-38));
    }
}

TEST_CASE("K and E at m = 0 and next to m = 1", "[elliptic]") {
    const double half_pi = std::acos(0.0);
    CHECK(elliptic_ke(1.0).k == Approx(half_pi).epsilon(1e-15));
    CHECK(elliptic_ke(1.0).e == Approx(half_pi).epsilon(1e-15));
    CHECK(elliptic_ke(1e-300).k == Approx(std::log(4.0) + 150 * std::log(10.0)).epsilon(1e-15));
    CHECK(elliptic_ke(1e-300).e == Approx(1.0).epsilon(1e-15));
    CHECK(elliptic_ke(std::numeric_limits<double>::denorm_min()).e == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("the logarithmic split of h and c reproduces them", "[elliptic]") {
    for (const double m1 : {1e-200, 1e-8, 0.01, 0.2, 0.5, 0.8, 0.97, 1.0}) {
        const Real50 x(m1);
        const auto exact = axistokes::ring_integrals<Real50>(x);
        const auto wide = axistokes::ring_split<Real50>(x);
        CHECK(abs(wide.ph - log(x) * wide.qh - exact.h) < Real50(1e-46) * exact.h);
        CHECK(abs(wide.pc - x * log(x) * wide.qc - exact.c) < Real50(1e-46) * exact.c);
        const auto fit = axistokes::ring_split<double>(m1);
        CHECK(fit.ph - std::log(m1) * fit.qh == Approx(static_cast<double>(exact.h)).epsilon(1e-14));
        CHECK(fit.pc - m1 * std::log(m1) * fit.qc == Approx(static_cast<double>(exact.c)).epsilon(1e-14));
    }
}

TEST_CASE("arguments outside (0, 1] are refused", "[elliptic]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double m1 : {0.0, -0.0, -1e-9, 1.0000001, nan, std::numeric_limits<double>::infinity()}) {
        CHECK_THROWS_AS(elliptic_ke(m1), axistokes::InvalidArgument);
    }
    CHECK_THROWS_AS(elliptic_ke(Real50(0)), axistokes::InvalidArgument);
    CHECK_THROWS_WITH(elliptic_ke(2.0), "complementary parameter m1 = 2: must be in (0, 1]");
}

TEST_CASE("report: worst relative errors of K and E in units of eps", "[.report]") {
    std::cout << "K and E, worst relative error / eps\n" << std::setw(30) << "K" << std::setw(10) << "E" << '\n';
    print_row<float>("float", -37, 20000);
    print_row<double>("double", -300, 20000);
    print_row<long double>("long double", -300, 5000);
    print_row<Real50>("50 digits", -300, 1000);
}
