// SPDX-License-Identifier: MIT
// Fourth-order curvatures and bending energy against the spheroid in closed form.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/geometry/curvature.hpp>

#include <algorithm>
#include <cmath>

namespace {

using axistokes::bending_energy;
using axistokes::Index;
using axistokes::Meridian;
using axistokes::principal_curvatures;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::Spheroid;

struct CurvatureError {
    double meridional = 0;
    double azimuthal = 0;
    double mean = 0;
};

CurvatureError curvature_error(const Spheroid& exact, Index elements, double stretch) {
    const auto m = exact.meridian(elements, stretch);
    const auto k = principal_curvatures(m);
    CurvatureError worst;
    for (Index i = 0; i < m.nodes(); ++i) {
        const double t = exact.parameter(m.r[i], m.z[i]);
        worst.meridional = std::max(worst.meridional, std::abs(k.meridional[i] - exact.meridional(t)));
        worst.azimuthal = std::max(worst.azimuthal, std::abs(k.azimuthal[i] - exact.azimuthal(t)));
        worst.mean = std::max(worst.mean, std::abs(k.mean()[i] - exact.mean(t)));
    }
    return worst;
}

}  // namespace

TEST_CASE("curvatures converge at fourth order at all nodes, poles included", "[curvature]") {
    for (const Spheroid exact : {Spheroid{0.7, 1.4}, Spheroid{1.3, 0.6}}) {
        for (const double stretch : {0.0, 0.5}) {
            const auto coarse = curvature_error(exact, 64, stretch);
            const auto fine = curvature_error(exact, 128, stretch);
            CHECK(observed_order(coarse.meridional, fine.meridional) > 3.7);
            CHECK(observed_order(coarse.azimuthal, fine.azimuthal) > 3.7);
            CHECK(observed_order(coarse.mean, fine.mean) > 3.7);
            CHECK(fine.mean < 3e-4);
        }
    }
}

TEST_CASE("the bending energy of a sphere of any size is 8 pi", "[curvature]") {
    for (const double radius : {0.01, 1.0, 20.0}) {
        const double coarse = std::abs(bending_energy(Spheroid{radius, radius}.meridian(32)) - 8 * pi);
        const double fine = std::abs(bending_energy(Spheroid{radius, radius}.meridian(64)) - 8 * pi);
        CHECK(observed_order(coarse, fine) > 3.7);
        CHECK(fine < 1e-3);
    }
}

TEST_CASE("the bending energy of spheroids converges at fourth order", "[curvature]") {
    for (const Spheroid exact : {Spheroid{0.7, 1.4}, Spheroid{1.3, 0.6}}) {
        const double energy = exact.bending_energy();
        for (const double stretch : {0.0, 0.5}) {
            const double coarse = std::abs(bending_energy(exact.meridian(64, stretch)) / energy - 1);
            const double fine = std::abs(bending_energy(exact.meridian(128, stretch)) / energy - 1);
            CHECK(observed_order(coarse, fine) > 3.6);
            CHECK(fine < 1e-4);
        }
    }
}

TEST_CASE("the bending energy in other scalars", "[curvature]") {
    const auto m = Spheroid{0.7, 1.4}.meridian(64);
    const Meridian<long double> precise{m.r.cast<long double>(), m.z.cast<long double>()};
    const Meridian<float> single{m.r.cast<float>(), m.z.cast<float>()};
    CHECK(static_cast<double>(bending_energy(precise)) == Approx(bending_energy(m)).epsilon(1e-11));
    CHECK(static_cast<double>(bending_energy(single)) == Approx(bending_energy(m)).epsilon(1e-2));
}
