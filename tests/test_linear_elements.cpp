// SPDX-License-Identifier: MIT
// The single layer against its eigenfunctions on the sphere, and its quadrature against a finer tolerance.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/kernel/free_space.hpp>

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using axistokes::FreeSpaceKernel;
using axistokes::Index;
using axistokes::LinearElements;
using axistokes::Matrix;
using axistokes::Meridian;
using axistokes::Vector;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::refusal;
using axistokes::test::Spheroid;

LinearElements<double> elements_of(double tolerance) {
    LinearElements<double>::Params params;
    params.tolerance = tolerance;
    return LinearElements<double>(params);
}

/// Vector harmonics on the unit sphere, Y = P_l(cos theta): growing grad_s Y + l Y n (the gradient of the solid
/// harmonic) or decaying grad_s Y - (l + 1) Y n; stacked [r; z].
Vector<double> harmonic(const Meridian<double>& m, int l, bool growing) {
    const Index n = m.nodes();
    Vector<double> f(2 * n);
    for (Index i = 0; i < n; ++i) {
        const double u = std::clamp(m.z[i], -1.0, 1.0);
        const double slope = boost::math::legendre_p_prime(l, u);
        const double normal = (growing ? l : -(l + 1)) * boost::math::legendre_p(l, u);
        // grad_s Y = -sin(theta) P_l' e_theta, e_theta = (cos theta, -sin theta).
        f[i] = -m.r[i] * slope * u + normal * m.r[i];
        f[n + i] = m.r[i] * m.r[i] * slope + normal * u;
    }
    return f;
}

/// Both harmonics are eigenfunctions (both fluids of viscosity 1). Growing: inside u is itself the harmonic gradient
/// field, e.g. l = 1: uniform velocity, f = (3/2) u from Stokes' drag; l = 2: straining, f = 2 u + 3 u. Decaying l = 0:
/// a pressure, which moves nothing.
double eigenvalue(int l, bool growing) {
    const double n = l;
    return growing ? (n + 1) / ((2 * n + 1) * (2 * n - 1)) : n / ((2 * n + 1) * (2 * n + 3));
}

/// A sphere pinched to a neck of radius 0.02.
Meridian<double> dumbbell(Index elements) {
    Meridian<double> m = Spheroid{1.0, 2.0}.meridian(elements);
    for (Index i = 1; i < elements; ++i) {
        m.r[i] *= 0.02 + 0.98 * m.z[i] * m.z[i] / (0.3 + m.z[i] * m.z[i]);
    }
    return m;
}

/// Largest difference of two single layers, relative to the largest entry in the block of target and source node.
double difference(const Matrix<double>& a, const Matrix<double>& b) {
    const Index n = a.cols() / 2;
    const Index rows = a.rows() / 2;
    double worst = 0;
    for (Index i = 0; i < rows; ++i) {
        for (Index j = 0; j < n; ++j) {
            double size = 0;
            double error = 0;
            for (const Index row : {i, rows + i}) {
                for (const Index column : {j, n + j}) {
                    size = std::max(size, std::abs(b(row, column)));
                    error = std::max(error, std::abs(a(row, column) - b(row, column)));
                }
            }
            worst = std::max(worst, error / size);
        }
    }
    return worst;
}

/// Outside, uniform traction e_z on the unit sphere is a Stokes flow of velocity U = 2/3.
axistokes::Point<double> outside_sphere(double r, double z) {
    const double d = std::hypot(r, z);
    const double stokeslet = 0.75 / d;
    const double dipole = 0.25 / (d * d * d);
    return {2.0 / 3 * (stokeslet - 3 * dipole) * r * z / (d * d),
            2.0 / 3 * (stokeslet + dipole + (stokeslet - 3 * dipole) * z * z / (d * d))};
}

}  // namespace

TEST_CASE("eigenfunctions of the single layer on a sphere, second order at all nodes", "[single layer]") {
    const auto elements = elements_of(1e-8);
    for (const double stretch : {0.0, 0.4}) {
        const auto coarse = Spheroid{1, 1}.meridian(32, stretch);
        const auto fine = Spheroid{1, 1}.meridian(64, stretch);
        const Matrix<double> g_coarse = elements.single_layer(coarse, FreeSpaceKernel<double>{});
        const Matrix<double> g_fine = elements.single_layer(fine, FreeSpaceKernel<double>{});
        for (const bool growing : {true, false}) {
            for (const int l : {0, 1, 2, 3, 4}) {
                if (growing && l == 0) {
                    continue;
                }
                INFO("degree " << l << (growing ? ", growing" : ", decaying") << ", stretch " << stretch);
                const Vector<double> f_coarse = harmonic(coarse, l, growing);
                const Vector<double> f_fine = harmonic(fine, l, growing);
                const double value = eigenvalue(l, growing);
                const double error_coarse = (g_coarse * f_coarse - value * f_coarse).cwiseAbs().maxCoeff();
                const double error_fine = (g_fine * f_fine - value * f_fine).cwiseAbs().maxCoeff();
                CHECK(observed_order(error_coarse, error_fine) > 1.8);
                CHECK(error_fine < 1e-3 * (l + 1));
            }
        }
    }
}

TEST_CASE("a uniform traction on the unit sphere moves it at two thirds of it", "[single layer]") {
    const auto m = Spheroid{1, 1}.meridian(128);
    const Index n = m.nodes();
    Vector<double> f = Vector<double>::Zero(2 * n);
    f.tail(n).setOnes();
    const Vector<double> u = elements_of(1e-8).single_layer(m, FreeSpaceKernel<double>{}) * f;
    CHECK(u.head(n).cwiseAbs().maxCoeff() < 2e-4);
    CHECK((u.tail(n).array() - 2.0 / 3).abs().maxCoeff() < 2e-4);
}

TEST_CASE("a pressure moves nothing, to second order, on any shape", "[single layer]") {
    const auto elements = elements_of(1e-8);
    for (const Spheroid s : {Spheroid{0.7, 1.5}, Spheroid{1.4, 0.5}}) {
        double error[2];
        for (const int k : {0, 1}) {
            const auto m = s.meridian(k == 0 ? 40 : 80, 0.3);
            error[k] = (elements.single_layer(m, FreeSpaceKernel<double>{}) * elements.surface(m).normals())
                           .cwiseAbs()
                           .maxCoeff();
        }
        CHECK(observed_order(error[0], error[1]) > 1.8);
        CHECK(error[1] < 2e-3);
    }
}

TEST_CASE("the quadrature meets its tolerance", "[single layer]") {
    const FreeSpaceKernel<double> kernel;
    for (const auto& m : {Spheroid{0.6, 1.7}.meridian(40, 0.4), Spheroid{1.5, 0.1}.meridian(40), dumbbell(64)}) {
        const Matrix<double> reference = elements_of(1e-14).single_layer(m, kernel);
        for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
            INFO("tolerance " << tolerance);
            CHECK(difference(elements_of(tolerance).single_layer(m, kernel), reference) < tolerance);
        }
    }
}

TEST_CASE("a looser tolerance costs fewer nodes", "[single layer]") {
    // Distances in element lengths: the order falls with distance and rises with the digits asked for.
    const axistokes::ElementRules<double> coarse(1e-4);
    const axistokes::ElementRules<double> fine(1e-8);
    CHECK(coarse.order(10.0, 1.0) < fine.order(10.0, 1.0));
    CHECK(fine.order(50.0, 1.0) < fine.order(3.0, 1.0));
    CHECK(fine.order(1.0, 1.0) == 0);
}

TEST_CASE("targets at the nodes give the single layer itself", "[single layer]") {
    const FreeSpaceKernel<double> kernel;
    for (const auto& m : {Spheroid{0.6, 1.7}.meridian(24), dumbbell(40)}) {
        const auto elements = elements_of(1e-9);
        CHECK(difference(elements.single_layer_at(m, m, kernel), elements.single_layer(m, kernel)) < 1e-8);
    }
}

TEST_CASE("velocities inside, outside, on the axis and just off the surface", "[single layer]") {
    const auto m = Spheroid{1, 1}.meridian(160);
    const Index n = m.nodes();
    Vector<double> f = Vector<double>::Zero(2 * n);
    f.tail(n).setOnes();
    Meridian<double> targets{Vector<double>(10), Vector<double>(10)};
    // On the chord between two nodes too, and 1e-10 off it.
    const double on_r = 0.6 * m.r[60] + 0.4 * m.r[61];
    const double on_z = 0.6 * m.z[60] + 0.4 * m.z[61];
    targets.r << 0, 0, 0, 0.5, 0.999, 1.001, 1.5, on_r, on_r * (1 + 1e-10), 3;
    targets.z << 0, 0.9, 2, 0.2, 0.01, 0.01, -1, on_z, on_z * (1 + 1e-10), 40;
    const Vector<double> u = elements_of(1e-8).single_layer_at(targets, m, FreeSpaceKernel<double>{}) * f;
    for (Index i = 0; i < 10; ++i) {
        INFO("r = " << targets.r[i] << ", z = " << targets.z[i]);
        const bool inside = std::hypot(targets.r[i], targets.z[i]) < 1;
        const auto exact = inside ? axistokes::Point<double>{0, 2.0 / 3} : outside_sphere(targets.r[i], targets.z[i]);
        CHECK(u[i] == Approx(exact.r).margin(2e-4));
        CHECK(u[10 + i] == Approx(exact.z).margin(2e-4));
        CHECK((targets.r[i] != 0 || u[i] == 0));
    }
    CHECK(std::abs(u[7] - u[8]) < 1e-7);
    CHECK(std::abs(u[17] - u[18]) < 1e-7);
}

TEST_CASE("the mobility is reciprocal: symmetric and positive up to the elements' error", "[single layer]") {
    const auto m = Spheroid{0.7, 1.4}.meridian(60);
    const auto elements = elements_of(1e-8);
    const Matrix<double> g = elements.single_layer(m, FreeSpaceKernel<double>{});
    const Vector<double> w = elements.surface(m).weight.replicate(2, 1);
    const Index n = m.nodes();
    const Vector<double> f = (m.z.array() * 2).cos().matrix().replicate(2, 1).cwiseProduct(m.r.replicate(2, 1));
    Vector<double> h(2 * n);
    h << m.r.cwiseProduct(m.z), m.z.array().exp().matrix();
    const double fh = f.cwiseProduct(w).dot(g * h);
    CHECK(fh == Approx(h.cwiseProduct(w).dot(g * f)).epsilon(1e-3));
    CHECK(f.cwiseProduct(w).dot(g * f) > 0);
    CHECK(h.cwiseProduct(w).dot(g * h) > 0);
}

TEST_CASE("float and long double", "[single layer]") {
    const auto m = Spheroid{0.7, 1.4}.meridian(24);
    const Meridian<float> single{m.r.cast<float>(), m.z.cast<float>()};
    const Meridian<long double> precise{m.r.cast<long double>(), m.z.cast<long double>()};
    LinearElements<long double>::Params params;
    params.tolerance = 1e-16L;
    const Matrix<double> exact =
        LinearElements<long double>(params).single_layer(precise, FreeSpaceKernel<long double>{}).cast<double>();
    CHECK(difference(elements_of(1e-13).single_layer(m, FreeSpaceKernel<double>{}), exact) < 5e-13);
    const LinearElements<float> coarse;
    CHECK(difference(coarse.single_layer(single, FreeSpaceKernel<float>{}).cast<double>(), exact) < 2e-5);
}

TEST_CASE("tolerances out of range are refused", "[single layer]") {
    for (const double tolerance : {0.0, -1e-6, 1e-300, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK(mentions(refusal([=] { elements_of(tolerance); }), "quadrature tolerance", "=", "in [eps, 0.1]"));
    }
    CHECK(mentions(refusal([] { elements_of(0.5); }), "quadrature tolerance", "0.5", "in [eps, 0.1]"));
}
