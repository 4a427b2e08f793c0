// SPDX-License-Identifier: MIT
// M against its definition through the integrals I_mn in 400 digits (K, E by the textbook AGM), that definition against
// quadrature over the azimuth, and the properties the rest of the library relies on.
#include "catch.hpp"
#include <axistokes/kernel/free_space.hpp>

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
#include <type_traits>
#include <vector>

namespace {

namespace mp = boost::multiprecision;
using axistokes::FreeSpaceKernel;
using axistokes::Index;
using axistokes::KernelArrays;
using axistokes::KernelBlock;
using axistokes::Point;
using Real50 = mp::cpp_bin_float_50;
// The subtractions in the I_mn lose up to 1/(m^2 m1) each: 400 digits leave more than 50 for all the sweeps below.
using Exact = mp::number<mp::cpp_bin_float<400>, mp::et_off>;
// r0 = 1e-300 costs 600 digits more.
using ExactTiny = mp::number<mp::cpp_bin_float<1400>, mp::et_off>;

template <class R>
struct RingValues {
    R i10, i11, i30, i31, i32;
};

/// I_mn of an off-axis pair by their textbook expressions in K and E (Pozrikidis 1992, section 2.4).
template <class R>
RingValues<R> ring_values(const R& r0, const R& r, const R& zh) {
    const R d2 = (r - r0) * (r - r0) + zh * zh;
    const R big_d2 = (r + r0) * (r + r0) + zh * zh;
    const R big_d = sqrt(big_d2);
    const R m = 4 * r * r0 / big_d2;
    const R m1 = d2 / big_d2;

    R a = 1;
    R b = sqrt(m1);
    R half_power = R(1) / 2;
    R sum = m / 2;
    while (abs(a - b) > 8 * std::numeric_limits<R>::epsilon() * a) {
        const R c = (a - b) / 2;
        const R mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
        half_power *= 2;
        sum += half_power * c * c;
    }
    static const R pi = acos(R(-1));
    const R k = pi / (2 * a);
    const R e = k * (1 - sum);

    const R f1 = 4 / big_d;
    const R f3 = f1 / big_d2;
    const R p = 2 - m;
    return {f1 * k, f1 * (p * k - 2 * e) / m, f3 * e / m1, f3 * (p * e - 2 * m1 * k) / (m * m1),
            f3 * (p * p * e / m1 - 4 * p * k + 4 * e) / (m * m)};
}

/// M by its definition, term by term (docs/free_space_kernel.md, eq. 1).
template <class R>
KernelBlock<R> assemble(const RingValues<R>& i, const R& r0, const R& r, const R& zh) {
    return {r * (i.i11 + (r * r + r0 * r0) * i.i31 - r * r0 * (i.i30 + i.i32)), r * zh * (r * i.i31 - r0 * i.i30),
            r * zh * (r * i.i30 - r0 * i.i31), r * (i.i10 + zh * zh * i.i30)};
}

/// The same integrals on the axis, where m = 0.
template <class R>
RingValues<R> axis_values(const R& r0, const R& r, const R& zh) {
    static const R pi = acos(R(-1));
    const R distance2 = (r0 + r) * (r0 + r) + zh * zh;
    const R inverse = 1 / sqrt(distance2);
    const R cube = inverse / distance2;
    return {2 * pi * inverse, R(0), 2 * pi * cube, R(0), pi * cube};
}

template <class R, class S>
KernelBlock<R> reference(Point<S> target, Point<S> source) {
    const R r0(target.r);
    const R r(source.r);
    const R zh = R(source.z) - R(target.z);
    const bool on_axis = target.r == S(0) || source.r == S(0);
    return assemble(on_axis ? axis_values<R>(r0, r, zh) : ring_values<R>(r0, r, zh), r0, r, zh);
}

/// The integrals over the azimuth by the trapezoid rule, which converges geometrically for a periodic integrand.
KernelBlock<Real50> by_quadrature(Point<double> target, Point<double> source, int nodes) {
    const Real50 r0(target.r);
    const Real50 r(source.r);
    const Real50 zh = Real50(source.z) - Real50(target.z);
    const Real50 step = 2 * acos(Real50(-1)) / nodes;
    RingValues<Real50> sum{0, 0, 0, 0, 0};
    for (int j = 0; j < nodes; ++j) {
        const Real50 cosine = cos(step * j);
        const Real50 distance2 = zh * zh + r * r + r0 * r0 - 2 * r * r0 * cosine;
        const Real50 w1 = step / sqrt(distance2);
        const Real50 w3 = w1 / distance2;
        sum.i10 += w1;
        sum.i11 += w1 * cosine;
        sum.i30 += w3;
        sum.i31 += w3 * cosine;
        sum.i32 += w3 * cosine * cosine;
    }
    return assemble(sum, r0, r, zh);
}

template <class S>
std::array<S, 4> entries(const KernelBlock<S>& m) {
    return {m.rr, m.rz, m.zr, m.zz};
}

struct Errors {
    double block = 0;               // |error| / largest entry of the block
    std::array<double, 4> entry{};  // |error| / sum of the absolute values of the entry's terms

    void include(const Errors& other) {
        block = std::max(block, other.block);
        for (std::size_t i = 0; i < 4; ++i) {
            entry[i] = std::max(entry[i], other.entry[i]);
        }
    }
};

template <class S>
Errors measure(const KernelBlock<S>& value, const KernelBlock<Exact>& exact, const std::array<Exact, 4>& term_sizes) {
    const auto x = entries(exact);
    const auto v = entries(value);
    Exact largest = 0;
    Exact difference = 0;
    Errors errors;
    for (std::size_t i = 0; i < 4; ++i) {
        const Exact error = abs(Exact(v[i]) - x[i]);
        largest = std::max<Exact>(largest, abs(x[i]));
        difference = std::max<Exact>(difference, error);
        errors.entry[i] = term_sizes[i] == 0 ? 0.0 : static_cast<double>(error / term_sizes[i]);
    }
    errors.block = static_cast<double>(difference / largest);
    if (std::any_of(v.begin(), v.end(), [](const S& e) { return !(e - e == S(0)); })) {
        errors.block = std::numeric_limits<double>::infinity();
    }
    return errors;
}

/// Sizes of the two terms of each entry: M_rr = r (I11 - zh^2 I31), M_rz = zh/2 [(r^2 - r0^2 - zh^2) I31 - I11].
template <class S>
std::array<Exact, 4> term_sizes(Point<S> target, Point<S> source, const KernelBlock<Exact>& exact) {
    if (target.r == S(0)) {
        return {Exact(0), Exact(0), abs(exact.zr), exact.zz};
    }
    const Exact r0(target.r);
    const Exact r(source.r);
    const Exact zh = Exact(source.z) - Exact(target.z);
    const RingValues<Exact> i = ring_values<Exact>(r0, r, zh);
    const Exact rz = abs(zh) / 2 * ((abs(r * r - r0 * r0) + zh * zh) * i.i31 + i.i11);
    return {r * (i.i11 + zh * zh * i.i31), rz, rz * r / r0, exact.zz};
}

template <class S>
struct Pair {
    Point<S> target;
    Point<S> source;
};

using Random = std::mt19937_64;

double log_uniform(Random& random, double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
}

double either_sign(Random& random) {
    return random() % 2 == 0 ? 1.0 : -1.0;
}

/// A source at distance d of the target in a random direction, axis directions included; never across the axis.
template <class S>
Pair<S> pair_at_distance(Random& random, double r0, double d) {
    const double angle = std::uniform_real_distribution<double>(0.0, 6.283185307179586)(random);
    const auto kind = random() % 4;
    const double dr = kind == 0 ? 0.0 : d * std::cos(angle);
    const double dz = kind == 1 ? 0.0 : d * std::sin(angle);
    const S z0 = kind == 2 ? S(0.5) : S(0);
    using std::abs;
    return {{S(r0), z0}, {S(abs(S(S(r0) + S(dr)))), S(z0 + S(dz))}};
}

template <class S>
struct Region {
    std::string name;
    std::function<Pair<S>(Random&)> draw;
};

/// Exponents stay within `span` decades, the range in which the entries, of order (r/d)^3, do not underflow.
template <class S>
std::vector<Region<S>> regions() {
    const double near = std::is_same_v<S, float> ? 1e-4 : 1e-8;
    const double far = std::is_same_v<S, float> ? 1e4 : 1e6;
    const double span = std::is_same_v<S, float> ? 4 : 30;
    return {
        {"generic, 0.1 to 3",
         [](Random& g) {
             return Pair<S>{{S(log_uniform(g, -1, 0.5)), S(0)},
                            {S(log_uniform(g, -1, 0.5)), S(either_sign(g) * log_uniform(g, -1, 0.5))}};
         }},
        {"target on the axis",
         [](Random& g) {
             return Pair<S>{{S(0), S(0)}, {S(log_uniform(g, -8, 2)), S(either_sign(g) * log_uniform(g, -8, 2))}};
         }},
        {"tiny r0",
         [near](Random& g) {
             return Pair<S>{{S(near), S(0)}, {S(log_uniform(g, -8, 2)), S(either_sign(g) * log_uniform(g, -8, 2))}};
         }},
        {"tiny r",
         [near](Random& g) {
             return Pair<S>{{S(log_uniform(g, -8, 2)), S(0)}, {S(near), S(either_sign(g) * log_uniform(g, -8, 2))}};
         }},
        {"tiny distance", [near](Random& g) { return pair_at_distance<S>(g, 1.0, near); }},
        {"close to distant",
         [](Random& g) {
             const double floor = std::is_same_v<S, float> ? -6 : -15.3;
             return pair_at_distance<S>(g, log_uniform(g, -1, 0.5), log_uniform(g, floor, 0));
         }},
        {"far", [far](Random& g) { return pair_at_distance<S>(g, log_uniform(g, -1, 1), far); }},
        {"near own scale, any r0",
         [span](Random& g) {
             const double r0 = log_uniform(g, -span, span);
             return pair_at_distance<S>(g, r0, r0 * log_uniform(g, std::is_same_v<S, float> ? -5 : -14, 1));
         }},
        {"all log-uniform",
         [span](Random& g) {
             return Pair<S>{{S(log_uniform(g, -span, span)), S(0)},
                            {S(log_uniform(g, -span, span)), S(either_sign(g) * log_uniform(g, -span, span))}};
         }},
    };
}

template <class S>
Errors sweep(const Region<S>& region, int count) {
    const FreeSpaceKernel<S> kernel;
    Random random(11);
    Errors worst;
    for (int i = 0; i < count; ++i) {
        const Pair<S> p = region.draw(random);
        if (p.target.r == p.source.r && p.target.z == p.source.z) {
            continue;
        }
        const auto exact = reference<Exact>(p.target, p.source);
        worst.include(measure(kernel.singular(p.target, p.source), exact, term_sizes(p.target, p.source, exact)));
    }
    return worst;
}

template <class S>
void check_all_regions(int count, double bound) {
    for (const Region<S>& region : regions<S>()) {
        INFO(region.name);
        const Errors worst = sweep(region, count);
        CHECK(worst.block < bound);
        for (const double entry : worst.entry) {
            CHECK(entry < bound);
        }
    }
}

/// Splits of n sources for one target.
struct Split {
    explicit Split(Point<double> target, const std::vector<double>& r, const std::vector<double>& z)
        : smooth(4, std::vector<double>(r.size())), log_coefficient(smooth) {
        const FreeSpaceKernel<double> kernel;
        kernel.singular_split(target, r.data(), z.data(), static_cast<Index>(r.size()), view(smooth),
                              view(log_coefficient));
    }

    static KernelArrays<double> view(std::vector<std::vector<double>>& columns) {
        return {columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data()};
    }

    std::vector<std::vector<double>> smooth;
    std::vector<std::vector<double>> log_coefficient;
};

double complementary_parameter(Point<double> target, double r, double z) {
    const double zh = z - target.z;
    const double dr = r - target.r;
    const double sum = r + target.r;
    return (dr * dr + zh * zh) / (sum * sum + zh * zh);
}

/// Largest error of the polynomial through the values at the n Chebyshev points, sampled in between.
double interpolation_error(const std::vector<double>& nodes, const std::vector<double>& at_nodes,
                           const std::vector<double>& points, const std::vector<double>& at_points) {
    double worst = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        double value = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            double basis = 1;
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                basis *= i == j ? 1 : (points[p] - nodes[j]) / (nodes[i] - nodes[j]);
            }
            value += basis * at_nodes[i];
        }
        worst = std::max(worst, std::abs(value - at_points[p]));
    }
    return worst;
}

template <class S>
void print_regions(const std::string& type, int count) {
    std::cout << "M, " << type << ": worst error over " << count << " pairs a region, in units of the type's epsilon\n"
              << std::setw(26) << "block" << std::setw(10) << "rr" << std::setw(10) << "rz" << std::setw(10) << "zr"
              << std::setw(10) << "zz" << '\n';
    const double unit = static_cast<double>(std::numeric_limits<S>::epsilon());
    for (const Region<S>& region : regions<S>()) {
        const Errors worst = sweep(region, count);
        std::cout << std::left << std::setw(24) << region.name << std::right << std::fixed << std::setprecision(1)
                  << std::setw(8) << worst.block / unit;
        for (const double entry : worst.entry) {
            std::cout << std::setw(10) << entry / unit;
        }
        std::cout << '\n';
    }
}

}  // namespace

TEST_CASE("the reference agrees with quadrature over the azimuth", "[kernel]") {
    const std::vector<Pair<double>> pairs{
        {{1.0, 0.0}, {0.75, 0.5}}, {{0.3, 0.1}, {2.0, -0.7}}, {{1.0, 0.0}, {1.0, 1.0}}, {{0.0, 0.2}, {0.6, -0.3}}};
    for (const auto& p : pairs) {
        const auto exact = entries(reference<Exact>(p.target, p.source));
        const auto quadrature = entries(by_quadrature(p.target, p.source, 400));
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(abs(Real50(exact[i]) - quadrature[i]) < Real50(1e-40));
        }
    }
}

TEST_CASE("M is accurate in every region", "[kernel]") {
    SECTION("float") {
        check_all_regions<float>(100, 200.0 * 0x1p-23);
    }
    SECTION("double") {
        check_all_regions<double>(100, 1e-13);
    }
    SECTION("long double") {
        check_all_regions<long double>(40, 200.0 * 0x1p-63);
    }
    SECTION("50 digits") {
        check_all_regions<Real50>(20, 200 * static_cast<double>(std::numeric_limits<Real50>::epsilon()));
    }
}

TEST_CASE("M is accurate for a target at r0 = 1e-300", "[kernel]") {
    const FreeSpaceKernel<double> kernel;
    const Point<double> target{1e-300, 0.0};
    for (const Point<double> source : {Point<double>{1.0, 0.5}, {1e-300, 0.5}, {1e-300, 3e-301}, {1.0, 0.0}}) {
        const auto exact = entries(reference<ExactTiny>(target, source));
        const auto value = entries(kernel.singular(target, source));
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(abs(ExactTiny(value[i]) - exact[i]) <= ExactTiny(1e-13) * abs(exact[i]) + ExactTiny(1e-320));
        }
    }
}

TEST_CASE("batches of any size give what single pairs give", "[kernel]") {
    const FreeSpaceKernel<double> kernel;
    const Point<double> target{0.8, 0.1};
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{200}}) {
        std::vector<double> r(n);
        std::vector<double> z(n);
        for (std::size_t i = 0; i < n; ++i) {
            r[i] = 0.05 + 0.011 * static_cast<double>(i);
            z[i] = std::sin(static_cast<double>(i));
        }
        std::vector<std::vector<double>> out(4, std::vector<double>(n));
        kernel.singular(target, r.data(), z.data(), static_cast<Index>(n), Split::view(out));
        for (std::size_t i = 0; i < n; ++i) {
            const auto single = entries(kernel.singular(target, {r[i], z[i]}));
            for (std::size_t c = 0; c < 4; ++c) {
                CHECK(out[c][i] == Approx(single[c]).epsilon(1e-13).margin(1e-14));
            }
        }
    }
}

TEST_CASE("M is reciprocal", "[kernel]") {
    const FreeSpaceKernel<double> kernel;
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Point<double> a{log_uniform(random, -3, 1), 0.0};
        const Point<double> b{log_uniform(random, -3, 1), either_sign(random) * log_uniform(random, -6, 1)};
        const auto ab = kernel.singular(a, b);
        const auto ba = kernel.singular(b, a);
        const double tolerance = 1e-13 * ab.zz / b.r;
        CHECK(std::abs(ab.rr / b.r - ba.rr / a.r) < tolerance);
        CHECK(std::abs(ab.zz / b.r - ba.zz / a.r) < tolerance);
        CHECK(std::abs(ab.rz / b.r - ba.zr / a.r) < tolerance);
        CHECK(std::abs(ab.zr / b.r - ba.rz / a.r) < tolerance);
    }
}

TEST_CASE("sources on the axis give exactly zero", "[kernel]") {
    const FreeSpaceKernel<double> kernel;
    for (const Point<double> target : {Point<double>{0.0, 0.0}, {1.0, 0.0}, {1e-8, 0.3}}) {
        for (const double value : entries(kernel.singular(target, {0.0, 1.0}))) {
            CHECK(value == 0.0);
        }
        const Split split(target, {0.0}, {1.0});
        for (std::size_t c = 0; c < 4; ++c) {
            CHECK(split.smooth[c][0] == 0.0);
            CHECK(split.log_coefficient[c][0] == 0.0);
        }
    }
}

TEST_CASE("the logarithmic split adds up to M", "[kernel]") {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const auto p = pair_at_distance<double>(random, i % 10 == 0 ? 0.0 : log_uniform(random, -4, 1),
                                                log_uniform(random, -8, 1));
        const Split split(p.target, {p.source.r}, {p.source.z});
        const double log_m1 = std::log(complementary_parameter(p.target, p.source.r, p.source.z));
        const auto exact = entries(reference<Exact>(p.target, p.source));
        for (std::size_t c = 0; c < 4; ++c) {
            const double value = split.smooth[c][0] + split.log_coefficient[c][0] * log_m1;
            CHECK(std::abs(value - static_cast<double>(exact[c])) <= 1e-13 * static_cast<double>(exact[3]));
            CHECK((p.target.r != 0.0 || split.log_coefficient[c][0] == 0.0));
        }
    }
}

TEST_CASE("both parts of the split are smooth along an element through the target", "[kernel]") {
    // The element starts at the target, runs towards or along the axis, and is as long as the target's own radius / 2.
    const double radius = 0.4;
    const Point<double> target{radius, 0.2};
    for (const double angle : {0.0, 0.7, 1.5707963267948966, 2.4, 3.141592653589793}) {
        std::vector<double> nodes;
        std::vector<double> points;
        for (int i = 0; i < 16; ++i) {
            nodes.push_back(0.5 - 0.5 * std::cos(3.141592653589793 * (i + 0.5) / 16));
            points.push_back(0.01 + 0.98 * (i + 0.37) / 16);
        }
        const auto along = [&](const std::vector<double>& t) {
            std::vector<double> r;
            std::vector<double> z;
            for (const double x : t) {
                r.push_back(target.r + 0.5 * radius * x * std::cos(angle));
                z.push_back(target.z + 0.5 * radius * x * std::sin(angle));
            }
            return Split(target, r, z);
        };
        const Split at_nodes = along(nodes);
        const Split at_points = along(points);
        for (std::size_t c = 0; c < 4; ++c) {
            CHECK(interpolation_error(nodes, at_nodes.smooth[c], points, at_points.smooth[c]) < 2e-11);
            CHECK(interpolation_error(nodes, at_nodes.log_coefficient[c], points, at_points.log_coefficient[c]) <
                  2e-11);
        }
    }
}

TEST_CASE("the fitted logarithmic coefficient has the exact limit at the target", "[kernel]") {
    // log M_rr and log M_zz tend to -log(m1), M_rz and M_zr to 0 (docs/free_space_kernel.md, section 5).
    const Split split({0.7, 0.0}, {0.7 + 3e-9, 0.7}, {1e-9, -2e-9});
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        CHECK(split.log_coefficient[0][i] == Approx(-1.0).epsilon(1e-7));
        CHECK(split.log_coefficient[3][i] == Approx(-1.0).epsilon(1e-7));
        CHECK(std::abs(split.log_coefficient[1][i]) < 1e-7);
        CHECK(std::abs(split.log_coefficient[2][i]) < 1e-7);
    }
}

TEST_CASE("the split in 50 digits adds up to M", "[kernel]") {
    const FreeSpaceKernel<Real50> kernel;
    const Point<Real50> target{Real50(0.8), Real50(0)};
    for (const double distance : {1e-12, 1e-3, 0.3, 5.0}) {
        const Point<Real50> source{target.r + Real50(distance) / 3, Real50(distance)};
        KernelBlock<Real50> s;
        KernelBlock<Real50> l;
        kernel.singular_split(target, &source.r, &source.z, 1, {&s.rr, &s.rz, &s.zr, &s.zz},
                              {&l.rr, &l.rz, &l.zr, &l.zz});
        const Real50 dr = source.r - target.r;
        const Real50 sum = source.r + target.r;
        const Real50 log_m1 = log(Real50((dr * dr + source.z * source.z) / (sum * sum + source.z * source.z)));
        const auto exact = entries(reference<Exact>(target, source));
        const auto smooth = entries(s);
        const auto logarithmic = entries(l);
        for (std::size_t c = 0; c < 4; ++c) {
            const Real50 value = smooth[c] + logarithmic[c] * log_m1;
            CHECK(abs(value - Real50(exact[c])) < Real50(1e-47));
        }
    }
}

TEST_CASE("a negative or undefined target radius is refused", "[kernel]") {
    const FreeSpaceKernel<double> kernel;
    CHECK_THROWS_AS(kernel.singular({-1.0, 0.0}, {1.0, 0.0}), axistokes::InvalidArgument);
    CHECK_THROWS_AS(kernel.singular({std::nan(""), 0.0}, {1.0, 0.0}), axistokes::InvalidArgument);
}

TEST_CASE("report: worst errors of M by region", "[.report]") {
    print_regions<double>("double", 2000);
    print_regions<float>("float", 1000);
    print_regions<long double>("long double", 500);
    print_regions<Real50>("50 digits", 200);
}
