// SPDX-License-Identifier: MIT
// The plane wall of examples/write_your_own: Blake's images as a user's kernel, pointwise.
#include "../examples/write_your_own/plane_wall.hpp"
#include "catch.hpp"
#include "sphere_at_plane_reference.hpp"
#include "support.hpp"
#include <axistokes/concepts.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/kernel/imaged.hpp>

#include <Eigen/LU>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using axistokes::FreeSpaceKernel;
using axistokes::ImagedKernel;
using axistokes::Index;
using axistokes::KernelBlock;
using axistokes::LinearElements;
using axistokes::Matrix;
using axistokes::Point;
using axistokes::SpectralMeridian;
using axistokes::Vector;
using write_your_own::PlaneImages;
using Multi = boost::multiprecision::cpp_bin_float_50;

template <class S>
S largest(const KernelBlock<S>& m) {
    using std::abs;
    return std::max({S(abs(m.rr)), S(abs(m.rz)), S(abs(m.zr)), S(abs(m.zz))});
}

template <class S>
KernelBlock<S> difference(const KernelBlock<S>& a, const KernelBlock<S>& b) {
    return {a.rr - b.rr, a.rz - b.rz, a.zr - b.zr, a.zz - b.zz};
}

/// What the images add to the velocity at height k, (x, y) from a force at height h: Blake 1971, as printed, with
/// -delta_ij/R - R_i R_j/R^3 + 2 h s_j d/dR_j {h R_i/R^3 - delta_i3/R - R_i R_3/R^3}, s = (1, 1, -1).
std::array<std::array<double, 3>, 3> blake(double x, double y, double h, double k) {
    const std::array<double, 3> v{x, y, h + k};
    const double r2 = x * x + y * y + v[2] * v[2];
    const double r1 = std::sqrt(r2);
    const double r3 = r1 * r2;
    const double r5 = r3 * r2;
    const auto delta = [](std::size_t i, std::size_t j) { return i == j ? 1.0 : 0.0; };
    std::array<std::array<double, 3>, 3> g{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double dipole = delta(i, j) / r3 - 3 * v[i] * v[j] / r5;
            const double doublet =
                -delta(i, 2) * v[j] / r3 + (delta(i, j) * v[2] + v[i] * delta(2, j)) / r3 - 3 * v[i] * v[2] * v[j] / r5;
            g[i][j] = -delta(i, j) / r1 - v[i] * v[j] / r3 + 2 * h * (j == 2 ? -1.0 : 1.0) * (h * dipole - doublet);
        }
    }
    return g;
}

/// The sum over the ring by the trapezoidal rule, which converges exponentially.
KernelBlock<double> ring_of_blake(Point<double> target, Point<double> source, int points) {
    KernelBlock<double> m;
    for (int i = 0; i < points; ++i) {
        const double phi = 2 * axistokes::test::pi * i / points;
        const double c = std::cos(phi);
        const double s = std::sin(phi);
        const auto g = blake(target.r - source.r * c, -source.r * s, source.z, target.z);
        m = m + KernelBlock<double>{g[0][0] * c + g[0][1] * s, g[0][2], g[2][0] * c + g[2][1] * s, g[2][2]};
    }
    const double weight = 2 * axistokes::test::pi * source.r / points;
    return {weight * m.rr, weight * m.rz, weight * m.zr, weight * m.zz};
}

/// Near and far, on the axis and next to it, close to the wall and high over it.
const std::array<Point<double>, 8> points{
    {{0.3, 0.8}, {1.1, 0.6}, {0.0, 1.5}, {1e-6, 0.9}, {2.0, 0.4}, {0.7, 3.0}, {1.4, 1.2}, {5.0, 2.0}}};

using WallKernel = ImagedKernel<double, PlaneImages<double>>;

/// Drag over 6 pi of a unit sphere that moves along z with velocity 1, its centre `height` over the wall at z = -1.5.
template <class Discretization>
double drag_factor(const Discretization& discretization, Index elements, double height) {
    const double wall = -1.5;
    auto m = axistokes::test::Spheroid{1, 1}.meridian(elements);
    m.z.array() += wall + height;
    const Index n = m.nodes();
    const auto surface = discretization.surface(m);
    Matrix<double> system = discretization.single_layer(m, WallKernel(PlaneImages<double>(wall)));
    // The traction is known up to a pressure: its mean normal part is set to zero.
    Vector<double> normal(2 * n);
    normal << surface.normal_r, surface.normal_z;
    Vector<double> weight(2 * n);
    weight << surface.weight, surface.weight;
    system += normal * weight.cwiseProduct(normal).transpose() / surface.weight.sum();
    Vector<double> velocity = Vector<double>::Zero(2 * n);
    velocity.tail(n).setOnes();
    // On the axis u_r = 0 says nothing: f_r = 0 takes its place.
    for (const Index pole : {Index(0), n - 1}) {
        system.row(pole).setZero();
        system(pole, pole) = 1;
    }
    const Vector<double> force = system.partialPivLu().solve(velocity);
    return surface.weight.dot(force.tail(n)) / (6 * axistokes::test::pi);
}

}  // namespace

TEST_CASE("plane wall: the images are Blake's, summed over the ring", "[plane_wall]") {
    const PlaneImages<double> images(0.0);
    for (const Point<double>& source : points) {
        for (const Point<double>& target : points) {
            const auto expected = ring_of_blake(target, source, 400);
            const auto error = difference(images.correction(target, source), expected);
            INFO(target.r << ' ' << target.z << " from " << source.r << ' ' << source.z);
            CHECK(largest(error) <= 2e-14 * std::max(1.0, largest(expected)));
        }
    }
}

TEST_CASE("plane wall: no velocity on the wall", "[plane_wall]") {
    const FreeSpaceKernel<double> free_space;
    for (const double wall : {0.0, -2.5}) {
        const PlaneImages<double> images(wall);
        for (const double height : {1e-6, 1e-3, 0.1, 1.0, 30.0}) {
            for (const double source_radius : {1e-8, 0.3, 1.0, 4.0}) {
                const Point<double> source{source_radius, wall + height};
                for (const double r : {0.0, 1e-7, 0.3, 1.0, 10.0}) {
                    const Point<double> target{r, wall};
                    const KernelBlock<double> single = free_space.singular(target, source);
                    const auto total = single + images.correction(target, source);
                    INFO(height << ' ' << source_radius << ' ' << r);
                    CHECK(largest(total) <= 1e-13 * largest(single));
                }
            }
        }
    }
}

TEST_CASE("plane wall: reciprocity, and no velocity from forces on the wall", "[plane_wall]") {
    const PlaneImages<double> images;
    for (const Point<double>& a : points) {
        for (const Point<double>& b : points) {
            if (a.r == 0 || b.r == 0) {
                continue;
            }
            const auto ab = images.correction(a, b);
            const auto ba = images.correction(b, a);
            const KernelBlock<double> left{ab.rr / b.r, ab.rz / b.r, ab.zr / b.r, ab.zz / b.r};
            const KernelBlock<double> right{ba.rr / a.r, ba.zr / a.r, ba.rz / a.r, ba.zz / a.r};
            CHECK(largest(difference(left, right)) <= 1e-14 * largest(left));
        }
        const Point<double> on_wall{0.8, 0.0};
        const auto single = FreeSpaceKernel<double>{}.singular(a, on_wall);
        CHECK(largest(single + images.correction(a, on_wall)) <= 1e-13 * largest(single));
    }
}

TEST_CASE("plane wall: every entry is accurate, near the axis and close to the wall too", "[plane_wall]") {
    const PlaneImages<double> images;
    const PlaneImages<Multi> exact;
    double worst = 0;
    for (const double height : {1e-7, 1e-4, 0.1, 1.3, 50.0}) {
        for (const double r0 : {1e-9, 1e-3, 0.7, 1.0, 8.0}) {
            for (const double r : {1e-5, 0.2, 1.0, 1.0001}) {
                for (const double k : {1e-6, 0.05, 0.8, 20.0}) {
                    const auto m = images.correction({r0, k}, {r, height});
                    const auto e = exact.correction({Multi(r0), Multi(k)}, {Multi(r), Multi(height)});
                    // An entry may vanish between opposite parts: errors are relative to the larger of it and the
                    // image's Stokeslet, which shares its order at the axis.
                    const auto part = FreeSpaceKernel<double>{}.singular({r0, k}, {r, -height});
                    const auto compare = [&worst](double value, const Multi& reference, double stokeslet) {
                        const double error = std::abs(static_cast<double>(Multi(value) - reference));
                        worst = std::max(worst, error / std::max(std::abs(value), std::abs(stokeslet)));
                    };
                    compare(m.rr, e.rr, part.rr);
                    compare(m.rz, e.rz, part.rz);
                    compare(m.zr, e.zr, part.zr);
                    compare(m.zz, e.zz, part.zz);
                }
            }
        }
    }
    INFO("worst " << worst);
    CHECK(worst < 3e-14);
}

TEST_CASE("plane wall: points below the wall are refused", "[plane_wall]") {
    const PlaneImages<double> images(1.0);
    const Point<double> above{0.5, 1.5};
    for (const auto& message : {axistokes::test::refusal([&] {
                                    images.correction({0.5, 0.75}, above);
                                }),
                                axistokes::test::refusal([&] {
                                    images.correction(above, {0.5, 0.75});
                                })}) {
        CHECK(axistokes::test::mentions(message, "z", "0.75", "at least 1"));
    }
    CHECK_THROWS_AS(PlaneImages<double>(std::nan("")), axistokes::InvalidArgument);
}

TEST_CASE("plane wall: a sphere has Brenner's drag", "[plane_wall]") {
    static_assert(axistokes::GreenKernel<WallKernel>);
    static_assert(WallKernel::laboratory_frame);
    const SpectralMeridian<double> spectral;
    for (const double height : {1.5, 2.0, 5.0, 100.0}) {
        const double error =
            drag_factor(spectral, 32, height) / axistokes::test::sphere_at_plane_drag_factor(height) - 1;
        INFO("height " << height << " error " << error);
        CHECK(std::abs(error) < 1e-12);
    }
    // The film's pressure rises over a distance of sqrt(gap).
    const double close = drag_factor(spectral, 64, 1.1) / axistokes::test::sphere_at_plane_drag_factor(1.1) - 1;
    INFO("height 1.1 error " << close);
    CHECK(std::abs(close) < 1e-12);
}

TEST_CASE("plane wall: P1 elements converge to Brenner's drag at second order", "[plane_wall]") {
    for (const double height : {1.2, 2.0}) {
        const double exact = axistokes::test::sphere_at_plane_drag_factor(height);
        const double coarse = std::abs(drag_factor(LinearElements<double>{}, 48, height) / exact - 1);
        const double fine = std::abs(drag_factor(LinearElements<double>{}, 96, height) / exact - 1);
        INFO("height " << height << " errors " << coarse << ' ' << fine);
        CHECK(axistokes::test::observed_order(coarse, fine) > 1.85);
        CHECK(fine < 1e-3);
    }
}
