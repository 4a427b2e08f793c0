// SPDX-License-Identifier: MIT
// Spectral discretisation: series, operators, quadrature and stationary vesicles against closed forms, against the P1
// elements and against themselves at higher resolution.
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <boost/math/differentiation/autodiff.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using Vec = Vector<double>;
using Mat = Matrix<double>;

template <class S = double>
Meridian<S> ellipse(S a, S c, Index n) {
    Meridian<S> m{Vector<S>(n + 1), Vector<S>(n + 1)};
    for (Index i = 0; i <= n; ++i) {
        const S t = detail::pi_value<S>() * S(i) / S(n);
        m.r[i] = a * std::sin(t);
        m.z[i] = -c * std::cos(t);
    }
    m.r[0] = m.r[n] = 0;
    return m;
}

/// Two broad sides that come within 2 * gap of each other on the axis.
Meridian<double> biconcave(double gap, Index n) {
    Meridian<double> m = ellipse(2.0, 1.0, n);
    for (Index i = 0; i <= n; ++i) {
        m.z[i] *= gap + 0.2 * m.r[i] * m.r[i];
    }
    return m;
}

/// A smooth density, at the nodes.
Vec density(Index n) {
    Vec f(2 * (n + 1));
    for (Index i = 0; i <= n; ++i) {
        const double t = detail::pi_value<double>() * static_cast<double>(i) / static_cast<double>(n);
        f[i] = std::sin(t) * std::exp(std::cos(t));
        f[n + 1 + i] = std::sin(2 * std::cos(t) + 0.3);
    }
    return f;
}

double worst(const Vec& a, const Vec& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

/// Values on the mesh of degree n of a stacked field on one of degree k n.
Vec every(Index k, const Vec& fine, Index n) {
    Vec result(2 * (n + 1));
    for (Index i = 0; i <= n; ++i) {
        result[i] = fine[k * i];
        result[n + 1 + i] = fine[k * n + 1 + k * i];
    }
    return result;
}

/// Bending force density along the normal of the spheroid a, c at the parameter t, by automatic differentiation.
double bending_of_spheroid(double a, double c, double t) {
    using boost::math::differentiation::make_fvar;
    const auto x = make_fvar<double, 2>(t);
    const auto speed2 = a * a * cos(x) * cos(x) + c * c * sin(x) * sin(x);
    const auto speed = sqrt(speed2);
    const auto azimuthal = c / (a * speed);
    const auto h = (a * c / (speed2 * speed) + azimuthal) / 2;
    const double v2 = speed2.derivative(0);
    const double first = h.derivative(1);
    const double stretch = speed.derivative(1) / speed.derivative(0);
    const bool pole = std::sin(t) < 1e-12;
    const double laplacian =
        pole ? 2 * h.derivative(2) / v2 : (h.derivative(2) + (std::cos(t) / std::sin(t) - stretch) * first) / v2;
    const double h0 = h.derivative(0);
    const double k0 = azimuthal.derivative(0);
    return 2 * laplacian + 4 * h0 * (h0 * h0 - k0 * (2 * h0 - k0));
}

/// Drag of the spheroid along its axis over 6 pi (equatorial semi-axis 1, polar c > 1): Happel & Brenner, 5-11.
double prolate_drag(double c) {
    const double e = std::sqrt(1 - 1 / (c * c));
    return c * 8 / 3.0 * e * e * e / ((1 + e * e) * std::log((1 + e) / (1 - e)) - 2 * e);
}

double oblate_drag(double c) {
    const double e = std::sqrt(1 - c * c);
    return 4 / 3.0 * e * e * e / (e * c + (2 * e * e - 1) * std::asin(e));
}

/// Relative error of the velocity of a translating spheroid, whose force density is proportional to n.x.
double translation_error(double c, double drag, Index n) {
    const Meridian<double> m = ellipse(1.0, c, n);
    const SpectralMeridian<double> spectral;
    const auto surface = spectral.surface(m);
    Vec force = Vec::Zero(2 * (n + 1));
    force.tail(n + 1) = surface.normal_r.cwiseProduct(m.r) + surface.normal_z.cwiseProduct(m.z);
    Vec expected = Vec::Zero(2 * (n + 1));
    const double volume = 4 * detail::pi_value<double>() * c / 3;
    expected.tail(n + 1).setConstant(3 * volume / (6 * detail::pi_value<double>() * drag));
    const Vec u = spectral.single_layer(m, FreeSpaceKernel<double>()) * force;
    return worst(u, expected) / expected.maxCoeff();
}

template <class S>
S sphere_settling_error(Index n) {
    const Meridian<S> m = ellipse<S>(S(1), S(1), n);
    typename SpectralMeridian<S>::Params params;
    params.tolerance = 16 * std::numeric_limits<S>::epsilon();
    const Matrix<S> g = SpectralMeridian<S>(params).single_layer(m, FreeSpaceKernel<S>());
    Vector<S> f = Vector<S>::Zero(2 * (n + 1));
    f.tail(n + 1).setOnes();
    Vector<S> u = g * f;
    u.tail(n + 1).array() -= S(2) / S(3);
    return u.cwiseAbs().maxCoeff();
}

template <class Discretization, class Flow>
StepRecord<double> stationary(Flow flow, Index n) {
    SimulationParams<double> params;
    params.tolerance = 1e-8;
    params.most_steps = 200;
    Simulator<FreeSpaceKernel<double>, Discretization, Vesicle<double>, Flow, SemiImplicitEuler, DenseLU<double>> run(
        spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, n), flow, params);
    REQUIRE(run.run());
    return run.history().back();
}

}  // namespace

TEST_CASE("Series are differentiated, integrated and interpolated exactly", "[spectral]") {
    const Index n = 32;
    const auto basis = TrigonometricBasis<double>::of_degree(n);
    Vec even(n + 1), even1(n + 1), even2(n + 1), odd(n + 1), odd1(n + 1), odd2(n + 1);
    const auto e = [](double t) { return std::exp(std::cos(t)); };
    for (Index i = 0; i <= n; ++i) {
        const double t = basis->nodes()[i];
        const double s = std::sin(t);
        const double c = std::cos(t);
        even[i] = e(t);
        even1[i] = -s * e(t);
        even2[i] = (s * s - c) * e(t);
        odd[i] = s * e(t);
        odd1[i] = (c - s * s) * e(t);
        odd2[i] = s * (s * s - 3 * c - 1) * e(t);
    }
    CHECK(worst(basis->even_first() * even, even1) < 1e-13);
    CHECK(worst(basis->even_second() * even, even2) < 1e-11);
    CHECK(worst(basis->odd_first() * odd, odd1) < 1e-13);
    CHECK(worst(basis->odd_second() * odd, odd2) < 1e-11);
    // Int_0^pi e^(cos t) sin t dt = e - 1/e, at the nodes and by the fine rule.
    const double exact = std::exp(1.0) - std::exp(-1.0);
    CHECK(std::abs(basis->sine_weights().dot(even) - exact) < 1e-14);
    CHECK(basis->sine_weights().minCoeff() > 0);
    const auto& fine = basis->fine();
    CHECK(std::abs(fine.weights.dot(fine.odd * odd) - exact) < 1e-14);
    // The last mode is a cosine without slope at the nodes, but with curvature.
    Vec last(n + 1);
    for (Index i = 0; i <= n; ++i) {
        last[i] = i % 2 == 0 ? 1 : -1;
    }
    CHECK((basis->even_first() * last).cwiseAbs().maxCoeff() < 1e-11);
    CHECK(worst(basis->even_second() * last, -static_cast<double>(n * n) * last) < 1e-10);
    Vec cardinal(n + 1);
    for (const double t : {1e-9, 1e-3, 0.7, 1.5707, 3.0, 3.14159}) {
        basis->cardinals(t, cardinal);
        CHECK(std::abs(cardinal.dot(even) - e(t)) < 1e-14);
    }
    basis->cardinals(basis->nodes()[5], cardinal);
    CHECK(cardinal[5] == 1);
    CHECK(cardinal.cwiseAbs().sum() == 1);
}

TEST_CASE("The bending force of spheroids converges faster than any power", "[spectral]") {
    for (const double c : {2.0, 0.6}) {
        std::vector<double> errors;
        for (const Index n : {8, 16, 32, 48}) {
            const auto surface = spectral_surface(ellipse(1.0, c, n));
            const Vec force = Vesicle<double>::force(surface);
            Vec exact(2 * (n + 1));
            for (Index i = 0; i <= n; ++i) {
                const double f = bending_of_spheroid(1.0, c, surface.basis->nodes()[i]);
                exact[i] = f * surface.normal_r[i];
                exact[n + 1 + i] = f * surface.normal_z[i];
            }
            errors.push_back(worst(force, exact) / exact.cwiseAbs().maxCoeff());
        }
        CAPTURE(c, errors);
        // Each doubling gains more than the one before: 4 doublings of a fourth-order scheme would gain 16 each.
        CHECK(errors[1] < errors[0] / 16);
        CHECK(errors[2] < errors[1] / 1000);
        CHECK(errors[3] < 3e-7);
    }
}

TEST_CASE("Measures, curvatures and energy of a spheroid", "[spectral]") {
    const SpectralMeridian<double> spectral;
    const double a = 0.8;
    const double c = 1.5;
    const double pi = detail::pi_value<double>();
    Meridian<double> m = ellipse(a, c, 32);
    m.z.array() += 0.3;
    const Measures<double> measures = spectral.measures(m);
    CHECK(std::abs(measures.area / spheroid_area(a, c) - 1) < 1e-13);
    CHECK(std::abs(measures.volume / (4 * pi * a * a * c / 3) - 1) < 1e-14);
    CHECK(std::abs(measures.centroid - 0.3) < 1e-14);
    CHECK(std::abs(spectral.max_radius(m) - a) < 1e-14);
    const auto [lower, upper] = spectral.pole_curvatures(m);
    CHECK(std::abs(lower - c / (a * a)) < 1e-11);
    CHECK(std::abs(upper - c / (a * a)) < 1e-11);
    CHECK(std::abs(spectral.bending_energy(ellipse(2.0, 2.0, 8)) - 8 * pi) < 1e-12);
    CHECK(std::abs(spectral.bending_energy(m) - spectral.bending_energy(ellipse(a, c, 96))) < 1e-9);
    // The fourth-order estimate for P1 meridians, on many nodes.
    CHECK(std::abs(spectral.bending_energy(m) - bending_energy(ellipse(a, c, 512))) < 1e-6);
    const auto surface = spectral.surface(m);
    CHECK(std::abs(surface.area() / measures.area - 1) < 1e-10);
    CHECK(std::abs(surface.element_area.sum() / measures.area - 1) < 1e-10);
}

TEST_CASE("Volume gradient, tension and divergence", "[spectral]") {
    const Index n = 48;
    const Meridian<double> m = biconcave(0.3, n);
    const SpectralMeridian<double> spectral;
    const auto surface = spectral.surface(m);
    Vec translation = Vec::Zero(2 * (n + 1));
    translation.tail(n + 1).setOnes();
    CHECK(std::abs(surface.flux(translation)) < 1e-13);
    CHECK((surface.divergence * translation).cwiseAbs().maxCoeff() < 1e-11);
    CHECK(worst(surface.divergence * surface.positions(), Vec::Constant(n, 2.0)) < 1e-11);
    // dV in a direction that respects the symmetry.
    Meridian<double> moved = m;
    const double step = 1e-5;
    const Vec d = density(n);
    moved.r += step * d.head(n + 1);
    moved.z += step * d.tail(n + 1);
    const double after = spectral.measures(moved).volume;
    moved.r -= 2 * step * d.head(n + 1);
    moved.z -= 2 * step * d.tail(n + 1);
    CHECK(std::abs((after - spectral.measures(moved).volume) / (2 * step) - surface.flux(d)) < 1e-8);
    // A uniform tension: -2 H n. The adjoint of the divergence: Int gamma div u dA = - Int u.f dA.
    const Vec uniform = surface.tension_force * Vec::Ones(n);
    Vec expected(2 * (n + 1));
    expected << (-2 * surface.mean_curvature).cwiseProduct(surface.normal_r),
        (-2 * surface.mean_curvature).cwiseProduct(surface.normal_z);
    CHECK(worst(uniform, expected) < 1e-11);
    Vec gamma(n);
    for (Index k = 0; k < n; ++k) {
        gamma[k] = std::exp(std::cos(detail::pi_value<double>() * static_cast<double>(k) / static_cast<double>(n - 1)));
    }
    const Vec force = surface.tension_force * gamma;
    const double power = surface.weight.dot(force.head(n + 1).cwiseProduct(d.head(n + 1)) +
                                            force.tail(n + 1).cwiseProduct(d.tail(n + 1)));
    const double stretching = surface.element_area.dot(gamma.cwiseProduct(surface.divergence * d));
    CHECK(std::abs(power) > 1);
    CHECK(std::abs(power + stretching) < 1e-8);
}

TEST_CASE("Drag of a sphere and of spheroids", "[spectral]") {
    CHECK(sphere_settling_error<double>(8) < 1e-14);
    CHECK(translation_error(2.0, prolate_drag(2.0), 8) > 1e-5);
    CHECK(translation_error(2.0, prolate_drag(2.0), 32) < 1e-10);
    CHECK(translation_error(2.0, prolate_drag(2.0), 48) < 1e-13);
    CHECK(translation_error(0.4, oblate_drag(0.4), 16) > 1e-7);
    CHECK(translation_error(0.4, oblate_drag(0.4), 48) < 1e-12);
}

TEST_CASE("The single layer in single and extended precision", "[spectral]") {
    CHECK(sphere_settling_error<float>(8) < 1e-6F);
    CHECK(sphere_settling_error<long double>(8) < 1e-18L);
    SpectralMeridian<long double>::Params params;
    params.tolerance = 1e-17L;
    const Meridian<long double> m = ellipse<long double>(1, 2, 64);
    const Matrix<long double> g = SpectralMeridian<long double>(params).single_layer(m, FreeSpaceKernel<long double>());
    const Vector<long double> pressure = g * spectral_surface(m).normals();
    CHECK(pressure.cwiseAbs().maxCoeff() < 1e-17L);
}

TEST_CASE("A pressure moves nothing, and exchanging forces leaves the power", "[spectral]") {
    const Index n = 64;
    const Meridian<double> m = biconcave(0.3, n);
    const SpectralMeridian<double> spectral;
    const auto surface = spectral.surface(m);
    const Mat g = spectral.single_layer(m, FreeSpaceKernel<double>());
    CHECK((g * surface.normals()).cwiseAbs().maxCoeff() < 1e-12);
    const Vec f = density(n);
    Vec other = Vec::Zero(2 * (n + 1));
    other.tail(n + 1) = m.z;
    Vec weights(2 * (n + 1));
    weights << surface.weight, surface.weight;
    const double there = other.cwiseProduct(weights).dot(g * f);
    const double back = f.cwiseProduct(weights).dot(g * other);
    CHECK(std::abs(there) > 0.1);
    CHECK(std::abs(there - back) < 1e-12);
}

TEST_CASE("Bending dissipates, and every tension acts", "[spectral]") {
    double before = 0;
    for (const Index n : {12, 24}) {
        for (const bool flat : {false, true}) {
            const Meridian<double> m = flat ? biconcave(0.3, n) : ellipse(0.9, 1.3, n);
            const SpectralMeridian<double> spectral;
            const auto surface = spectral.surface(m);
            Mat g = spectral.single_layer(m, FreeSpaceKernel<double>());
            detail::ignore_pressure<double>(surface, 0, g);
            detail::stop_flux<double>(surface, 0, g);
            const Mat schur = surface.divergence * g * surface.tension_force;
            const double smallest = Eigen::JacobiSVD<Mat>(schur).singularValues()[n - 1];
            const Mat bending = g * Vesicle<double>::linearisation(surface, Vec());
            const Mat rate =
                bending - g * surface.tension_force * schur.partialPivLu().solve(surface.divergence * bending);
            const auto eigenvalues = Eigen::EigenSolver<Mat>(rate, false).eigenvalues();
            CAPTURE(n, flat, smallest);
            CHECK(eigenvalues.real().maxCoeff() < 1e-6 * eigenvalues.cwiseAbs().maxCoeff());
            CHECK(eigenvalues.real().minCoeff() < -100);
            if (!flat) {
                CHECK(smallest > 0.9 * before);
                before = smallest;
            }
        }
    }
    CHECK(before > 1e-3);
}

TEST_CASE("Membranes close to themselves", "[spectral]") {
    // Sides 0.01 apart: against four times the modes, and against P1 elements.
    const Index n = 24;
    const FreeSpaceKernel<double> kernel;
    const Vec u = SpectralMeridian<double>().single_layer(biconcave(0.005, n), kernel) * density(n);
    const Vec fine = SpectralMeridian<double>().single_layer(biconcave(0.005, 4 * n), kernel) * density(4 * n);
    CHECK(worst(u, every(4, fine, n)) < 1e-12);
    double before = 0;
    for (const Index k : {4, 8}) {
        const Vec p1 = LinearElements<double>().single_layer(biconcave(0.005, k * n), kernel) * density(k * n);
        const double difference = worst(u, every(k, p1, n));
        CAPTURE(k, difference);
        if (k == 4) {
            before = difference;
        } else {
            CHECK(difference < 0.3 * before);
            CHECK(difference < 1e-4);
        }
    }
}

TEST_CASE("Velocities off the surface, down to the surface", "[spectral]") {
    // Outside a translating sphere: u_z = 3/4 (1/d + z^2/d^3) + (1/d^3 - 3 z^2/d^5)/4.
    const Index n = 12;
    const SpectralMeridian<double> spectral;
    const Meridian<double> m = ellipse(1.0, 1.0, n);
    Vec f = Vec::Zero(2 * (n + 1));
    f.tail(n + 1).setConstant(1.5);
    for (const double d : {1.0, 1.0 + 1e-6, 1.001, 1.1, 3.0}) {
        Meridian<double> targets{Vec(3), Vec(3)};
        const std::array<double, 3> angle{0.0, 0.3, 1.234};
        for (Index i = 0; i < 3; ++i) {
            targets.r[i] = d * std::sin(angle[static_cast<std::size_t>(i)]);
            targets.z[i] = -d * std::cos(angle[static_cast<std::size_t>(i)]);
        }
        if (d == 1.0) {
            targets.r[0] = 0.5;  // inside the fluid moves along; a pole itself is a node
            targets.z[0] = 0.1;
        }
        const Vec u = spectral.single_layer_at(targets, m, FreeSpaceKernel<double>()) * f;
        for (Index i = 0; i < 3; ++i) {
            const double z2 = targets.z[i] * targets.z[i];
            const double rz = targets.r[i] * targets.z[i];
            const double d3 = d * d * d;
            const bool inside = d == 1.0;
            const double uz = inside ? 1 : 0.75 * (1 / d + z2 / d3) + 0.25 * (1 / d3 - 3 * z2 / (d3 * d * d));
            const double ur = inside ? 0 : 0.75 * rz / d3 * (1 - 1 / (d * d));
            CAPTURE(d, i);
            CHECK(std::abs(u[i] - ur) < 1e-10);
            CHECK(std::abs(u[3 + i] - uz) < 1e-10);
        }
    }
}

TEST_CASE("Nodes move along the curve, and area and volume are restored", "[spectral]") {
    SpectralMeridian<double>::Params params;
    params.meshing.density = [](const Point<double>& x) { return 1 + 0.5 * std::exp(-4 * x.z * x.z); };
    const SpectralMeridian<double> spectral(params);
    const double a = 0.8;
    const double c = 1.7;
    const Index n = 48;
    Meridian<double> m = ellipse(a, c, n);
    const Measures<double> before = spectral.measures(m);
    CHECK(spectral.distortion(m) > 1.2);
    REQUIRE(spectral.redistribute(m));
    CHECK(spectral.distortion(m) < 1.001);
    CHECK_FALSE(spectral.redistribute(m));
    double off = 0;
    for (Index i = 0; i <= n; ++i) {
        off = std::max(off, std::abs(std::hypot(m.r[i] / a, m.z[i] / c) - 1));
    }
    CHECK(off < 1e-12);
    const Measures<double> after = spectral.measures(m);
    CHECK(std::abs(after.area / before.area - 1) < 1e-10);
    CHECK(std::abs(after.volume / before.volume - 1) < 1e-10);
    REQUIRE(spectral.restore(m, before.area * 1.01, before.volume * 0.99));
    const Measures<double> restored = spectral.measures(m);
    CHECK(std::abs(restored.area / before.area - 1.01) < 1e-12);
    CHECK(std::abs(restored.volume / before.volume - 0.99) < 1e-12);
    CHECK_FALSE(spectral.restore(m, before.area * 0.5, before.volume));
}

TEST_CASE("The resolution indicator follows the modes", "[spectral]") {
    const SpectralMeridian<double> spectral;
    CHECK(spectral.unresolved(ellipse(1.0, 2.0, 16)) < 1e-14);
    Meridian<double> m = ellipse(1.0, 2.0, 16);
    for (Index i = 0; i <= 16; ++i) {
        m.z[i] += 1e-3 * std::cos(15 * detail::pi_value<double>() * static_cast<double>(i) / 16);
    }
    // 15 * 1e-3 against the slopes 1 and 2 of the ellipse.
    CHECK(std::abs(spectral.unresolved(m) - 0.015 / std::sqrt(5.0)) < 1e-5);
}

TEST_CASE("Stationary vesicles", "[spectral]") {
    const Gravity<double> gravity(47.0);
    const auto coarse = stationary<SpectralMeridian<double>>(gravity, 24);
    const auto fine = stationary<SpectralMeridian<double>>(gravity, 48);
    CHECK(std::abs(coarse.velocity / fine.velocity - 1) < 1e-5);
    CHECK(std::abs(coarse.length / fine.length - 1) < 1e-5);
    // P1 errs by O(h^2): extrapolated from two meshes, fine enough to be spaced alike.
    const auto p1 = stationary<LinearElements<double>>(gravity, 48);
    const auto p2 = stationary<LinearElements<double>>(gravity, 96);
    const auto limit = [](double a, double b) { return b + (b - a) / 3; };
    CHECK(std::abs(limit(p1.velocity, p2.velocity) / fine.velocity - 1) < 1e-5);
    CHECK(std::abs(limit(p1.length, p2.length) / fine.length - 1) < 1e-5);
    const UnboundedPoiseuille<double> flow(0.5);
    const auto small = stationary<SpectralMeridian<double>>(flow, 12);
    const auto large = stationary<SpectralMeridian<double>>(flow, 32);
    CHECK(std::abs(small.velocity / large.velocity - 1) < 1e-4);
    CHECK(std::abs(stationary<SpectralMeridian<double>>(flow, 24).velocity / large.velocity - 1) < 1e-8);
}

TEST_CASE("A rigid sphere settles", "[spectral]") {
    SimulationParams<double> params;
    Simulator<FreeSpaceKernel<double>, SpectralMeridian<double>, RigidBody<double>, Gravity<double>, SemiImplicitEuler,
              DenseLU<double>>
        run(sphere<double>(8), Gravity<double>(9.0), params);
    CHECK(std::abs(run.step().velocity + 2) < 1e-12);
}

TEST_CASE("A sphere in a tube", "[spectral]") {
    // The wall's correction comes from its own points, halved where the film is thin.
    const auto drag = [](auto discretization, double confinement, Index n) {
        using Discretization = decltype(discretization);
        TubeKernel<double>::Params params;
        params.tolerance = 1e-11;
        const double pi = detail::pi_value<double>();
        Simulator<TubeKernel<double>, Discretization, RigidBody<double>, Gravity<double>, SemiImplicitEuler,
                  DenseLU<double>>
            run(ellipse(1.0, 1.0, n), Gravity<double>(1.0), {}, TubeKernel<double>(1 / confinement, params),
                std::move(discretization));
        return -4 * pi / 3 / (6 * pi * run.step().velocity);
    };
    const SpectralMeridian<double> spectral;
    // Bohlin's series in a wide tube: 1/K = 1 - 2.10443 L + 2.08877 L^3 - 0.94813 L^5 + ..., to its printed digits.
    const double bohlin = 1 - 0.210443 + 2.08877e-3 - 0.94813e-5;
    CHECK(std::abs(1 / drag(spectral, 0.1, 16) - bohlin) < 1e-5);
    const double fine = drag(spectral, 0.5, 24);
    // Haberman & Sayre's series in 30 digits.
    CHECK(std::abs(fine - 5.94737425) < 6e-9);
    CHECK(std::abs(drag(spectral, 0.5, 12) / fine - 1) < 1e-9);
    CHECK(std::abs(drag(spectral, 0.9, 24) / drag(spectral, 0.9, 40) - 1) < 1e-6);
    // P1 errs by O(h^2).
    const LinearElements<double> linear;
    const double p1 = drag(linear, 0.5, 32);
    const double p2 = drag(linear, 0.5, 64);
    CHECK(std::abs((p2 + (p2 - p1) / 3) / fine - 1) < 1e-4);
}

TEST_CASE("Bad parameters and shapes are reported", "[spectral]") {
    SpectralMeridian<double>::Params params;
    params.tolerance = 0;
    CHECK_THROWS_AS(SpectralMeridian<double>(params), InvalidArgument);
    params.tolerance = 1e-6;
    params.meshing.largest_distortion = 1;
    CHECK_THROWS_AS(SpectralMeridian<double>(params), InvalidArgument);
    CHECK_THROWS_AS(SpectralMeridian<double>().redistributed(ellipse(1.0, 1.0, 8), 4), InvalidArgument);
    // Not finite: an answer that is not finite, not an endless halving of panels.
    Meridian<double> m = ellipse(1.0, 2.0, 16);
    m.z[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(SpectralMeridian<double>().single_layer(m, FreeSpaceKernel<double>()).allFinite());
}
