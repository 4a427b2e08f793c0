// SPDX-License-Identifier: MIT
// Operators of the P1 surface against closed forms on spheres and spheroids, at all nodes, poles included; and the
// identities that hold exactly.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_surface.hpp>
#include <axistokes/membrane/vesicle.hpp>

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using axistokes::Index;
using axistokes::linear_surface;
using axistokes::LinearSurface;
using axistokes::Meridian;
using axistokes::Point;
using axistokes::Vector;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::Spheroid;

/// Lap_s f = q^(-1/2) d/du [(1 - u^2) q^(-1/2) df/du], u = cos t, q = speed^2 = c^2 - d u^2, d = c^2 - a^2, of
/// H = (a c q^(-3/2) + (c/a) q^(-1/2))/2.
double laplacian_of_mean_curvature(const Spheroid& s, double t) {
    const double u2 = std::cos(t) * std::cos(t);
    const double d = s.c * s.c - s.a * s.a;
    const double q = s.c * s.c - d * u2;
    const double inner = 0.75 * s.a * s.c / std::pow(q, 3) + 0.25 * s.c / (s.a * q * q);
    const double slope = 2.25 * s.a * s.c / std::pow(q, 4) + 0.5 * s.c / (s.a * std::pow(q, 3));
    return 2 * d * ((1 - 3 * u2) * inner + 2 * d * u2 * (1 - u2) * slope) / std::sqrt(q);
}

double bending_force(const Spheroid& s, double t) {
    const double h = s.mean(t);
    return 2 * laplacian_of_mean_curvature(s, t) + 4 * h * (h * h - s.gauss(t));
}

const std::vector<Spheroid> spheroids{{0.8, 1.6}, {1.2, 0.7}, {1.0, 1.0}};

/// Largest error over all nodes of `value(surface)` against `exact(t)`.
double worst_error(const Spheroid& s, Index elements, double stretch,
                   const std::function<Vector<double>(const LinearSurface<double>&)>& value,
                   const std::function<double(double)>& exact) {
    const Meridian<double> m = s.meridian(elements, stretch);
    const Vector<double> computed = value(linear_surface(m));
    double worst = 0;
    for (Index i = 0; i < m.nodes(); ++i) {
        worst = std::max(worst, std::abs(computed[i] - exact(s.parameter(m.r[i], m.z[i]))));
    }
    return worst;
}

/// Second order at all nodes on every spheroid and spacing: the error falls fourfold, to less than `bound` of the
/// largest value (or of 1) on 256 elements.
void check_second_order(const std::function<Vector<double>(const LinearSurface<double>&)>& value,
                        const std::function<double(const Spheroid&, double)>& exact, double bound) {
    for (const Spheroid& s : spheroids) {
        for (const double stretch : {0.0, 0.5, -0.5}) {
            INFO("semi-axes " << s.a << ", " << s.c << ", stretch " << stretch);
            const auto at = [&](double t) { return exact(s, t); };
            const double coarse = worst_error(s, 128, stretch, value, at);
            const double fine = worst_error(s, 256, stretch, value, at);
            double size = 1;
            for (int i = 0; i <= 20; ++i) {
                size = std::max(size, std::abs(at(pi * i / 20)));
            }
            // Quantities that vanish or are exact have no order.
            CHECK((fine < 1e-9 || observed_order(coarse, fine) > 1.85));
            CHECK(fine < bound * size);
        }
    }
}

double frustum_area(const Meridian<double>& m, Index e) {
    return pi * (m.r[e] + m.r[e + 1]) * std::hypot(m.r[e + 1] - m.r[e], m.z[e + 1] - m.z[e]);
}

double volume(const Meridian<double>& m) {
    double sum = 0;
    for (Index e = 0; e < m.elements(); ++e) {
        sum += pi / 3 * (m.r[e] * m.r[e] + m.r[e] * m.r[e + 1] + m.r[e + 1] * m.r[e + 1]) * (m.z[e + 1] - m.z[e]);
    }
    return sum;
}

/// A shape without symmetry on an uneven mesh.
Meridian<double> pear(Index elements) {
    Meridian<double> m = Spheroid{0.8, 1.3}.meridian(elements, 0.4);
    m.r.array() *= 1 + 0.3 * m.z.array();
    return m;
}

Vector<double> pseudo_random(Index size, double seed) {
    return Vector<double>::LinSpaced(size, 1, static_cast<double>(size)).unaryExpr([seed](double x) {
        return std::sin(seed * x * x);
    });
}

Meridian<double> displaced(const Meridian<double>& m, const Vector<double>& by, double amount) {
    return {m.r + amount * by.head(m.nodes()), m.z + amount * by.tail(m.nodes())};
}

}  // namespace

TEST_CASE("the closed form of the bending force is minus the variation of the energy", "[surface]") {
    // Along the family of spheroids: dE/da = -Int f (dx/da . n) dA; dilations leave E alone.
    for (const Spheroid& s : spheroids) {
        const double step = 1e-4;
        const double variation =
            (Spheroid{s.a + step, s.c}.bending_energy() - Spheroid{s.a - step, s.c}.bending_energy()) / (2 * step);
        const double work = s.integral([&](double t) { return bending_force(s, t) * std::sin(t) * s.normal(t).r; });
        CHECK(variation == Approx(-work).epsilon(1e-6).margin(1e-6));
        CHECK(std::abs(s.integral([&](double t) {
                  return bending_force(s, t) * (s.a * std::sin(t) * s.normal(t).r - s.c * std::cos(t) * s.normal(t).z);
              })) < 1e-10);
        CHECK(std::abs(s.integral([&](double t) { return laplacian_of_mean_curvature(s, t); })) < 1e-10);
    }
}

TEST_CASE("normals are second order", "[surface]") {
    check_second_order([](const auto& s) { return s.normal_r; },
                       [](const Spheroid& s, double t) { return s.normal(t).r; }, 1e-3);
    check_second_order([](const auto& s) { return s.normal_z; },
                       [](const Spheroid& s, double t) { return s.normal(t).z; }, 1e-3);
}

TEST_CASE("curvatures are second order at all nodes", "[surface]") {
    check_second_order([](const auto& s) { return s.mean_curvature; },
                       [](const Spheroid& s, double t) { return s.mean(t); }, 5e-3);
    check_second_order([](const auto& s) { return s.gauss_curvature; },
                       [](const Spheroid& s, double t) { return s.gauss(t); }, 2e-2);
}

TEST_CASE("the Laplacian is second order at all nodes", "[surface]") {
    // Lap_s z = -2 H n_z.
    check_second_order([](const auto& s) { return Vector<double>(s.laplacian * s.nodes.z); },
                       [](const Spheroid& s, double t) { return -2 * s.mean(t) * s.normal(t).z; }, 1e-2);
    // Eigenfunctions on the unit sphere.
    for (const int l : {1, 2, 3, 5}) {
        INFO("degree " << l);
        const auto legendre = [l](double z) { return boost::math::legendre_p(l, std::clamp(z, -1.0, 1.0)); };
        for (const double stretch : {0.0, 0.5}) {
            double error[2];
            for (const int k : {0, 1}) {
                error[k] = worst_error(
                    {1, 1}, k == 0 ? 64 : 128, stretch,
                    [&](const auto& s) { return Vector<double>(s.laplacian * s.nodes.z.unaryExpr(legendre)); },
                    [&](double t) { return -l * (l + 1) * legendre(-std::cos(t)); });
            }
            CHECK(observed_order(error[0], error[1]) > 1.85);
            CHECK(error[1] < 2e-4 * std::pow(l + 1, 4));
        }
    }
}

TEST_CASE("the bending force is second order at all nodes, poles included", "[surface]") {
    const auto normal_part = [](const LinearSurface<double>& s) {
        const Vector<double> f = axistokes::Vesicle<double>::force(s);
        return Vector<double>(f.head(s.size()).cwiseProduct(s.normal_r) + f.tail(s.size()).cwiseProduct(s.normal_z));
    };
    check_second_order(normal_part, bending_force, 3e-2);
}

TEST_CASE("a uniform tension pulls along -2 H n, a varying one along its gradient too", "[surface]") {
    for (const Spheroid& s : spheroids) {
        const auto tension = [&](double z) { return 1 + 0.3 * z * z; };
        double error[2] = {0, 0};
        for (const int k : {0, 1}) {
            const Meridian<double> m = s.meridian(k == 0 ? 128 : 256, 0.3);
            const auto surface = linear_surface(m);
            const Index n = m.nodes();
            Vector<double> on_elements(n - 1);
            for (Index e = 0; e + 1 < n; ++e) {
                on_elements[e] = tension((m.z[e] + m.z[e + 1]) / 2);
            }
            const Vector<double> f = surface.tension_force * on_elements;
            for (Index i = 0; i < n; ++i) {
                const double t = s.parameter(m.r[i], m.z[i]);
                const Point<double> normal = s.normal(t);
                const double slope = 0.6 * m.z[i] * normal.r;  // tangent (-n_z, n_r)
                const double pressure = -2 * tension(m.z[i]) * s.mean(t);
                // The radial part errs by O(h^2/r): first order at the few nodes next to a pole.
                error[k] = std::max({error[k], m.r[i] * std::abs(f[i] - (pressure * normal.r - slope * normal.z)),
                                     std::abs(f[n + i] - (pressure * normal.z + slope * normal.r))});
            }
        }
        INFO("errors " << error[0] << ' ' << error[1]);
        CHECK(observed_order(error[0], error[1]) > 1.85);
        CHECK(error[1] < 1e-2);
    }
}

TEST_CASE("tension force and divergence are adjoint", "[surface]") {
    const auto surface = linear_surface(pear(40));
    const Index n = surface.size();
    Vector<double> u = pseudo_random(2 * n, 0.37);
    u[0] = u[n - 1] = 0;  // no radial velocity on the axis
    const Vector<double> tension = pseudo_random(n - 1, 0.91);
    const double rate = tension.cwiseProduct(surface.element_area).dot(surface.divergence * u);
    const Vector<double> f = surface.tension_force * tension;
    const double power = surface.weight.dot(f.head(n).cwiseProduct(u.head(n)) + f.tail(n).cwiseProduct(u.tail(n)));
    CHECK(std::abs(rate) > 0.01);
    CHECK(std::abs(rate + power) < 1e-13);
}

TEST_CASE("the divergence is the rate of change of the frusta's areas, the flux that of the volume", "[surface]") {
    const Meridian<double> m = pear(24);
    const auto surface = linear_surface(m);
    const Index n = surface.size();
    Vector<double> u = pseudo_random(2 * n, 0.53);
    u[0] = u[n - 1] = 0;
    const double step = 1e-5;
    const auto ahead = displaced(m, u, step);
    const auto behind = displaced(m, u, -step);
    const Vector<double> divergence = surface.divergence * u;
    for (Index e = 0; e + 1 < n; ++e) {
        const double rate = (frustum_area(ahead, e) - frustum_area(behind, e)) / (2 * step * frustum_area(m, e));
        CHECK(divergence[e] == Approx(rate).margin(1e-6));
        CHECK(surface.element_area[e] == Approx(frustum_area(m, e)).epsilon(1e-14));
    }
    CHECK(surface.flux(u) == Approx((volume(ahead) - volume(behind)) / (2 * step)).margin(1e-8));
    CHECK(surface.flux(surface.positions()) == Approx(3 * volume(m)).epsilon(1e-13));
}

TEST_CASE("translations have neither flux nor divergence", "[surface]") {
    const auto surface = linear_surface(pear(100));
    Vector<double> u = Vector<double>::Zero(2 * surface.size());
    u.tail(surface.size()).setOnes();
    CHECK(std::abs(surface.flux(u)) < 1e-14);
    CHECK((surface.divergence * u).cwiseAbs().maxCoeff() < 1e-12);
    // Tension pulls the surface as a whole nowhere.
    const Index n = surface.size();
    const Vector<double> f = surface.tension_force * pseudo_random(n - 1, 0.77);
    CHECK(std::abs(surface.weight.dot(f.tail(n))) < 1e-12);
}

TEST_CASE("weights add up to the frusta, second order in the area", "[surface]") {
    const Spheroid s{0.8, 1.6};
    double error[2];
    for (const int k : {0, 1}) {
        const auto surface = linear_surface(s.meridian(k == 0 ? 50 : 100, 0.4));
        CHECK(surface.area() == Approx(surface.element_area.sum()).epsilon(1e-14));
        CHECK(surface.arc_length[surface.size() - 1] == Approx(surface.element_length.sum()).epsilon(1e-14));
        error[k] = std::abs(surface.area() - s.area());
    }
    CHECK(observed_order(error[0], error[1]) == Approx(2).margin(0.1));
}

TEST_CASE("nodal gradient and divergence", "[surface]") {
    // d(z^2)/ds = 2 z t_z with the tangent (-n_z, n_r).
    check_second_order([](const auto& s) { return s.surface_gradient(s.nodes.z.cwiseAbs2()); },
                       [](const Spheroid& s, double t) { return -2 * s.c * std::cos(t) * s.normal(t).r; }, 1e-2);
    // div_s (z e_z) = t_z^2; div_s x = 2.
    check_second_order(
        [](const auto& s) {
            Vector<double> u = Vector<double>::Zero(2 * s.size());
            u.tail(s.size()) = s.nodes.z;
            return s.surface_divergence(u);
        },
        [](const Spheroid& s, double t) { return s.normal(t).r * s.normal(t).r; }, 1e-2);
    check_second_order([](const auto& s) { return s.surface_divergence(s.positions()); },
                       [](const Spheroid&, double) { return 2.0; }, 1e-9);
}

TEST_CASE("the mirrored shape has the mirrored operators", "[surface]") {
    const Meridian<double> m = pear(30);
    const auto surface = linear_surface(m);
    const auto mirrored = linear_surface(Meridian<double>{m.r.reverse(), -m.z.reverse()});
    CHECK((surface.mean_curvature - mirrored.mean_curvature.reverse()).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((surface.gauss_curvature - mirrored.gauss_curvature.reverse()).cwiseAbs().maxCoeff() < 1e-12);
    const Vector<double> f = m.r.array().cos();
    CHECK((surface.laplacian * f - (mirrored.laplacian * f.reverse()).reverse()).cwiseAbs().maxCoeff() < 1e-11);
}
