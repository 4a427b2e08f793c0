// SPDX-License-Identifier: MIT
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/tube.hpp>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace axistokes;
using axistokes::test::mentions;
using axistokes::test::refusal;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

template <class S>
TubeKernel<S> tube(S radius, S tolerance) {
    typename TubeKernel<S>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<S>(radius, params);
}

template <class S>
S largest(const KernelBlock<S>& m) {
    using std::abs;
    return std::max({abs(m.rr), abs(m.rz), abs(m.zr), abs(m.zz)});
}

template <class S>
KernelBlock<S> difference(const KernelBlock<S>& a, const KernelBlock<S>& b) {
    return {a.rr - b.rr, a.rz - b.rz, a.zr - b.zr, a.zz - b.zz};
}

/// The integrands of the correction from scratch: the ring's own Fourier coefficients at the wall (r = Rc = 1) are
/// cancelled by the modes A (I0, I1) and B (2 I0 + t I1, t I0), which are regular on the axis. Unscaled functions, 2x2
/// systems by Cramer's rule, 50 digits against the cancellation.
KernelBlock<Wide> integrand(const Wide& zeta, const Wide& r0, const Wide& r, const Wide& zh) {
    // Checked against Boost's in test_bessel.cpp, and fast at large arguments too.
    const auto i = [](const Wide& x) {
        const auto scaled = scaled_bessel_i<Wide>(x);
        const Wide up = exp(x);
        return std::pair<Wide, Wide>{Wide(up * scaled.i0), Wide(up * scaled.i1)};
    };
    const Wide t = zeta * r0;
    const Wide s = zeta * r;
    const auto [i0w, i1w] = i(zeta);
    const auto [i0s, i1s] = i(s);
    const auto at_target = i(t);
    const Wide i0t = at_target.first;  // a structured binding cannot be captured
    const Wide i1t = at_target.second;
    const auto scaled = scaled_bessel_k<Wide>(zeta);
    const Wide down = exp(-zeta);
    const Wide k0w = down * scaled.k0;
    const Wide k1w = down * scaled.k1;
    // Ring at radius r, force along z: u_z cos(zeta zh), u_r sin(zeta zh); along r: u_r cos, u_z sin.
    const Wide zz = 4 * (2 * i0s * k0w - zeta * i0s * k1w + s * i1s * k0w);
    const Wide rz = 4 * (s * i1s * k1w - zeta * i0s * k0w);
    const Wide rr = 4 * (2 * i1s * k1w + zeta * i1s * k0w - s * i0s * k1w);
    const Wide zr = 4 * (s * i0s * k0w - zeta * i1s * k1w);
    // Modes as functions of z0 - z: u_z = f_z cos(zeta zh), u_r = -f_r sin(zeta zh), or shifted by a quarter of a wave
    // u_z = f_z sin, u_r = f_r cos.
    const Wide az = i0w;
    const Wide ar = i1w;
    const Wide bz = 2 * i0w + zeta * i1w;
    const Wide br = zeta * i0w;
    const Wide det = az * br - bz * ar;
    const auto solve = [&](const Wide& uz, const Wide& ur) {
        const Wide a = (uz * br - bz * ur) / det;
        const Wide b = (az * ur - ar * uz) / det;
        return std::pair<Wide, Wide>{Wide(a * i0t + b * (2 * i0t + t * i1t)), Wide(a * i1t + b * t * i0t)};
    };
    const auto [z_of_z, r_of_z] = solve(-zz, rz);
    const auto [z_of_r, r_of_r] = solve(-zr, -rr);
    const Wide c = cos(zeta * zh);
    const Wide d = sin(zeta * zh);
    return {r * r_of_r * c, -r * r_of_z * d, r * z_of_r * d, r * z_of_z * c};
}

/// By Gauss-Legendre on panels that follow the logarithm at 0, the oscillation and the decay.
KernelBlock<Wide> reference(const Wide& r0, const Wide& r, const Wide& zh) {
    using Rule = boost::math::quadrature::gauss<double, 15>;
    const double cut = 35 / static_cast<double>(2 - r - r0);
    const double longest = 8 / static_cast<double>(abs(zh) + Wide(1e-6));
    KernelBlock<Wide> sum;
    double begin = 1e-14;
    while (begin < cut) {
        const double end = std::min({2 * begin, begin + longest, cut});
        const auto add = [&](double zeta, double weight) {
            const KernelBlock<Wide> f = integrand(Wide(zeta), r0, r, zh);
            sum = {sum.rr + weight * f.rr, sum.rz + weight * f.rz, sum.zr + weight * f.zr, sum.zz + weight * f.zz};
        };
        const double half = (end - begin) / 2;
        add(begin + half, half * Rule::weights()[0]);  // odd: the first abscissa is the middle
        for (std::size_t q = 1; q < Rule::abscissa().size(); ++q) {
            add(begin + half * (1 + Rule::abscissa()[q]), half * Rule::weights()[q]);
            add(begin + half * (1 - Rule::abscissa()[q]), half * Rule::weights()[q]);
        }
        begin = end;
    }
    return sum;
}

/// Random points of a vesicle that nearly fills a tube of radius 0.55, five radii long.
Meridian<double> cloud(Index n, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Meridian<double> m{Vector<double>(n), Vector<double>(n)};
    for (Index i = 0; i < n; ++i) {
        m.r[i] = i % 7 == 0 ? 0.0 : 0.52 - 0.5 * unit(engine) * unit(engine);
        m.z[i] = 5 * unit(engine);
    }
    return m;
}

RegularQuadrature<double> one_to_one(const Meridian<double>& points) {
    RegularQuadrature<double> q{points, points.z, {}};
    q.weights.resize(points.nodes(), points.nodes());
    q.weights.setIdentity();
    return q;
}

/// A cylinder with hemispherical ends, of volume 4 pi/3, `film` away from the wall of a tube.
Meridian<double> capsule(double tube_radius, double film, Index elements) {
    const double a = tube_radius - film;
    const double cylinder = (4.0 / 3 - 4.0 / 3 * a * a * a) / (a * a);
    const double cap = test::pi * a / 2;
    Meridian<double> m{Vector<double>(elements + 1), Vector<double>(elements + 1)};
    for (Index i = 0; i <= elements; ++i) {
        const double s = (2 * cap + cylinder) * static_cast<double>(i) / static_cast<double>(elements);
        if (s < cap) {
            m.r[i] = a * std::sin(s / a);
            m.z[i] = -cylinder / 2 - a * std::cos(s / a);
        } else if (s < cap + cylinder) {
            m.r[i] = a;
            m.z[i] = s - cap - cylinder / 2;
        } else {
            m.r[i] = a * std::cos((s - cap - cylinder) / a);
            m.z[i] = cylinder / 2 + a * std::sin((s - cap - cylinder) / a);
        }
    }
    m.r[0] = m.r[elements] = 0;
    return m;
}

}  // namespace

TEST_CASE("the velocity on the wall vanishes", "[tube]") {
    for (const double tolerance : {1e-6, 1e-9, 1e-13}) {
        const auto kernel = tube(1.0, tolerance);
        for (const double gap : {0.9, 0.5, 0.1, 0.03, 1e-2, 1e-3}) {
            for (const double z : {0.0, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 30.0, -0.3, -7.0}) {
                INFO("tolerance " << tolerance << ", gap " << gap << ", z " << z);
                const Point<double> source{1 - gap, z};
                const double scale = largest(kernel.singular({1, 0}, source));
                CHECK(largest(kernel.total({1, 0}, source)) < std::max(tolerance, 1e-13 * 5) * scale);
            }
        }
    }
}

TEST_CASE("the correction is that of an independent integral in 50 digits", "[tube]") {
    const auto kernel = tube(1.0, 1e-12);
    struct Pair {
        double r0, r, z;
    };
    for (const auto& [r0, r, z] : std::vector<Pair>{{0.5, 0.7, 0.3},
                                                    {0, 0.7, 0.3},
                                                    {1e-8, 0.3, -1.1},
                                                    {0.9, 1e-8, 0.4},
                                                    {0.4, 0.2, 3},
                                                    {0.97, 0.98, 0},
                                                    {0.97, 0.98, 0.05},
                                                    {0.999, 0.9995, 0},
                                                    {0.9991, 0.9993, 1e-3},
                                                    {0.9991, 0.9993, 0.02}}) {
        INFO("r0 " << r0 << ", r " << r << ", z " << z);
        const KernelBlock<double> c = kernel.correction({r0, 0}, {r, z});
        const KernelBlock<Wide> exact = reference(Wide(r0), Wide(r), Wide(z));
        const KernelBlock<double> rounded{static_cast<double>(exact.rr), static_cast<double>(exact.rz),
                                          static_cast<double>(exact.zr), static_cast<double>(exact.zz)};
        CHECK(largest(difference(c, rounded)) < 1e-10 * largest(rounded));
    }
}

TEST_CASE("far apart, close to the wall, the correction cancels free space", "[tube]") {
    // The total decays like exp(-4.466 z): below 1e-11 from z = 6 on.
    const auto kernel = tube(1.0, 1e-13);
    for (const double z : {6.0, 10.0, 20.0, 30.0, -8.0}) {
        for (const double r0 : {0.0, 0.3, 0.9995}) {
            const Point<double> source{0.9992, z};
            const double scale = largest(kernel.singular({r0, 0}, source));
            CHECK(largest(kernel.total({r0, 0}, source)) < 1e-10 * scale);
        }
    }
}

TEST_CASE("the tube's decay is that of its first eigenvalue", "[tube]") {
    const auto kernel = tube(1.0, 1e-13);
    // Largest total velocity over one wave length 2 pi/1.467 of the eigenfunction's oscillation.
    const auto envelope = [&](double begin) {
        double top = 0;
        for (double z = begin; z < begin + 2 * test::pi / 1.467; z += 0.05) {
            top = std::max(top, std::exp(4.466 * (z - begin)) * std::abs(kernel.total({0.4, 0}, {0.5, z}).zz));
        }
        return top;
    };
    const double rate = -std::log(envelope(2.0) / envelope(1.0));
    CHECK(rate == Approx(4.466).epsilon(0.02));
}

TEST_CASE("the correction is reciprocal, homogeneous and symmetric", "[tube]") {
    const auto kernel = tube(1.0, 1e-12);
    const auto wide = tube(7.0, 1e-12);
    const Point<double> a{0.6, 0.2};
    const Point<double> b{0.85, -0.35};
    const auto ab = kernel.correction(a, b);
    const auto ba = kernel.correction(b, a);
    CHECK(ab.rr / b.r == Approx(ba.rr / a.r).epsilon(1e-10));
    CHECK(ab.rz / b.r == Approx(ba.zr / a.r).epsilon(1e-10));
    CHECK(ab.zr / b.r == Approx(ba.rz / a.r).epsilon(1e-10));
    CHECK(ab.zz / b.r == Approx(ba.zz / a.r).epsilon(1e-10));
    const auto scaled = wide.correction({7 * a.r, 7 * a.z}, {7 * b.r, 7 * b.z});
    CHECK(largest(difference(scaled, ab)) < 1e-11);
    const auto mirrored = kernel.correction({a.r, -a.z}, {b.r, -b.z});
    CHECK(mirrored.rz == Approx(-ab.rz).epsilon(1e-11));
    CHECK(mirrored.zz == Approx(ab.zz).epsilon(1e-11));
}

TEST_CASE("a ring moves no fluid through the tube", "[tube]") {
    const auto kernel = tube(1.0, 1e-12);
    using Rule = boost::math::quadrature::gauss<double, 30>;
    for (const double z : {0.2, 1.0, -2.0}) {
        for (const double r : {0.3, 0.9}) {
            const auto flux_density = [&](double r0, bool radial) {
                const auto m = kernel.total({r0, 0}, {r, z});
                return 2 * test::pi * r0 * (radial ? m.zr : m.zz);
            };
            CHECK(std::abs(Rule::integrate([&](double x) { return flux_density(x, false); }, 0.0, 1.0)) < 1e-9);
            CHECK(std::abs(Rule::integrate([&](double x) { return flux_density(x, true); }, 0.0, 1.0)) < 1e-9);
        }
    }
}

TEST_CASE("the batch agrees with single pairs to its tolerance", "[tube]") {
    const Meridian<double> targets = cloud(29, 1);
    const Meridian<double> sources = cloud(31, 2);
    const RegularQuadrature<double> quadrature = one_to_one(sources);
    const auto exact = tube(0.55, 1e-14);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        const auto kernel = tube(0.55, tolerance);
        Matrix<double> out = Matrix<double>::Zero(2 * 29, 2 * 31);
        kernel.regular(
            targets, [&](double) -> const RegularQuadrature<double>& { return quadrature; }, out);
        double worst = 0;
        double scale = 0;
        for (Index i = 0; i < 29; ++i) {
            for (Index j = 0; j < 31; ++j) {
                const auto c = exact.correction({targets.r[i], targets.z[i]}, {sources.r[j], sources.z[j]});
                const KernelBlock<double> entry{out(i, j), out(i, 31 + j), out(29 + i, j), out(29 + i, 31 + j)};
                worst = std::max(worst, largest(difference(entry, c)));
                scale = std::max(scale, largest(c));
            }
        }
        INFO("tolerance " << tolerance);
        CHECK(worst < tolerance * scale);
    }
}

TEST_CASE("the correction of a long vesicle's single layer meets its tolerance", "[tube]") {
    const FreeSpaceKernel<double> free_space;
    const auto correction = [&](const Meridian<double>& m, double tolerance) {
        LinearElements<double>::Params params;
        params.tolerance = tolerance;
        const LinearElements<double> elements(params);
        return Matrix<double>(elements.single_layer(m, tube(0.55, tolerance)) - elements.single_layer(m, free_space));
    };
    for (const double film : {0.2, 0.03, 0.01}) {
        const Meridian<double> m = capsule(0.55, film, 130);
        const Matrix<double> exact = correction(m, 1e-13);
        const double scale = exact.cwiseAbs().maxCoeff();
        for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
            INFO("film " << film << ", tolerance " << tolerance);
            CHECK((correction(m, tolerance) - exact).cwiseAbs().maxCoeff() < tolerance * scale);
        }
    }
}

TEST_CASE("factors of many wave numbers at once are those of single ones", "[tube]") {
    // On the axis, near it and near the wall: both branches of the Bessel functions; few panels and many equal ones.
    for (const double least_gap : {0.004, 0.3}) {
        const detail::TubeSpectrum<double> spectrum(1.0, 0, 2.0, least_gap, 1e-10);
        detail::TubeWaves<double> waves(spectrum);
        const std::size_t n = spectrum.size();
        double worst = 0;
        const auto compare = [&](double got, double expected, double scale) {
            worst = std::max(worst, std::abs(got - expected) / scale);
        };
        for (const double r : {0.0, 1e-9, 0.1, 0.7, 0.998}) {
            const double gap = 1 - r;
            const std::size_t relevant = spectrum.relevant(gap + least_gap / 2);
            for (const double z : {-0.9, 0.0, 0.4}) {
                for (const bool is_source : {false, true}) {
                    std::vector<double> row_r(4 * n, 0.0);
                    std::vector<double> row_z(4 * n, 0.0);
                    if (is_source) {
                        waves.source(r, gap, z, relevant, row_r.data(), row_z.data());
                    } else {
                        waves.target(r, gap, z, relevant, row_r.data(), row_z.data());
                    }
                    for (std::size_t k = 0; k < n; ++k) {
                        const bool reaches = k < relevant;
                        const auto u = is_source ? spectrum.source(k, r, gap) : spectrum.target(k, r, gap);
                        const double angle = spectrum.zeta(k) * z;
                        const double c = reaches ? std::cos(angle) : 0;
                        const double d = reaches ? std::sin(angle) : 0;
                        // Sine and exponential inherit the rounding of their arguments.
                        const double scale = (std::abs(u.zp) + std::abs(u.zq) + std::abs(u.rp) + std::abs(u.rq)) *
                                             (1 + std::abs(angle) + spectrum.zeta(k) * gap);
                        compare(row_z[k], u.zp * c, scale);
                        compare(row_z[k + n], u.zq * c, scale);
                        compare(row_z[k + 2 * n], u.zp * d, scale);
                        compare(row_z[k + 3 * n], u.zq * d, scale);
                        compare(row_r[k], u.rp * d, scale);
                        compare(row_r[k + n], u.rq * d, scale);
                        compare(row_r[k + 2 * n], -u.rp * c, scale);
                        compare(row_r[k + 3 * n], -u.rq * c, scale);
                    }
                }
            }
        }
        INFO("least gap " << least_gap);
        CHECK(worst < 1e-14);
    }
}

TEST_CASE("the flow of a ring is free of divergence", "[tube]") {
    const auto kernel = tube(1.0, 1e-13);
    for (const Point<double> source : {Point<double>{0.6, 0.1}, Point<double>{0.97, -0.3}}) {
        for (const Point<double> x : {Point<double>{0.3, 0.2}, Point<double>{0.9, 0.4}, Point<double>{0.8, -1.5}}) {
            // Central differences for a radial and for an axial force: divergence, and its part along z for scale.
            const auto differences = [&](double h) {
                const auto up = kernel.total({x.r, x.z + h}, source);
                const auto down = kernel.total({x.r, x.z - h}, source);
                const auto out = kernel.total({x.r + h, x.z}, source);
                const auto in = kernel.total({x.r - h, x.z}, source);
                const double z_radial = (up.zr - down.zr) / (2 * h);
                const double z_axial = (up.zz - down.zz) / (2 * h);
                const double radial = ((x.r + h) * out.rr - (x.r - h) * in.rr) / (2 * h * x.r) + z_radial;
                const double axial = ((x.r + h) * out.rz - (x.r - h) * in.rz) / (2 * h * x.r) + z_axial;
                return std::array<double, 4>{radial, axial, z_radial, z_axial};
            };
            const auto fine = differences(2e-3);
            const auto coarse = differences(4e-3);
            for (std::size_t i = 0; i < 2; ++i) {
                INFO("source at r = " << source.r << ", target at " << x.r << ", " << x.z);
                CHECK(std::abs(4 * fine[i] - coarse[i]) / 3 < 1e-6 * std::abs(fine[i + 2]));
            }
        }
    }
}

TEST_CASE("the pressure drop is that of the flow", "[tube]") {
    // With the axial momentum equation integrated along the tube, U(r) = Int u_z dz obeys U'' + U'/r = p(inf) - p(-inf)
    // inside the ring: U = U(0) + r^2/4 of it. The trapezoidal rule converges geometrically.
    const auto kernel = tube(1.0, 1e-12);
    for (const double r : {0.6, 0.95}) {
        const auto along = [&](double r0) {
            const double step = 0.06;
            double sum = 0;
            for (int k = -130; k <= 130; ++k) {
                sum += step * kernel.total({r0, 0}, {r, step * k}).zz;
            }
            return sum / (8 * test::pi);
        };
        const double rise = 4 * (along(0.2) - along(0)) / (0.2 * 0.2);
        INFO("ring of radius " << r);
        // By the reciprocal theorem, of a ring of unit axial force density.
        CHECK(2 * test::pi * r * kernel.unit_flow({r, 0}).z == Approx(rise).epsilon(1e-8));
    }
}

TEST_CASE("the undisturbed flow of flow rate 1", "[tube]") {
    const auto kernel = tube(3.0, 1e-8);
    CHECK(kernel.unit_flow({0, 0.3}).z == Approx(2 / (test::pi * 9)).epsilon(1e-14));
    CHECK(kernel.unit_flow({3, 0}).z == Approx(0).margin(1e-15));
    CHECK(kernel.unit_flow({1, 0}).r == 0);
    double rate = 0;
    for (int i = 0; i < 1000; ++i) {
        const double r = 3 * (i + 0.5) / 1000;
        rate += 2 * test::pi * r * kernel.unit_flow({r, 0}).z * 3 / 1000;
    }
    CHECK(rate == Approx(1).epsilon(1e-5));
}

TEST_CASE("float, long double and 50 digits work", "[tube]") {
    const auto exact = tube(1.0, 1e-14).correction({0.4, 0}, {0.7, 0.5});
    const auto single = tube(1.0F, 1e-5F).correction({0.4F, 0}, {0.7F, 0.5F});
    CHECK(static_cast<double>(single.zz) == Approx(exact.zz).epsilon(1e-4));
    const auto wide = tube(1.0L, 1e-16L).correction({0.4L, 0}, {0.7L, 0.5L});
    CHECK(static_cast<double>(wide.zz) == Approx(exact.zz).epsilon(1e-13));
    const auto widest = tube(Wide(1), Wide(1e-30)).correction({Wide(4) / 10, 0}, {Wide(7) / 10, Wide(0.5)});
    const auto reference_value = reference(Wide(4) / 10, Wide(7) / 10, Wide(0.5));
    CHECK(static_cast<double>(widest.rz) == Approx(static_cast<double>(reference_value.rz)).epsilon(1e-13));
    CHECK(static_cast<double>(abs(widest.zz - Wide(wide.zz))) < 1e-15);
}

TEST_CASE("the tube kernel refuses bad input", "[tube]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(mentions(refusal([] { TubeKernel<double>(0.0); }), "tube radius", "0", "> 0"));
    CHECK(mentions(refusal([&] { TubeKernel<double> k(nan); }), "tube radius", "nan", "> 0"));
    CHECK(mentions(refusal([] { TubeKernel<double>(1e-300); }), "tube radius", "1e-300", "from 2.93874e-39 to"));
    CHECK(mentions(refusal([] { tube(1.0, 0.5); }), "tolerance", "0.5", "0.1"));
    CHECK(mentions(refusal([] { tube(1.0, 1e-17); }), "tolerance", "1e-17", "8 eps"));
    const TubeKernel<double> kernel(1.0);
    CHECK(mentions(refusal([&] { kernel.correction({1.5, 0}, {0.5, 0}); }), "target radius", "1.5", "tube radius"));
    CHECK(mentions(refusal([&] { kernel.correction({0.5, 0}, {-0.5, 0}); }), "source radius", "-0.5", "tube radius"));
    CHECK(mentions(refusal([&] { kernel.correction({1, 0}, {1, 0.5}); }), "distances", "0", "> 0"));
    const LinearElements<double> elements;
    // A shape got there by deformation.
    CHECK(mentions(test::failure([&] { elements.single_layer(sphere<double>(20, 1.1), kernel); }), "radius", "1.04",
                   "tube radius"));
}
