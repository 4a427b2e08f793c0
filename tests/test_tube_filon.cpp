// SPDX-License-Identifier: MIT
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/tube_filon.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <vector>

namespace {

using namespace axistokes;

template <class F>
std::vector<double> samples(std::size_t intervals, double a, double b, const F& f) {
    std::vector<double> values;
    for (std::size_t i = 0; i <= intervals; ++i) {
        values.push_back(f(a + (b - a) * static_cast<double>(i) / static_cast<double>(intervals)));
    }
    return values;
}

template <class Kernel>
Kernel with_tolerance(double tolerance) {
    typename Kernel::Params params;
    params.tolerance = tolerance;
    return Kernel(1.0, params);
}

double largest(const KernelBlock<double>& m) {
    return std::max({std::abs(m.rr), std::abs(m.rz), std::abs(m.zr), std::abs(m.zz)});
}

/// Velocity on the wall over that in free space, at its worst over |z| <= 5 (the paper's Fig. 4).
template <class Kernel>
double wall_error(const Kernel& kernel, double gap) {
    double worst = 0;
    for (double z = 0; z <= 5; z += 0.25) {
        const Point<double> source{1 - gap, z};
        worst = std::max(worst, largest(kernel.total({1, 0}, source)) / largest(kernel.singular({1, 0}, source)));
    }
    return worst;
}

}  // namespace

TEST_CASE("Filon's rule is exact for parabolas at any frequency", "[filon]") {
    const auto parabola = [](double x) { return 1 + 2 * x - 3 * x * x; };
    const auto f = samples(8, 0.3, 2.1, parabola);
    for (const double k : {0.0, 1e-6, 0.1, 0.5, 0.88, 0.9, 3.0, 50.0, 1e4}) {
        // Antiderivatives of (1 + 2x - 3x^2) e^(ikx) by parts; Simpson's rule at k = 0.
        const auto result = filon(f, 0.3, 2.1, k);
        double cosine = 0;
        double sine = 0;
        if (k < 0.2) {
            const int n = 4000;
            for (int i = 0; i < n; ++i) {
                const double x = 0.3 + 1.8 * (i + 0.5) / n;
                cosine += 1.8 / n * parabola(x) * std::cos(k * x);
                sine += 1.8 / n * parabola(x) * std::sin(k * x);
            }
            INFO("k = " << k);
            CHECK(result.cosine == Approx(cosine).epsilon(2e-7));
            CHECK(result.sine == Approx(sine).epsilon(2e-6).margin(1e-12));
            continue;
        }
        const auto cosine_at = [&](double x) {
            return parabola(x) * std::sin(k * x) / k + (2 - 6 * x) * std::cos(k * x) / (k * k) +
                   6 * std::sin(k * x) / (k * k * k);
        };
        const auto sine_at = [&](double x) {
            return -parabola(x) * std::cos(k * x) / k + (2 - 6 * x) * std::sin(k * x) / (k * k) -
                   6 * std::cos(k * x) / (k * k * k);
        };
        cosine = cosine_at(2.1) - cosine_at(0.3);
        sine = sine_at(2.1) - sine_at(0.3);
        INFO("k = " << k);
        CHECK(result.cosine == Approx(cosine).epsilon(1e-9).margin(1e-13));
        CHECK(result.sine == Approx(sine).epsilon(1e-9).margin(1e-13));
    }
}

TEST_CASE("Filon's rule converges at fourth order", "[filon]") {
    const auto error = [](std::size_t intervals) {
        const auto f = samples(intervals, 0, 2, [](double x) { return std::exp(-x); });
        const double k = 7;
        // Int_0^2 e^(-x) cos(7 x) dx
        const double exact = (1 + std::exp(-2.0) * (k * std::sin(2 * k) - std::cos(2 * k))) / (1 + k * k);
        return std::abs(filon(f, 0.0, 2.0, k).cosine - exact);
    };
    CHECK(test::observed_order(error(32), error(64)) > 3.8);
}

TEST_CASE("Gauss-Laguerre rules are exact to degree 2n - 1", "[laguerre]") {
    const auto rule = gauss_laguerre<double>(8);
    double factorial = 1;
    for (int k = 0; k <= 15; ++k) {
        if (k > 0) {
            factorial *= k;
        }
        CHECK(rule.weights.dot(rule.nodes.array().pow(k).matrix()) == Approx(factorial).epsilon(1e-11));
    }
}

TEST_CASE("the paper's quadrature agrees with the tube kernel", "[tube filon]") {
    const auto exact = with_tolerance<TubeKernel<double>>(1e-13);
    for (const double tolerance : {1e-4, 1e-6}) {
        const auto filon_kernel = with_tolerance<TubeFilonKernel<double>>(tolerance);
        for (const auto& [target, source] : std::vector<std::pair<Point<double>, Point<double>>>{
                 {{0.2, 0}, {0.5, 0.3}}, {{0, 0}, {0.7, -1.2}}, {{0.9, 0}, {0.95, 0}}, {{0.9, 1}, {0.97, 1.1}}}) {
            const auto a = exact.correction(target, source);
            const auto b = filon_kernel.correction(target, source);
            INFO("tolerance " << tolerance << ", source at r = " << source.r);
            const KernelBlock<double> minus{-a.rr, -a.rz, -a.zr, -a.zz};
            CHECK(largest(b + minus) < tolerance * largest(a));
        }
    }
}

TEST_CASE("both tube kernels give the same single layer", "[tube filon]") {
    LinearElements<double>::Params params;
    params.tolerance = 1e-3;
    const LinearElements<double> elements(params);
    const auto shape = spheroid<double>(0.6, 0.9, 8);
    const Matrix<double> a = elements.single_layer(shape, with_tolerance<TubeKernel<double>>(1e-6));
    const Matrix<double> b = elements.single_layer(shape, with_tolerance<TubeFilonKernel<double>>(1e-4));
    CHECK((a - b).cwiseAbs().maxCoeff() < 1e-3 * a.cwiseAbs().maxCoeff());
}

TEST_CASE("the Filon kernel refuses bad input", "[tube filon]") {
    CHECK(test::mentions(test::refusal([] { TubeFilonKernel<double>(1.0, {}, 3); }), "most points", "3", "64"));
    CHECK(test::mentions(test::refusal([] { TubeFilonKernel<double>(-1.0); }), "tube radius", "-1", "> 0"));
}

TEST_CASE("print the velocity on the wall against the source's distance from it", "[.report]") {
    std::cout << "gap/Rc     tube 1e-13   tube 1e-8   filon 1e-8   filon 1e-4\n";
    for (const double gap : {0.5, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
        std::cout << std::setw(6) << gap << std::scientific << std::setprecision(1) << std::setw(15)
                  << wall_error(with_tolerance<TubeKernel<double>>(1e-13), gap) << std::setw(12)
                  << wall_error(with_tolerance<TubeKernel<double>>(1e-8), gap) << std::setw(13)
                  << wall_error(with_tolerance<TubeFilonKernel<double>>(1e-8), gap) << std::setw(13)
                  << wall_error(with_tolerance<TubeFilonKernel<double>>(1e-4), gap) << std::endl
                  << std::defaultfloat << std::setprecision(6);
    }
}
