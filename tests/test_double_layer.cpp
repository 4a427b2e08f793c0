// SPDX-License-Identifier: MIT
// The double layer of a translation: nothing outside a closed surface, the motion itself inside, half of it on it.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/wall/panel_curve.hpp>

#include <cmath>

namespace {

using axistokes::CurvePoint;
using axistokes::Index;
using axistokes::LinearElements;
using axistokes::Matrix;
using axistokes::Meridian;
using axistokes::PanelCurve;
using axistokes::SpectralMeridian;
using axistokes::Vector;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::Spheroid;

/// Largest deviation of the double layer of e_z from `share` e_z.
double deviation(const Matrix<double>& d, double share) {
    const Index n = d.cols() / 2;
    const Index rows = d.rows() / 2;
    const Vector<double> u = d.rightCols(n).rowwise().sum();
    return std::max(u.head(rows).cwiseAbs().maxCoeff(), (u.tail(rows).array() - share).abs().maxCoeff());
}

/// Scaled spheroids: targets inside for a factor below 1.
Meridian<double> scaled(const Meridian<double>& m, double factor) {
    return {factor * m.r, factor * m.z};
}

const axistokes::FreeSpaceKernel<double> kernel;

PanelCurve<double> panel_spheroid(const Spheroid& spheroid, Index panels, Index nodes) {
    PanelCurve<double> curve(nodes, 1e-11);
    for (Index e = 0; e < panels; ++e) {
        const double width = pi / static_cast<double>(panels);
        curve.append([&](double x) {
            const double t = width * (static_cast<double>(e) + x);
            return CurvePoint<double>{{spheroid.a * std::sin(t), -spheroid.c * std::cos(t)},
                                      {width * spheroid.a * std::cos(t), width * spheroid.c * std::sin(t)},
                                      {}};
        });
    }
    return curve;
}

}  // namespace

TEST_CASE("Double layer of a translation: series", "[double layer]") {
    const SpectralMeridian<double> series;
    for (const Spheroid& spheroid : {Spheroid{1.0, 1.0}, Spheroid{0.7, 1.4}}) {
        const Meridian<double> m = spheroid.meridian(12);
        const Meridian<double> fine = spheroid.meridian(24);
        const double coarse = deviation(series.double_layer(m, kernel), 0.5);
        const double error = deviation(series.double_layer(fine, kernel), 0.5);
        INFO(coarse << " " << error);
        CHECK(error < 1e-8);
        CHECK((coarse < 1e-8 || error < 0.01 * coarse));
        for (const double factor : {0.5, 0.95}) {
            CHECK(deviation(series.double_layer_at(scaled(m, factor), fine, kernel), 1) < 1e-8);
            CHECK(deviation(series.double_layer_at(scaled(m, 2 - factor), fine, kernel), 0) < 1e-8);
        }
    }
}

TEST_CASE("Double layer of a translation: panels", "[double layer]") {
    const Spheroid spheroid{0.7, 1.4};
    const PanelCurve<double> coarse = panel_spheroid(spheroid, 6, 4);
    const PanelCurve<double> fine = panel_spheroid(spheroid, 6, 8);
    const double error = deviation(fine.double_layer(kernel), 0.5);
    CHECK(error < 1e-4);
    CHECK(error < 0.02 * deviation(coarse.double_layer(kernel), 0.5));
    CHECK(deviation(fine.double_layer_at(scaled(spheroid.meridian(10), 0.9), kernel), 1) < 1e-5);
    CHECK(deviation(fine.double_layer_at(scaled(spheroid.meridian(10), 1.1), kernel), 0) < 1e-5);
}

TEST_CASE("Double layer of a translation: P1 elements", "[double layer]") {
    const LinearElements<double> elements;
    const Spheroid spheroid{0.7, 1.4};
    const Meridian<double> m = spheroid.meridian(32);
    // A polygon is a closed surface itself.
    CHECK(deviation(elements.double_layer_at(scaled(m, 0.9), m, kernel), 1) < 1e-5);
    CHECK(deviation(elements.double_layer_at(scaled(m, 1.1), m, kernel), 0) < 1e-5);
    const double coarse = deviation(elements.double_layer(m, kernel), 0.5);
    const double fine = deviation(elements.double_layer(spheroid.meridian(64), kernel), 0.5);
    INFO(coarse << " " << fine);
    CHECK(fine < 1e-4);
}

TEST_CASE("Double layer of a translation: in a tube", "[double layer]") {
    // The images add nothing to a closed surface's identity, but only if they are those of the stress.
    const axistokes::TubeKernel<double> tube(1.1);
    const Meridian<double> m = Spheroid{0.7, 1.2}.meridian(16);
    const SpectralMeridian<double> series;
    const double images = (series.double_layer(m, tube) - series.double_layer(m, kernel)).cwiseAbs().maxCoeff();
    CHECK(images > 1e-3);
    CHECK(deviation(series.double_layer(m, tube), 0.5) < 1e-6);
    CHECK(deviation(series.double_layer_at(scaled(m, 0.8), m, tube), 1) < 1e-6);
    const LinearElements<double> elements;
    CHECK(deviation(elements.double_layer_at(scaled(m, 0.8), m, tube), 1) < 1e-5);
}
