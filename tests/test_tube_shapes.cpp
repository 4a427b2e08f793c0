// SPDX-License-Identifier: MIT
// Surfaces parallel to spheroids, from the spheroid to the cylinder with hemispherical ends: Steiner's formula against
// quadrature, the member of given area, volume and radius, and the initial shapes that fit into a tube.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/accuracy/resolution.hpp>
#include <axistokes/discretization/adaptive_meridian.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/geometry/tube_shapes.hpp>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>
#include <limits>

namespace {

using axistokes::critical_tube_radius;
using axistokes::Index;
using axistokes::Measures;
using axistokes::Meridian;
using axistokes::MeridianSpline;
using axistokes::parallel_spheroid;
using axistokes::ParallelSpheroid;
using axistokes::shape_in_tube;
using axistokes::SpheroidKind;
using axistokes::Vector;
using axistokes::test::mentions;
using axistokes::test::pi;
using axistokes::test::refusal;

const double volume = 4 * pi / 3;

double area_of(double excess_area) {
    return 4 * pi + excess_area;
}

double radius_of_spheroid(double excess_area) {
    return 1 / std::cbrt(axistokes::spheroid_aspect_of_excess_area(excess_area, SpheroidKind::prolate));
}

/// By quadrature in the spheroid's parameter t: the parallel curve is as much longer as 1 + d k.
Measures<double> by_quadrature(const ParallelSpheroid<double>& s) {
    boost::math::quadrature::tanh_sinh<double> rule;
    const axistokes::test::Spheroid inner{s.a, s.c};
    const auto radius = [&](double t) { return std::sin(t) * (s.a + s.d * s.c / inner.speed(t)); };
    const auto length = [&](double t) { return inner.speed(t) * (1 + s.d * inner.meridional(t)); };
    const auto quarter = [&](const auto& f) { return 2 * rule.integrate(f, 0.0, pi / 2, 1e-14); };
    return {quarter([&](double t) { return 2 * pi * radius(t) * length(t); }), quarter([&](double t) {
                return pi * std::pow(radius(t), 2) * length(t) * s.a * std::sin(t) * s.c / (s.a * inner.speed(t));
            }),
            0};
}

Vector<double> even_angles(Index count) {
    return Vector<double>::LinSpaced(count, 0, pi);
}

}  // namespace

TEST_CASE("Steiner's formula against quadrature", "[tube_shapes]") {
    for (const double a : {1e-3, 0.05, 0.4, 1.0}) {
        for (const double d : {0.0, 0.1, 0.7}) {
            const ParallelSpheroid<double> s{a, 1.3, d};
            INFO("a " << a << " d " << d);
            const auto exact = by_quadrature(s);
            CHECK(s.measures().area == Approx(exact.area).epsilon(1e-12));
            CHECK(s.measures().volume == Approx(exact.volume).epsilon(1e-12));
        }
    }
}

TEST_CASE("From the spheroid to the cylinder with hemispherical ends", "[tube_shapes]") {
    const auto spheroid = ParallelSpheroid<double>{0.6, 1.4, 0}.measures();
    CHECK(spheroid.area == axistokes::spheroid_area(0.6, 1.4));
    CHECK(spheroid.volume == Approx(4 * pi / 3 * 0.36 * 1.4).epsilon(1e-15));
    const auto ball = ParallelSpheroid<double>{0.25, 0.25, 0.5}.measures();
    CHECK(ball.area == Approx(4 * pi * 0.5625).epsilon(1e-15));
    CHECK(ball.volume == Approx(4 * pi / 3 * std::pow(0.75, 3)).epsilon(1e-15));
    // The differences vanish as a does.
    const double r = 0.5;
    const double cylinder = 2 * 1.2;
    double before = std::numeric_limits<double>::infinity();
    for (const double a : {1e-2, 1e-4, 1e-6, 1e-12}) {
        const auto m = ParallelSpheroid<double>{a, 1.2, r}.measures();
        const double off = std::abs(m.area - 2 * pi * r * cylinder - 4 * pi * r * r) +
                           std::abs(m.volume - pi * r * r * cylinder - 4 * pi / 3 * r * r * r);
        CHECK(off < 30 * a);
        CHECK(off < before / 50);
        before = off;
    }
}

TEST_CASE("One member for every radius between the limit and the spheroid's", "[tube_shapes]") {
    for (const double excess_area : {1e-6, 1e-4, 0.05, 0.170395, 1.0, 2.0, 4.8, 8.0}) {
        const double area = area_of(excess_area);
        const double narrowest = critical_tube_radius(area, volume);
        const double widest = radius_of_spheroid(excess_area);
        CHECK(narrowest < widest);
        double share = 0;
        double length = std::numeric_limits<double>::infinity();
        for (const double x : {1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0}) {
            const double radius = narrowest + x * (widest - narrowest);
            INFO("excess area " << excess_area << ", radius " << radius << ", share " << x);
            const auto s = parallel_spheroid(area, volume, radius);
            CHECK(s.measures().area == Approx(area).epsilon(1e-12));
            CHECK(s.measures().volume == Approx(volume).epsilon(1e-12));
            CHECK(s.radius() == Approx(radius).epsilon(1e-12));
            CHECK(s.a > 0);
            CHECK(s.c >= s.a);
            CHECK(s.d >= 0);
            // The wider, the rounder.
            CHECK(s.a / radius > share);
            CHECK(2 * (s.c + s.d) > 2 * radius);
            share = s.a / radius;
            length = 2 * (s.c + s.d);
        }
        CHECK(share == Approx(1.0).epsilon(1e-7));
        CHECK(length == Approx(2 / (widest * widest)).epsilon(1e-6));
        for (const double radius : {narrowest * (1 - 1e-9), widest * (1 + 1e-6), 1.1}) {
            CHECK(mentions(refusal([&] { parallel_spheroid(area, volume, radius); }), "largest radius", "between",
                           "spheroid"));
        }
    }
}

TEST_CASE("Its points are on one smooth convex curve", "[tube_shapes]") {
    for (const double a : {0.005, 0.05, 0.5}) {
        const ParallelSpheroid<double> s{a, 1.5, 0.5};
        const Meridian<double> m = s.points(even_angles(801));
        double turned = 0;
        double longest = 0;
        double length = 0;
        for (Index i = 0; i + 1 < m.nodes(); ++i) {
            const double angle = std::atan2(m.z[i + 1] - m.z[i], m.r[i + 1] - m.r[i]);
            CHECK(angle > turned);
            turned = angle;
            const double step = std::hypot(m.z[i + 1] - m.z[i], m.r[i + 1] - m.r[i]);
            longest = std::max(longest, step);
            length += step;
            CHECK(m.z[i] == Approx(-m.z[m.nodes() - 1 - i]).margin(1e-12));
            CHECK(m.r[i] == Approx(m.r[m.nodes() - 1 - i]).margin(1e-12));
        }
        CHECK(turned < pi);
        CHECK(longest < 3 * length / 800);
        CHECK(m.r.maxCoeff() == Approx(s.radius()).epsilon(1e-15));
        // At the distance d from the spheroid, along its normal.
        for (Index i = 1; i + 1 < m.nodes(); ++i) {
            double low = 0;
            double high = pi;
            for (int k = 0; k < 60; ++k) {
                const double t = (low + high) / 2;
                const double along =
                    (m.r[i] - s.a * std::sin(t)) * s.a * std::cos(t) + (m.z[i] + s.c * std::cos(t)) * s.c * std::sin(t);
                (along > 0 ? low : high) = t;
            }
            CHECK(std::hypot(m.r[i] - s.a * std::sin(low), m.z[i] + s.c * std::cos(low)) == Approx(s.d).epsilon(1e-13));
        }
    }
}

TEST_CASE("A shape for every tube wider than the limit", "[tube_shapes]") {
    const axistokes::SpectralMeridian<double> series;
    const axistokes::AdaptiveMeridian<double> adaptive;
    for (const double excess_area : {1e-6, 1e-3, 0.05, 0.170395, 0.3, 1.0, 4.8, 8.0}) {
        const double narrowest = critical_tube_radius(area_of(excess_area), volume);
        for (const double confinement : {0.3, 0.8, 0.9, 0.96, 0.98, 0.99, 0.995, 0.999, 0.99999}) {
            const double tube = narrowest / confinement;
            INFO("excess area " << excess_area << ", confinement " << confinement << " of the largest");
            const auto shape = [&](Index n) { return shape_in_tube(excess_area, tube, SpheroidKind::prolate, n); };
            const auto plain = shape(200);
            CHECK(plain.r.maxCoeff() <= std::max(0.97 * tube, (tube + narrowest) / 2) * (1 + 1e-14));
            const auto measures = MeridianSpline<double>(plain).measures();
            CHECK(measures.area == Approx(area_of(excess_area)).epsilon(2e-6));
            CHECK(measures.volume == Approx(volume).epsilon(2e-6));
            if (confinement > 0.9991) {
                continue;  // the ends' tips are too sharp for the numbers of nodes below
            }
            const auto restored = [&](const auto& discretization, Index n) {
                auto nodes = axistokes::nodes_of(discretization, shape, n);
                CHECK(discretization.restore(nodes, area_of(excess_area), volume));
                const auto now = discretization.measures(nodes);
                CHECK(now.area == Approx(area_of(excess_area)).epsilon(1e-10));
                CHECK(now.volume == Approx(volume).epsilon(1e-10));
                CHECK(discretization.max_radius(nodes) < tube);
            };
            restored(series, 48);
            restored(adaptive, 64);
        }
        CHECK(mentions(refusal([&] { shape_in_tube(excess_area, narrowest, SpheroidKind::prolate, 64); }),
                       "tube radius = ", axistokes::detail::text(narrowest), "for a vesicle of excess area"));
    }
}

TEST_CASE("Where the spheroid fits it stays", "[tube_shapes]") {
    for (const double excess_area : {0.0, 0.3, 2.0}) {
        const double radius = excess_area > 0 ? radius_of_spheroid(excess_area) : 1.0;
        const auto spheroid = axistokes::spheroid_of_excess_area<double>(excess_area, SpheroidKind::prolate, 40);
        const auto shape = shape_in_tube<double>(excess_area, 1.001 * radius / 0.97, SpheroidKind::prolate, 40);
        CHECK((shape.r - spheroid.r).norm() == 0);
        CHECK((shape.z - spheroid.z).norm() == 0);
    }
    CHECK(mentions(refusal([] { shape_in_tube(2.0, 0.9, SpheroidKind::oblate, 40); }), "tube radius = 0.9", "must be >",
                   "for an oblate spheroid of excess area 2"));
    CHECK(mentions(refusal([] { shape_in_tube(0.0, 0.99, SpheroidKind::prolate, 40); }), "tube radius = 0.9",
                   "must be > 1", "for a vesicle of excess area 0"));
}

TEST_CASE("Other scalars", "[tube_shapes]") {
    const auto usual = parallel_spheroid(4 * pi + 2, volume, 0.67);
    const auto single = parallel_spheroid<float>(float(4 * pi + 2), float(volume), 0.67F);
    const long double exact_pi = std::acos(-1.0L);
    const auto precise = parallel_spheroid<long double>(4 * exact_pi + 2, 4 * exact_pi / 3, 0.67L);
    CHECK(double(single.c) == Approx(usual.c).epsilon(1e-4));
    CHECK(double(precise.c) == Approx(usual.c).epsilon(1e-13));
    CHECK(std::abs(precise.measures().area / (4 * exact_pi + 2) - 1) < 1e-17L);
}
