// SPDX-License-Identifier: MIT
// Gauss-Legendre rules and their logarithmic product rules against exact moments.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/quadrature/gauss_legendre.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>

namespace {

using axistokes::gauss_legendre;
using axistokes::GaussLegendreRule;
using axistokes::GaussLegendreTable;
using axistokes::Index;
using axistokes::Vector;
using axistokes::test::mentions;
using axistokes::test::refusal;
using Real50 = boost::multiprecision::cpp_bin_float_50;

/// Int of t^k with the given weights.
template <class S>
S moment(const GaussLegendreRule<S>& rule, const Vector<S>& weights, Index k) {
    S sum = 0;
    for (Index i = 0; i < rule.nodes.size(); ++i) {
        S power = 1;
        for (Index j = 0; j < k; ++j) {
            power *= rule.nodes[i];
        }
        sum += weights[i] * power;
    }
    return sum;
}

/// Largest errors of the moments each rule integrates exactly, in units of the type's epsilon.
template <class S>
void check_exactness(Index most_nodes, double bound) {
    using std::abs;
    const S unit = std::numeric_limits<S>::epsilon();
    for (Index n = 1; n <= most_nodes; ++n) {
        INFO(n << " nodes");
        const GaussLegendreRule<S> rule = gauss_legendre<S>(n);
        S worst = 0;
        for (Index k = 0; k <= 2 * n - 1; ++k) {
            worst = std::max(worst, S(abs(moment<S>(rule, rule.weights, k) - S(1) / S(k + 1))));
        }
        CHECK(static_cast<double>(worst / unit) < bound);
        worst = 0;
        for (Index k = 0; k <= n - 1; ++k) {
            worst = std::max(worst, S(abs(moment<S>(rule, rule.log_weights, k) + S(1) / S((k + 1) * (k + 1)))));
        }
        CHECK(static_cast<double>(worst / unit) < bound);
    }
}

}  // namespace

TEST_CASE("n nodes integrate degree 2n - 1 exactly, and degree n - 1 times the logarithm", "[quadrature]") {
    SECTION("float") {
        check_exactness<float>(24, 16);
    }
    SECTION("double") {
        check_exactness<double>(40, 16);
    }
    SECTION("long double") {
        check_exactness<long double>(40, 16);
    }
    SECTION("50 digits") {
        check_exactness<Real50>(20, 16);
    }
}

TEST_CASE("one degree more has the error of theory", "[quadrature]") {
    // Int t^2n - sum = (n!)^4 / ((2n + 1) (2n)!^2), the square of the monic Legendre polynomial's norm.
    for (Index n = 1; n <= 8; ++n) {
        const auto rule = gauss_legendre<long double>(n);
        const long double exact = 1.0L / static_cast<long double>(2 * n + 1);
        const double error = static_cast<double>(exact - moment<long double>(rule, rule.weights, 2 * n));
        const double x = static_cast<double>(n);
        CHECK(error == Approx(std::pow(std::tgamma(x + 1), 4) / ((2 * x + 1) * std::pow(std::tgamma(2 * x + 1), 2)))
                           .epsilon(1e-6));
    }
}

TEST_CASE("nodes ascend inside (0, 1) and mirror each other", "[quadrature]") {
    for (const Index n : {1, 2, 7, 40, 100}) {
        const auto rule = gauss_legendre<double>(n);
        CHECK(rule.nodes[0] > 0);
        CHECK(rule.nodes[n - 1] < 1);
        for (Index i = 0; i < n; ++i) {
            CHECK((i == 0 || rule.nodes[i] > rule.nodes[i - 1]));
            CHECK(std::abs(rule.nodes[i] + rule.nodes[n - 1 - i] - 1) < 1e-15);
            CHECK(rule.weights[i] > 0);
            CHECK(rule.weights[i] == Approx(rule.weights[n - 1 - i]).epsilon(1e-12));
        }
    }
}

TEST_CASE("the product rule converges for log(t) times a smooth function", "[quadrature]") {
    // Int_0^1 cos(t) log(t) dt = -Si(1).
    const auto rule = gauss_legendre<double>(12);
    double sum = 0;
    for (Index i = 0; i < 12; ++i) {
        sum += rule.log_weights[i] * std::cos(rule.nodes[i]);
    }
    CHECK(sum == Approx(-0.94608307036718301494).epsilon(1e-13));
}

TEST_CASE("a table holds the rules it says", "[quadrature]") {
    const GaussLegendreTable<double> table(9);
    CHECK(table.largest() == 9);
    for (Index n = 1; n <= 9; ++n) {
        CHECK(table[n].nodes == gauss_legendre<double>(n).nodes);
    }
}

TEST_CASE("a rule without nodes is refused", "[quadrature]") {
    for (const Index n : {0, -3}) {
        CHECK(mentions(refusal([n] { gauss_legendre<double>(n); }), "number of quadrature nodes", std::to_string(n),
                       "at least 1"));
    }
}
