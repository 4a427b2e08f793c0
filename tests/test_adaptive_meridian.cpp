// SPDX-License-Identifier: MIT
// Adaptive discretisation: orders, against closed forms and the series; derivatives against differences; nodes that
// follow the shape; tubes under tension, which only local resolution carries.
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using Vec = Vector<double>;
const double pi = detail::pi_value<double>();

template <class S>
Meridian<S> ellipse(S a, S c, Index n) {
    using std::cos;
    using std::sin;
    Meridian<S> m{Vector<S>(n + 1), Vector<S>(n + 1)};
    for (Index i = 0; i <= n; ++i) {
        const S t = detail::pi_value<S>() * S(i) / S(n);
        m.r[i] = a * sin(t);
        m.z[i] = -c * cos(t);
    }
    m.r[0] = m.r[n] = 0;
    return m;
}

template <class S = double>
AdaptiveMeridian<S> of_half_width(Index half, S tolerance = S(1e-12)) {
    typename AdaptiveMeridian<S>::Params params;
    params.meshing.half_width = half;
    params.tolerance = tolerance;
    return AdaptiveMeridian<S>(params);
}

double order(double coarse, double fine) {
    return std::log2(coarse / fine);
}

/// In extended precision: four derivatives magnify rounding by n^4.
double bending_force_error(Index half, Index n) {
    using S = long double;
    const Meridian<S> m = ellipse(S(1), S(1.6L), n);
    const Vector<S> series = Vesicle<S>::force(SpectralMeridian<S>().surface(m));
    const Vector<S> own = Vesicle<S>::force(of_half_width<S>(half).surface(m));
    return static_cast<double>((own - series).cwiseAbs().maxCoeff() / series.cwiseAbs().maxCoeff());
}

double layer_error(Index half, Index n) {
    const Meridian<double> m = ellipse(1.0, 1.6, n);
    Vec f(2 * (n + 1));
    for (Index i = 0; i <= n; ++i) {
        const double t = pi * double(i) / double(n);
        f[i] = std::sin(t) * std::exp(std::cos(t));
        f[n + 1 + i] = std::sin(2 * std::cos(t) + 0.3);
    }
    const FreeSpaceKernel<double> kernel;
    SpectralMeridian<double>::Params series;
    series.tolerance = 1e-13;
    const Vec exact = SpectralMeridian<double>(series).single_layer(m, kernel) * f;
    const Vec own = of_half_width(half).single_layer(m, kernel) * f;
    return (own - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

/// A cylinder of radius a between hemispheres.
Meridian<double> capsule(double a, double half_length, Index n) {
    Meridian<double> m{Vec(n + 1), Vec(n + 1)};
    const double total = pi * a + 2 * half_length;
    for (Index i = 0; i <= n; ++i) {
        const double s = total * double(i) / double(n);
        const double cap = pi * a / 2;
        if (s < cap) {
            m.r[i] = a * std::sin(s / a);
            m.z[i] = -half_length - a * std::cos(s / a);
        } else if (s <= cap + 2 * half_length) {
            m.r[i] = a;
            m.z[i] = s - cap - half_length;
        } else {
            const double angle = (total - s) / a;
            m.r[i] = a * std::sin(angle);
            m.z[i] = half_length + a * std::cos(angle);
        }
    }
    m.r[0] = m.r[n] = 0;
    return m;
}

}  // namespace

TEST_CASE("adaptive: polynomials are exact up to their degree, with parity at the poles") {
    for (const Index half : {2, 3, 4, 5, 6}) {
        const Index n = 4 * half;
        // Even about 0 and n: cosines; polynomials in the interior.
        Vec f(n + 1);
        const auto exact = [&](double x) { return std::pow((x - double(n) / 2) / double(n), 2 * half - 1); };
        for (Index i = 0; i <= n; ++i) {
            f[i] = exact(double(i));
        }
        const detail::LocalPolynomials<double> p(f, 1, half);
        const Index e = n / 2;
        for (const double t : {0.0, 0.3, 1.0}) {
            CHECK(p.value(e, t) == Approx(exact(double(e) + t)).margin(1e-14));
        }
        CHECK(p.integral(e, 1.0) ==
              Approx(double(n) / double(2 * half) * std::pow(1.0 / double(n), 2 * half)).margin(1e-15));
        const auto stencils = detail::local_stencils<double>(half);
        CHECK(std::abs(stencils->first.sum()) < 1e-14);
        CHECK(std::abs(stencils->second.sum()) < 1e-13);
        CHECK(std::abs(stencils->middle.sum() - 1) < 1e-14);
    }
}

TEST_CASE("adaptive: operators and layers converge at the order of the polynomials") {
    for (const Index half : {2, 3, 4}) {
        INFO("half width " << half);
        // Four derivatives lose nothing on nodes that are smooth in the index.
        CHECK(order(bending_force_error(half, 64), bending_force_error(half, 128)) > double(2 * half) - 0.5);
        CHECK(order(layer_error(half, 24), layer_error(half, 48)) > double(2 * half) - 0.5);
    }
    CHECK(bending_force_error(4, 64) < 1e-6);
    CHECK(layer_error(4, 48) < 1e-8);
}

TEST_CASE("adaptive: a sphere settles at 2/9, in every type") {
    const auto error = [](auto one, Index n) {
        using S = decltype(one);
        const auto d = of_half_width<S>(4, 64 * std::numeric_limits<S>::epsilon());
        const auto m = d.redistributed(ellipse(S(1), S(1), n), n);
        Scene scene(FreeSpaceKernel<S>(), d, RigidBody<S>(), Gravity<S>(S(9) / 2), DenseLU<S>());
        return std::abs(double(scene.evaluate(Configuration<S>{m, S(0), {}}, S(0)).velocity + S(1)));
    };
    CHECK(error(1.0F, 24) < 1e-4);
    CHECK(error(1.0, 48) < 1e-8);
    CHECK(error(1.0L, 48) < 1e-8);
    CHECK(order(error(1.0, 24), error(1.0, 48)) > 7);
}

TEST_CASE("adaptive: measures, the volume's gradient and translations") {
    const AdaptiveMeridian<double> d;
    Meridian<double> m = ellipse(1.0, 1.6, 48);
    const Measures<double> measures = d.measures(m);
    CHECK(measures.volume == Approx(4 * pi / 3 * 1.6).epsilon(1e-9));
    CHECK(std::abs(measures.centroid) < 1e-14);
    CHECK(d.max_radius(m) == Approx(1).epsilon(1e-12));
    CHECK(d.bending_energy(m) == Approx(SpectralMeridian<double>().bending_energy(m)).epsilon(1e-7));
    const auto surface = d.surface(m);
    CHECK(surface.area() == Approx(measures.area).epsilon(1e-13));
    Vec translation = Vec::Zero(2 * m.nodes());
    translation.tail(m.nodes()).setOnes();
    CHECK(std::abs(surface.flux(translation)) < 1e-13);
    CHECK((surface.divergence * translation).cwiseAbs().maxCoeff() < 1e-12);
    for (const Index j : {1, 7, 24}) {
        const double h = 1e-5;
        const auto volume = [&](double by) {
            Meridian<double> moved = m;
            moved.r[j] += by;
            return d.measures(moved).volume;
        };
        CHECK(surface.volume_gradient[j] == Approx((volume(h) - volume(-h)) / (2 * h)).epsilon(1e-8));
    }
    Meridian<double> other = m;
    REQUIRE(d.restore(other, 1.02 * measures.area, 0.99 * measures.volume));
    CHECK(d.measures(other).area == Approx(1.02 * measures.area).epsilon(1e-12));
    CHECK(d.measures(other).volume == Approx(0.99 * measures.volume).epsilon(1e-12));
}

TEST_CASE("a vesicle's linearisation is the derivative of its force at constant tension") {
    const auto check = [](const auto& d) {
        Meridian<double> m = d.redistributed(ellipse(0.9, 1.7, 64), 32);
        m.z.array() += 0.1 * m.r.array().square() * m.z.array() + 0.1 * m.r.array().square();
        const auto surface = d.surface(m);
        Vec tension(surface.divergence.rows());
        for (Index e = 0; e < tension.size(); ++e) {
            tension[e] = 3 + std::cos(0.1 * double(e));
        }
        const Matrix<double> j = Vesicle<double>::linearisation(surface, tension);
        const auto force = [&](const Meridian<double>& shape) {
            const auto at = d.surface(shape);
            return Vec(Vesicle<double>::force(at) + at.tension_force * tension);
        };
        const Index n = m.nodes();
        for (const Index node : {1, 4, 16, 31}) {
            for (const bool along : {false, true}) {
                const double h = 1e-6;
                Meridian<double> up = m;
                Meridian<double> down = m;
                (along ? up.z : up.r)[node] += h;
                (along ? down.z : down.r)[node] -= h;
                Vec difference = (force(up) - force(down)) / (2 * h) - j.col((along ? n : 0) + node);
                // At the poles u_r = 0.
                difference[0] = difference[n - 1] = 0;
                CHECK(difference.cwiseAbs().maxCoeff() < 1e-6 * j.col((along ? n : 0) + node).cwiseAbs().maxCoeff());
            }
        }
        // Nothing bends where all moves alike.
        Vec translation = Vec::Zero(2 * n);
        translation.tail(n).setOnes();
        CHECK((j * translation).cwiseAbs().maxCoeff() < 1e-12 * j.cwiseAbs().maxCoeff());
    };
    check(AdaptiveMeridian<double>());
    check(SpectralMeridian<double>());
}

TEST_CASE("adaptive: nodes follow curvature, and their number the shape") {
    AdaptiveMeridian<double>::Params params;
    params.meshing.resolution = 8;
    const AdaptiveMeridian<double> d(params);
    const auto settled = [&](Meridian<double> m) {
        for (int i = 0; i < 6; ++i) {
            m = d.redistributed(m, d.wanted_elements(m));
        }
        return m;
    };
    const Meridian<double> round = settled(ellipse(1.0, 1.0, 64));
    CHECK(round.elements() == Approx(8 * pi * std::sqrt(0.25 + 1 + 0.16)).margin(1));
    CHECK(d.distortion(round) < 1.05);
    Meridian<double> tube = settled(capsule(0.05, 1.0, 400));
    // 0.4/0.05 a unit of length, times 8.
    CHECK(tube.elements() > 128);
    CHECK(tube.elements() < 260);
    CHECK(d.distortion(tube) < 1.2);
    CHECK(d.measures(tube).area == Approx(4 * pi * 0.0025 + 2 * pi * 0.05 * 2).epsilon(1e-3));
    CHECK_FALSE(d.redistribute(tube));
    // Fewer again, once they are not needed.
    Meridian<double> coarse = round;
    coarse = d.redistributed(coarse, 3 * round.elements());
    CHECK(d.redistribute(coarse));
    CHECK(coarse.elements() == Approx(double(round.elements())).margin(2));
    CHECK(d.unresolved(round) < 1e-4);
    CHECK(d.unresolved(capsule(0.1, 1.0, 24)) > 100 * d.unresolved(round));
}

TEST_CASE("adaptive: redistribution keeps the shape, and carries a reference") {
    const AdaptiveMeridian<double> d;
    Meridian<double> m = ellipse(0.8, 1.5, 48);
    Meridian<double> reference = ellipse(1.0, 1.0, 48);
    const double energy = d.bending_energy(m);
    for (int i = 0; i < 100; ++i) {
        // To and fro between two spacings.
        m = d.redistributed(m, 48 + i % 2, reference);
    }
    CHECK(d.bending_energy(m) == Approx(energy).epsilon(1e-6));
    CHECK(d.measures(m).volume == Approx(4 * pi / 3 * 0.64 * 1.5).epsilon(1e-7));
    CHECK(reference.nodes() == m.nodes());
    for (Index i = 0; i < m.nodes(); ++i) {
        CHECK(m.r[i] * m.r[i] / 0.64 + m.z[i] * m.z[i] / 2.25 == Approx(1).epsilon(1e-6));
        CHECK(reference.r[i] == Approx(m.r[i] / 0.8).margin(1e-6));
    }
}

TEST_CASE("adaptive: a stationary vesicle agrees with the series") {
    const FreeSpaceKernel<double> kernel;
    const auto velocity = [&](const auto& d, Index n) {
        Scene scene(kernel, d, Vesicle<double>(), Gravity<double>(47.0), DenseLU<double>());
        auto shape = d.redistributed(spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 200), n);
        SimulationParams<double> params;
        params.tolerance = 1e-3;
        Simulator simulator(scene, ExtrapolatedEulerOfOrder(1), shape, params);
        simulator.run();
        return StationarySolver(scene)
            .solve(simulator.configuration().shape, 4 * pi + 0.6, 4 * pi / 3)
            .instants.front()
            .velocity;
    };
    // Series of 96 modes, examples/settling_vesicle.
    const double exact = -10.5360603462;
    CHECK(velocity(SpectralMeridian<double>(), 64) == Approx(exact).epsilon(1e-9));
    CHECK(velocity(of_half_width(4, 1e-10), 40) == Approx(exact).epsilon(5e-7));
    CHECK(velocity(of_half_width(6, 1e-10), 60) == Approx(exact).epsilon(1e-9));
}

TEST_CASE("adaptive: a heavy vesicle pulls a tube that P1 elements and series do not carry") {
    // Fig. 8 (excess area 0.93, Bond number 392): at t = 0.86 P1 elements failed with a velocity of 26034.
    AdaptiveMeridian<double>::Params meshing;
    meshing.tolerance = 1e-6;
    meshing.meshing.resolution = 5;
    const AdaptiveMeridian<double> d(meshing);
    Scene scene(FreeSpaceKernel<double>(), d, Vesicle<double>(), Gravity<double>(392.0), DenseLU<double>());
    auto shape = spheroid_of_excess_area<double>(0.93, SpheroidKind::prolate, 200);
    for (int i = 0; i < 4; ++i) {
        shape = d.redistributed(shape, d.wanted_elements(shape));
    }
    SimulationParams<double> params;
    params.longest_time = 1;
    params.step_tolerance = 1e-3;
    Simulator simulator(scene, ThirdOrder(), shape, params);
    simulator.run();
    const auto& end = simulator.history().back();
    CHECK(end.time == 1);
    CHECK(end.velocity == Approx(-83.01).epsilon(1e-3));
    CHECK(end.length == Approx(4.007).epsilon(3e-3));
    CHECK(std::abs(end.area_drift) < 1e-12);
    const auto& instant = simulator.instant();
    // The tube's radius is sqrt(kappa/(2 tension)) near the body, where the tension is largest.
    const Meridian<double>& m = simulator.configuration().shape;
    Index neck = 0;
    for (Index i = 1; i + 1 < m.nodes(); ++i) {
        if (m.z[i] > 1 && m.r[i] <= m.r[i - 1] && m.r[i] < m.r[i + 1] && (neck == 0 || m.r[i] < m.r[neck])) {
            neck = i;
        }
    }
    REQUIRE(neck > 0);
    const double tension = instant.surface.at_nodes(instant.solution.tension)[neck];
    CHECK(m.r[neck] * std::sqrt(2 * tension) == Approx(1).epsilon(0.15));
}

TEST_CASE("adaptive: parameters out of range are named") {
    const auto refused = [](auto change, const std::string& name) {
        AdaptiveMeridian<double>::Params params;
        change(params);
        CHECK_THROWS_WITH(AdaptiveMeridian<double>(params), Catch::Contains(name));
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused([](auto& p) { p.meshing.half_width = 1; }, "half width");
    refused([](auto& p) { p.meshing.half_width = 7; }, "half width");
    refused([](auto& p) { p.meshing.base = 0; }, "base of the node density");
    refused([&](auto& p) { p.meshing.azimuthal_weight = nan; }, "azimuthal");
    refused([](auto& p) { p.meshing.smoothing = 0; }, "smoothing");
    refused([](auto& p) { p.meshing.resolution = 0; }, "resolution");
    refused([](auto& p) { p.meshing.least_elements = 4; }, "least number");
    refused([](auto& p) { p.meshing.most_elements = 20; }, "largest number");
    refused([](auto& p) { p.meshing.largest_distortion = 1; }, "largest distortion");
    refused([](auto& p) { p.tolerance = 0; }, "quadrature tolerance");
}
