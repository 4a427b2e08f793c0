// SPDX-License-Identifier: MIT
// The double layer's Q against quadrature of its definition over the azimuth in 50 digits, its logarithmic split, and
// what it makes of a uniform velocity on a closed surface; the same in a tube.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/kernel/tube.hpp>
#include <axistokes/quadrature/gauss_legendre.hpp>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace axistokes;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

struct Pair {
    Point<double> target;
    Point<double> source;
    Point<double> normal;
};

struct Exact {
    std::array<Wide, 4> value;  // rr, rz, zr, zz
    std::array<Wide, 4> size;   // of the terms that are summed
};

/// Q from T_ijk = -6 X_i X_j X_k/|X|^5, X = x0 - x, by Gauss-Legendre on panels of the azimuth that double in length
/// away from the target's meridian plane.
Exact by_quadrature(const Pair& p) {
    using Rule = boost::math::quadrature::gauss<Wide, 30>;
    const Wide r0(p.target.r);
    const Wide r(p.source.r);
    const Wide zh = Wide(p.source.z) - Wide(p.target.z);
    const Wide pi = acos(Wide(-1));
    const Wide d2 = (r - r0) * (r - r0) + zh * zh;
    std::array<Wide, 4> radial{};
    std::array<Wide, 4> axial{};
    const auto add = [&](const Wide& t, const Wide& weight) {
        const Wide sine = sin(t / 2);
        const Wide y = 2 * sine * sine;  // 1 - cos t
        const Wide square = d2 + 2 * r * r0 * y;
        const Wide a = r0 - r + r * y;
        const Wide b = r0 - r - r0 * y;
        const Wide f = -6 * r * 2 * weight / (square * square * sqrt(square));
        const std::array<Wide, 4> product{a * b, -a * zh, -zh * b, zh * zh};
        for (std::size_t i = 0; i < 4; ++i) {
            radial[i] += f * product[i] * b;
            axial[i] -= f * product[i] * zh;
        }
    };
    Wide begin = 0;
    Wide length = r * r0 == 0 ? pi : std::min<Wide>(pi, sqrt(d2 / (r * r0)) / 2);
    while (begin < pi) {
        const Wide half = std::min<Wide>(length, pi - begin) / 2;
        for (std::size_t q = 0; q < Rule::abscissa().size(); ++q) {
            add(begin + half * (1 + Rule::abscissa()[q]), half * Rule::weights()[q]);
            add(begin + half * (1 - Rule::abscissa()[q]), half * Rule::weights()[q]);
        }
        begin += 2 * half;
        length = begin;
    }
    Exact exact;
    for (std::size_t i = 0; i < 4; ++i) {
        exact.value[i] = p.normal.r * radial[i] + p.normal.z * axial[i];
        exact.size[i] = abs(p.normal.r * radial[i]) + abs(p.normal.z * axial[i]);
    }
    // J_ABB is formed from terms of this size, which cancel where zh is much larger than both radii.
    const Wide square = (r + r0) * (r + r0) + zh * zh;
    exact.size[0] += abs(p.normal.r) * 48 * r * r0 * zh * zh / (square * square * sqrt(square));
    if (r0 == 0) {  // nothing but rounding errors is left of the integrals
        exact.size[0] = exact.size[1] = exact.value[0] = exact.value[1] = 0;
    }
    return exact;
}

std::array<Wide, 4> entries(const KernelBlock<double>& m) {
    return {m.rr, m.rz, m.zr, m.zz};
}

using Random = std::mt19937_64;

double log_uniform(Random& random, double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
}

Point<double> direction(Random& random) {
    const double angle = std::uniform_real_distribution<double>(0, 2 * test::pi)(random);
    return {std::cos(angle), std::sin(angle)};
}

Pair at_distance(Random& random, double r0, double d) {
    const Point<double> x = direction(random);
    return {{r0, 0.5}, {std::abs(r0 + d * x.r), 0.5 + d * x.z}, direction(random)};
}

/// A pair of points of a circle of radius 1 about (1.5, 0), an angle apart, with the circle's normal.
Pair on_circle(Random& random, double apart) {
    const double angle = std::uniform_real_distribution<double>(0, 2 * test::pi)(random);
    const double c = std::cos(angle + apart);
    const double s = std::sin(angle + apart);
    return {{1.5 + std::cos(angle), std::sin(angle)}, {1.5 + c, s}, {c, s}};
}

struct Region {
    std::string name;
    std::function<Pair(Random&)> draw;
};

std::vector<Region> regions() {
    return {
        {"generic, 0.1 to 3",
         [](Random& g) {
             return Pair{
                 {log_uniform(g, -1, 0.5), 0}, {log_uniform(g, -1, 0.5), log_uniform(g, -1, 0.5)}, direction(g)};
         }},
        {"target on the axis",
         [](Random& g) {
             return Pair{{0, 0}, {log_uniform(g, -4, 2), log_uniform(g, -4, 2)}, direction(g)};
         }},
        {"r0 = 1e-8",
         [](Random& g) {
             return Pair{{1e-8, 0}, {log_uniform(g, -4, 2), log_uniform(g, -4, 2)}, direction(g)};
         }},
        {"r = 1e-8",
         [](Random& g) {
             return Pair{{log_uniform(g, -4, 2), 0}, {1e-8, log_uniform(g, -4, 2)}, direction(g)};
         }},
        {"distance 1e-8", [](Random& g) { return at_distance(g, 1.0, 1e-8); }},
        {"close to distant", [](Random& g) { return at_distance(g, log_uniform(g, -1, 0.5), log_uniform(g, -12, 0)); }},
        {"far, 1e6", [](Random& g) { return at_distance(g, log_uniform(g, -1, 1), 1e6); }},
        {"on a circle", [](Random& g) { return on_circle(g, log_uniform(g, -6, 0)); }},
    };
}

struct Errors {
    double block = 0;  // |error| / largest of the entries' sizes
    double entry = 0;  // |error| / the entry's own size
};

Errors sweep(const Region& region, int count) {
    const FreeSpaceKernel<double> kernel;
    Random random(7);
    Errors worst;
    for (int k = 0; k < count; ++k) {
        const Pair p = region.draw(random);
        const Exact exact = by_quadrature(p);
        const auto value = entries(kernel.stress(p.target, p.source, p.normal));
        const Wide largest = *std::max_element(exact.size.begin(), exact.size.end());
        for (std::size_t i = 0; i < 4; ++i) {
            const Wide error = abs(value[i] - exact.value[i]);
            worst.block = std::max(worst.block, static_cast<double>(error / largest));
            if (exact.size[i] > 0) {
                worst.entry = std::max(worst.entry, static_cast<double>(error / exact.size[i]));
            } else {
                worst.entry = std::max(worst.entry, error == 0 ? 0.0 : 1.0);
            }
        }
    }
    return worst;
}

double complementary_parameter(const Point<double>& a, const Point<double>& b) {
    const double zh = b.z - a.z;
    return ((b.r - a.r) * (b.r - a.r) + zh * zh) / ((b.r + a.r) * (b.r + a.r) + zh * zh);
}

struct Split {
    KernelBlock<double> smooth;
    KernelBlock<double> logarithm;
};

Split split(const Pair& p) {
    Split s;
    FreeSpaceKernel<double>().stress_split(p.target, &p.source.r, &p.source.z, &p.normal.r, &p.normal.z, 1,
                                           {&s.smooth.rr, &s.smooth.rz, &s.smooth.zr, &s.smooth.zz},
                                           {&s.logarithm.rr, &s.logarithm.rz, &s.logarithm.zr, &s.logarithm.zz});
    return s;
}

/// 1/(8 pi) Int Q e_z dl over a spheroid about the origin, of Q and of a smooth `addition`. For a target on the surface
/// the logarithm is left to a product rule on the two panels that start there.
template <class Addition>
Point<double> uniform_flow(const test::Spheroid& shape, const Point<double>& target, bool on_surface,
                           const Addition& addition) {
    static const GaussLegendreRule<double> rule = gauss_legendre<double>(20);
    const FreeSpaceKernel<double> kernel;
    const double nearest = shape.parameter(target.r, target.z);
    const double off = std::hypot(target.r - shape.a * std::sin(nearest), target.z + shape.c * std::cos(nearest));
    const double pole = std::min(nearest, test::pi - nearest);
    const double first = on_surface && pole > 0 ? std::min(0.2, pole / 2) : std::min(0.2, off > 1e-12 ? off : 0.2);
    std::vector<double> ends{0, test::pi, nearest};
    for (double step = first; step < test::pi; step += std::min(step, 0.2)) {
        for (const double t : {nearest - step, nearest + step}) {
            if (t > 0 && t < test::pi) {
                ends.push_back(t);
            }
        }
    }
    std::sort(ends.begin(), ends.end());
    Point<double> sum;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        const bool ends_there = on_surface && pole > 0 && ends[k + 1] == nearest;
        const bool starts_there = on_surface && pole > 0 && ends[k] == nearest;
        const double length = ends[k + 1] - ends[k];
        for (Index q = 0; q < rule.nodes.size() && length > 0; ++q) {
            const double s = rule.nodes[q];
            const double t = ends_there ? ends[k + 1] - length * s : ends[k] + length * s;
            const Point<double> source{shape.a * std::sin(t), -shape.c * std::cos(t)};
            const Point<double> normal = shape.normal(t);
            const double dl = length * shape.speed(t) / (8 * test::pi);
            KernelBlock<double> m = kernel.stress(target, source, normal);
            if (starts_there || ends_there) {
                const Split parts = split({target, source, normal});
                const double regular = std::log(complementary_parameter(target, source) / (s * s));
                const double factor = regular + 2 * rule.log_weights[q] / rule.weights[q];
                m.rz = parts.smooth.rz + factor * parts.logarithm.rz;
                m.zz = parts.smooth.zz + factor * parts.logarithm.zz;
            }
            m = m + addition(target, source, normal);
            sum.r += rule.weights[q] * dl * m.rz;
            sum.z += rule.weights[q] * dl * m.zz;
        }
    }
    return sum;
}

}  // namespace

TEST_CASE("Q is accurate in every region", "[stress]") {
    for (const Region& region : regions()) {
        INFO(region.name);
        const Errors worst = sweep(region, 20);
        CHECK(worst.block < 1e-14);
        CHECK(worst.entry < 1e-13);
    }
}

TEST_CASE("Q of other scalars", "[stress]") {
    const Pair p{{0.8, 0.1}, {0.5, 0.4}, {0.6, -0.8}};
    const auto exact = by_quadrature(p);
    const Point<Wide> target{Wide(p.target.r), Wide(p.target.z)};
    const Point<Wide> source{Wide(p.source.r), Wide(p.source.z)};
    const Point<Wide> normal{Wide(p.normal.r), Wide(p.normal.z)};
    const KernelBlock<Wide> wide = FreeSpaceKernel<Wide>().stress(target, source, normal);
    CHECK(abs(wide.rr - exact.value[0]) < Wide(1e-45));
    CHECK(abs(wide.rz - exact.value[1]) < Wide(1e-45));
    CHECK(abs(wide.zr - exact.value[2]) < Wide(1e-45));
    CHECK(abs(wide.zz - exact.value[3]) < Wide(1e-45));
    const auto single = FreeSpaceKernel<float>().stress({0.8F, 0.1F}, {0.5F, 0.4F}, {0.6F, -0.8F});
    CHECK(single.zz == Approx(static_cast<double>(exact.value[3])).epsilon(1e-5));
}

TEST_CASE("batches of Q of any size give what single pairs give", "[stress]") {
    const FreeSpaceKernel<double> kernel;
    const Point<double> target{0.8, 0.1};
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{150}}) {
        std::vector<std::vector<double>> in(4, std::vector<double>(n));
        std::vector<std::vector<double>> out(4, std::vector<double>(n));
        for (std::size_t i = 0; i < n; ++i) {
            const auto x = static_cast<double>(i);
            in[0][i] = 0.05 + 0.011 * x;
            in[1][i] = std::sin(x);
            in[2][i] = std::cos(2 * x);
            in[3][i] = std::sin(2 * x);
        }
        kernel.stress(target, in[0].data(), in[1].data(), in[2].data(), in[3].data(), static_cast<Index>(n),
                      {out[0].data(), out[1].data(), out[2].data(), out[3].data()});
        for (std::size_t i = 0; i < n; ++i) {
            const auto single = kernel.stress(target, {in[0][i], in[1][i]}, {in[2][i], in[3][i]});
            CHECK(out[0][i] == Approx(single.rr).epsilon(1e-12));
            CHECK(out[1][i] == Approx(single.rz).epsilon(1e-12));
            CHECK(out[2][i] == Approx(single.zr).epsilon(1e-12));
            CHECK(out[3][i] == Approx(single.zz).epsilon(1e-12));
        }
    }
}

TEST_CASE("the logarithmic split adds up to Q", "[stress]") {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const Pair p = i % 2 == 0 ? on_circle(random, log_uniform(random, -6, 0))
                                  : at_distance(random, i % 10 == 1 ? 0.0 : log_uniform(random, -3, 1),
                                                log_uniform(random, -6, 1));
        const Split s = split(p);
        const double log_m1 = std::log(complementary_parameter(p.target, p.source));
        const KernelBlock<double> q = FreeSpaceKernel<double>().stress(p.target, p.source, p.normal);
        const double d = std::hypot(p.source.r - p.target.r, p.source.z - p.target.z);
        const double tolerance = 1e-13 * p.source.r / (d * (p.source.r + p.target.r + d));
        CHECK(std::abs(s.smooth.rr + s.logarithm.rr * log_m1 - q.rr) < tolerance);
        CHECK(std::abs(s.smooth.rz + s.logarithm.rz * log_m1 - q.rz) < tolerance);
        CHECK(std::abs(s.smooth.zr + s.logarithm.zr * log_m1 - q.zr) < tolerance);
        CHECK(std::abs(s.smooth.zz + s.logarithm.zz * log_m1 - q.zz) < tolerance);
        CHECK((p.target.r != 0.0 || s.logarithm.zz == 0.0));
    }
}

TEST_CASE("both parts of Q's split are smooth along a curve through the target", "[stress]") {
    // Interpolated at the Chebyshev points of an arc of a circle of radius 1 that starts at the target.
    const double start = 0.4;
    const auto pair = [&](double t) {
        const double angle = start + 0.6 * t;
        return Pair{{std::sin(start), -std::cos(start)},
                    {std::sin(angle), -std::cos(angle)},
                    {std::sin(angle), -std::cos(angle)}};
    };
    std::vector<double> nodes;
    for (int i = 0; i < 16; ++i) {
        nodes.push_back(0.5 - 0.5 * std::cos(test::pi * (i + 0.5) / 16));
    }
    for (int k = 0; k < 8; ++k) {
        const double t = 0.03 + 0.12 * k;
        KernelBlock<double> smooth;
        KernelBlock<double> logarithm;
        for (const double node : nodes) {
            double basis = 1;
            for (const double other : nodes) {
                basis *= other == node ? 1 : (t - other) / (node - other);
            }
            const Split s = split(pair(node));
            smooth = smooth + KernelBlock<double>{basis * s.smooth.rr, basis * s.smooth.rz, basis * s.smooth.zr,
                                                  basis * s.smooth.zz};
            logarithm = logarithm + KernelBlock<double>{basis * s.logarithm.rr, basis * s.logarithm.rz,
                                                        basis * s.logarithm.zr, basis * s.logarithm.zz};
        }
        const Split exact = split(pair(t));
        CHECK(smooth.rr == Approx(exact.smooth.rr).margin(1e-9));
        CHECK(smooth.rz == Approx(exact.smooth.rz).margin(1e-9));
        CHECK(smooth.zr == Approx(exact.smooth.zr).margin(1e-9));
        CHECK(smooth.zz == Approx(exact.smooth.zz).margin(1e-9));
        CHECK(logarithm.rr == Approx(exact.logarithm.rr).margin(1e-9));
        CHECK(logarithm.rz == Approx(exact.logarithm.rz).margin(1e-9));
        CHECK(logarithm.zr == Approx(exact.logarithm.zr).margin(1e-9));
        CHECK(logarithm.zz == Approx(exact.logarithm.zz).margin(1e-9));
    }
}

TEST_CASE("the double layer of a uniform velocity is 1, 1/2 or 0 of it", "[stress]") {
    const test::Spheroid shape{0.6, 1.0};
    const auto nothing = [](const auto&, const auto&, const auto&) { return KernelBlock<double>{}; };
    const auto check = [&](double t, double scale, double expected) {
        const Point<double> target{scale * shape.a * std::sin(t), -scale * shape.c * std::cos(t)};
        const Point<double> u = uniform_flow(shape, target, scale == 1.0, nothing);
        INFO("t = " << t << ", scale " << scale);
        CHECK(std::abs(u.r) < 1e-11);
        CHECK(u.z == Approx(expected).margin(1e-11));
    };
    for (const double t : {0.0, 0.1, 0.3, 1.5, 2.8}) {
        check(t, 1.0, 0.5);
        check(t, 0.5, 1.0);
        check(t, 0.999, 1.0);
        check(t, 1.001, 0.0);
        check(t, 3.0, 0.0);
    }
}

namespace {

TubeKernel<double> tube(double radius, double tolerance) {
    TubeKernel<double>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<double>(radius, params);
}

double largest(const KernelBlock<double>& m) {
    return std::max({std::abs(m.rr), std::abs(m.rz), std::abs(m.zr), std::abs(m.zz)});
}

/// Q_T on the wall over Q in free space, at its worst for sources at `gap` from the wall.
double wall_error(double gap, double tolerance) {
    const auto kernel = tube(0.8, tolerance);
    double worst = 0;
    for (const double z : {-3.0, -1.0, -0.1, 0.0, 0.01, 0.3, 2.0}) {
        for (const double angle : {0.0, 0.9, 2.2}) {
            const Point<double> target{0.8, 0.2};
            const Point<double> source{0.8 - gap, 0.2 + z};
            const Point<double> normal{std::cos(angle), std::sin(angle)};
            const auto free = kernel.stress(target, source, normal);
            const auto images = kernel.stress_correction(target, source, normal);
            worst = std::max(worst, largest(free + images) / largest(free));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("in a tube Q vanishes for a target on the wall", "[stress][tube]") {
    for (const double gap : {0.7, 0.3, 0.05, 0.005}) {
        INFO("gap " << gap);
        CHECK(wall_error(gap, 1e-12) < 1e-11);
        CHECK(wall_error(gap, 1e-6) < 1e-6);
    }
}

TEST_CASE("Q in a tube is the stress of the Green function", "[stress][tube]") {
    // Minus the shear stress at x of the flow G(x, x0) of a ring at x0, by differences: M(x0, x)/r is that flow. The
    // normal stresses differ by it too, the pressure being common to both.
    const auto kernel = tube(0.8, 1e-13);
    const Point<double> target{0.3, 0.1};
    const Point<double> source{0.6, -0.2};
    const double step = 1e-3;
    const auto flow = [&](double dr, double dz) {
        const Point<double> x{source.r + dr, source.z + dz};
        const auto m = kernel.correction(target, x);
        return KernelBlock<double>{m.rr / x.r, m.rz / x.r, m.zr / x.r, m.zz / x.r};
    };
    const auto slope = [&](double r, double z, double KernelBlock<double>::*entry) {
        const auto difference = [&](double h) {
            return (flow(r * h, z * h).*entry - flow(-r * h, -z * h).*entry) / (2 * h);
        };
        return (4 * difference(step) - difference(2 * step)) / 3;
    };
    using M = KernelBlock<double>;
    const auto radial = kernel.stress_correction(target, source, {1, 0});
    const auto axial = kernel.stress_correction(target, source, {0, 1});
    const double r = source.r;
    CHECK(radial.rz == Approx(-r * (slope(1, 0, &M::rz) + slope(0, 1, &M::rr))).epsilon(1e-8));
    CHECK(axial.rr == Approx(radial.rz).epsilon(1e-11));
    CHECK(radial.zz == Approx(-r * (slope(1, 0, &M::zz) + slope(0, 1, &M::zr))).epsilon(1e-8));
    CHECK(axial.zr == Approx(radial.zz).epsilon(1e-11));
    CHECK(radial.rr - axial.rz == Approx(-2 * r * (slope(1, 0, &M::rr) - slope(0, 1, &M::rz))).epsilon(1e-8));
    CHECK(radial.zr - axial.zz == Approx(-2 * r * (slope(1, 0, &M::zr) - slope(0, 1, &M::zz))).epsilon(1e-8));
}

TEST_CASE("Q in a tube on the real axis of wave numbers", "[stress][tube]") {
    // Types without a complex counterpart do not turn the path of integration.
    TubeKernel<Wide>::Params params;
    params.tolerance = Wide(1e-18);
    const TubeKernel<Wide> wide(Wide(1), params);
    const auto kernel = tube(1.0, 1e-13);
    for (const double z : {-0.5, 0.0, 1.5}) {
        const auto exact =
            wide.stress_correction({Wide(0.375), Wide(0)}, {Wide(0.625), Wide(z)}, {Wide(0.75), Wide(0.5)});
        const auto q = kernel.stress_correction({0.375, 0}, {0.625, z}, {0.75, 0.5});
        CHECK(q.rr == Approx(static_cast<double>(exact.rr)).epsilon(1e-12));
        CHECK(q.rz == Approx(static_cast<double>(exact.rz)).epsilon(1e-12));
        CHECK(q.zr == Approx(static_cast<double>(exact.zr)).epsilon(1e-12));
        CHECK(q.zz == Approx(static_cast<double>(exact.zz)).epsilon(1e-12));
    }
}

TEST_CASE("the wall's part of Q integrates to 0 over a closed surface", "[stress][tube]") {
    const test::Spheroid shape{0.6, 1.0};
    const auto kernel = tube(0.7, 1e-12);
    const auto images = [&](const auto& target, const auto& source, const auto& normal) {
        return kernel.stress_correction(target, source, normal);
    };
    const auto check = [&](const Point<double>& target, bool on_surface, double expected) {
        const Point<double> u = uniform_flow(shape, target, on_surface, images);
        INFO("target at " << target.r << ", " << target.z);
        CHECK(std::abs(u.r) < 1e-10);
        CHECK(u.z == Approx(expected).margin(1e-10));
    };
    check({0.2, 0.3}, false, 1.0);
    check({0, -0.8}, false, 1.0);
    check({0.6, 0}, true, 0.5);
    check({0, -1}, true, 0.5);
    check({0.65, 0.1}, false, 0.0);
    check({0.3, -1.4}, false, 0.0);
}

TEST_CASE("a batch of the wall's part of Q is the sum of its pairs", "[stress][tube]") {
    const auto kernel = tube(1.0, 1e-10);
    const Meridian<double> targets{Vector<double>::LinSpaced(3, 0.0, 0.8), Vector<double>::LinSpaced(3, -0.5, 0.4)};
    RegularQuadrature<double> sources;
    sources.points = {Vector<double>::LinSpaced(2, 0.3, 0.6), Vector<double>::LinSpaced(2, 0.0, 0.7)};
    sources.panel = sources.points.z;
    sources.weights.resize(2, 2);
    sources.weights.insert(0, 0) = 2;
    sources.weights.insert(0, 1) = 3;
    sources.weights.insert(1, 1) = 5;
    Vector<double> normals(4);
    normals << 0.6, 0.8, 0.8, -0.6;
    Matrix<double> out = Matrix<double>::Zero(6, 4);
    kernel.regular_stress(targets, sources, normals, out);
    for (Index i = 0; i < 3; ++i) {
        const Point<double> target{targets.r[i], targets.z[i]};
        const auto first = kernel.stress_correction(target, {0.3, 0.0}, {0.6, 0.8});
        const auto second = kernel.stress_correction(target, {0.6, 0.7}, {0.8, -0.6});
        CHECK(out(i, 0) == Approx(2 * first.rr));
        CHECK(out(i, 3) == Approx(3 * first.rz + 5 * second.rz));
        CHECK(out(3 + i, 1) == Approx(3 * first.zr + 5 * second.zr));
        CHECK(out(3 + i, 2) == Approx(2 * first.zz));
    }
    sources.points.r[0] = 1.2;
    CHECK(test::mentions(test::failure([&] { kernel.regular_stress(targets, sources, normals, out); }), "source radius",
                         "1.2", "tube radius"));
}

TEST_CASE("report: worst errors of Q by region", "[.report]") {
    std::cout << "Q, double: worst error over 300 pairs a region, in units of the type's epsilon\n"
              << std::setw(32) << "block" << std::setw(10) << "entry" << '\n';
    for (const Region& region : regions()) {
        const Errors worst = sweep(region, 300);
        const double eps = std::numeric_limits<double>::epsilon();
        std::cout << std::left << std::setw(24) << region.name << std::right << std::fixed << std::setprecision(1)
                  << std::setw(8) << worst.block / eps << std::setw(10) << worst.entry / eps << '\n';
    }
}

TEST_CASE("report: Q in a tube on the wall", "[.report]") {
    std::cout << "Q on the wall over Q in free space\n  gap/Rc      1e-12        1e-8\n";
    for (const double gap : {0.5, 0.1, 0.01, 0.001}) {
        std::cout << std::defaultfloat << std::setw(8) << gap << std::scientific << std::setprecision(1)
                  << std::setw(12) << wall_error(0.8 * gap, 1e-12) << std::setw(12) << wall_error(0.8 * gap, 1e-8)
                  << '\n';
    }
}
