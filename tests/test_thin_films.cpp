// SPDX-License-Identifier: MIT
// A sphere that almost fills a tube: its drag against the lubrication expansion of Bungay & Brenner (Int. J. Multiphase
// Flow 1 (1973) 25), and against multipoles, with tolerances relative to what the wall's cancellation leaves.
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <cmath>

namespace {

using namespace axistokes;

/// Drag over 6 pi eta R0 U of a sphere of radius `ratio` times the tube's; its last digits are those of a fit.
double lubrication(double ratio) {
    const double pi = detail::pi_value<double>();
    const double gap = 1 - ratio;
    const double leading =
        9.0 / 4 * pi * pi * std::sqrt(2.0) * std::pow(gap, -2.5) * (1 - 73.0 / 60 * gap + 77293.0 / 50400 * gap * gap);
    const double rest = -22.5083 + ratio * (-5.6117 + ratio * (-0.3363 + ratio * (-1.216 + ratio * 1.647)));
    return (leading + rest) / (6 * pi);
}

double drag(double ratio, double tolerance, Index n) {
    TubeKernel<double>::Params kernel;
    kernel.tolerance = tolerance;
    SpectralMeridian<double>::Params series;
    series.tolerance = tolerance;
    Scene scene(TubeKernel<double>(1 / ratio, kernel), SpectralMeridian<double>(series), RigidBody<double>(),
                Gravity<double>(4.5), DenseLU<double>());
    Meridian<double> sphere{Vector<double>(n + 1), Vector<double>(n + 1)};
    for (Index i = 0; i <= n; ++i) {
        const double t = detail::pi_value<double>() * double(i) / double(n);
        sphere.r[i] = i == 0 || i == n ? 0 : std::sin(t);
        sphere.z[i] = -std::cos(t);
    }
    return -1 / scene.evaluate(Configuration<double>{sphere, 0.0, {}}, 0.0).velocity;
}

}  // namespace

TEST_CASE("thin films: the drag of a sphere agrees with the lubrication expansion") {
    CHECK(drag(0.98, 1e-12, 81) == Approx(lubrication(0.98)).epsilon(2e-5));
    CHECK(drag(0.99, 1e-12, 121) == Approx(lubrication(0.99)).epsilon(3e-6));
    CHECK(drag(0.995, 1e-12, 181) == Approx(lubrication(0.995)).epsilon(3e-6));
}

TEST_CASE("thin films: the drag of a sphere agrees with multipoles, which have no small gap to expand in") {
    // SphereInTube<long double> (sphere_in_tube_reference.hpp), bounds of 1e-14 to 3e-12: test_tube_sphere "[.report]".
    CHECK(drag(0.95, 1e-12, 81) == Approx(2808.80151288).epsilon(1e-9));
    CHECK(drag(0.98, 1e-12, 121) == Approx(28752.0464283).epsilon(1e-8));
    CHECK(drag(0.99, 1e-12, 181) == Approx(164604.775009).epsilon(1e-7));
    CHECK(drag(0.995, 1e-12, 271) == Approx(936778.669779).epsilon(1e-6));
}

TEST_CASE("thin films: tolerances are relative to what the wall leaves, a drag factor's part") {
    const double exact = drag(0.98, 1e-12, 81);
    // The error is at most a sixth of the drag factor times the tolerance.
    for (const double tolerance : {1e-5, 1e-6, 1e-8}) {
        CHECK(std::abs(drag(0.98, tolerance, 81) / exact - 1) < tolerance * exact / 6);
    }
    CHECK(std::abs(drag(0.98, 1e-4, 81) / exact - 1) > 1e-3);
}
