// SPDX-License-Identifier: MIT
// A rigid sphere on the axis of a tube: the reference against series, reciprocity and the tube kernel; boundary
// elements against the reference. The hidden report prints the tables of docs/sphere_in_tube.md.
#include "catch.hpp"
#include "sphere_in_tube_reference.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/flow/sum.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>

#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace axistokes;
using axistokes::test::mentions;
using axistokes::test::observed_order;
using axistokes::test::pi;
using axistokes::test::refusal;
using Reference = axistokes::test::SphereInTube<double>;
using Motion = Reference::Motion;

/// Haberman & Sayre (1958), as given by Happel & Brenner, section 7-3.
struct HabermanSayre {
    explicit HabermanSayre(double x) {
        const double x2 = x * x;
        const double x5 = x2 * x2 * x;
        const double denominator = 1 - 2.1050 * x + 2.0865 * x2 * x - 1.7068 * x5 + 0.72603 * x5 * x;
        drag_factor = (1 - 0.75857 * x5) / denominator;
        fixed_drag_factor = (1 - 2 * x2 / 3 - 0.20217 * x5) / denominator;
    }
    double drag_factor;
    double fixed_drag_factor;
};

/// Bohlin (1960), as given by Happel & Brenner, section 7-3, by reflections.
double bohlin_drag_factor(double x) {
    const double x2 = x * x;
    return 1 / (1 - 2.10443 * x + 2.08877 * x2 * x - 0.94813 * std::pow(x, 5) - 1.372 * std::pow(x, 6) +
                3.87 * std::pow(x, 8) - 4.19 * std::pow(x, 10));
}

TubeKernel<double> tube(double confinement, double tolerance) {
    TubeKernel<double>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<double>(1 / confinement, params);
}

template <class Flow>
auto evaluate(double confinement, Index elements, Flow flow) {
    LinearElements<double>::Params params;
    params.tolerance = 1e-10;
    Scene scene(tube(confinement, 1e-10), LinearElements<double>(params), RigidBody<double>{}, flow, DenseLU<double>{});
    return scene.evaluate(Configuration<double>{sphere<double>(elements), 0.0, {}}, 0.0);
}

/// The weight of a sphere that settles at unit velocity in an unbounded fluid.
const Gravity<double> unit_weight(4.5);

/// Values at N, 2N and 4N elements, and their extrapolation to none of the second-order error.
struct Sequence {
    template <class Value>
    Sequence(Index elements, double exact, const Value& value) {
        for (std::size_t i = 0; i < 3; ++i) {
            values[i] = value(elements << i);
            errors[i] = std::abs(values[i] / exact - 1);
        }
        extrapolated = std::abs((4 * values[2] - values[1]) / 3 / exact - 1);
    }
    std::array<double, 3> values{};
    std::array<double, 3> errors{};  // relative
    double extrapolated = 0;
};

/// Largest difference of the elements' traction from that of the reference, scaled, over the largest traction.
template <class Instant>
double traction_error(const Instant& instant, const Reference& reference, const Motion& motion) {
    const auto& nodes = instant.surface.nodes;
    const Index n = nodes.nodes();
    double worst = 0;
    double largest = 0;
    for (Index i = 0; i < n; ++i) {
        const Point<double> exact = reference.traction(motion, std::atan2(nodes.r[i], nodes.z[i]));
        const Vector<double>& f = instant.solution.force;
        worst = std::max(worst, std::hypot(f[i] - exact.r, f[n + i] - exact.z));
        largest = std::max(largest, std::hypot(exact.r, exact.z));
    }
    return worst / largest;
}

/// Pressure drop by the reciprocal theorem: the force density against Poiseuille flow of unit flux.
double reciprocal_pressure_drop(const Reference& reference, const Motion& motion) {
    const double squared = reference.confinement() * reference.confinement();
    return -2 * squared / pi * Reference::integral([&](double theta) {
        const double s = std::sin(theta);
        return reference.traction(motion, theta).z * (1 - squared * s * s);
    });
}

/// Velocity that the reference's traction causes at a point inside the sphere, through the library's tube kernel.
Point<double> single_layer(const Reference& reference, const Motion& motion, Point<double> target) {
    using Gauss = boost::math::quadrature::gauss<double, 20>;
    const TubeKernel<double> kernel = tube(reference.confinement(), 1e-13);
    Point<double> u;
    const auto add = [&](double theta, double weight) {
        const Point<double> f = reference.traction(motion, theta);
        const KernelBlock<double> m = kernel.total(target, {std::sin(theta), std::cos(theta)});
        u.r += weight * (m.rr * f.r + m.rz * f.z) / (8 * pi);
        u.z += weight * (m.zr * f.r + m.zz * f.z) / (8 * pi);
    };
    constexpr int panels = 4;
    const double half = pi / (2 * panels);
    for (int i = 0; i < panels; ++i) {
        for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
            for (const int sign : {-1, 1}) {
                add(half * (2 * i + 1 + sign * Gauss::abscissa()[k]), half * Gauss::weights()[k]);
            }
        }
    }
    return u;
}

/// Of the larger relative error of the two drag factors.
template <class S>
S relative_bound(const axistokes::test::SphereInTube<S>& s) {
    return std::max(S(s.error_bound(s.dragged()) / s.drag_factor()),
                    S(s.error_bound(s.fixed()) / s.fixed_drag_factor()));
}

template <class S>
void print_tables() {
    std::vector<S> confinements;
    for (int i = 1; i <= 9; ++i) {
        confinements.push_back(S(i) / 10);
    }
    confinements.push_back(S(10) / 11);
    std::vector<axistokes::test::SphereInTube<S>> spheres;
    std::cout << "R0/Rc    K              fixed          U/u_max        relative error below   multipoles\n";
    for (const S& x : confinements) {
        spheres.emplace_back(x);
        const auto& s = spheres.back();
        const S bound = relative_bound(s);
        std::cout << std::fixed << std::setprecision(4) << x << std::setprecision(8) << std::setw(15) << s.drag_factor()
                  << std::setw(15) << s.fixed_drag_factor() << std::setw(13) << s.velocity_ratio() << std::scientific
                  << std::setprecision(1) << std::setw(17) << bound << std::setw(15) << 2 * s.pairs() << '\n';
    }
    std::cout << "\nR0/Rc    pressure drop, in eta u/R0: dragged, fixed, floating\n";
    for (const auto& s : spheres) {
        std::cout << std::fixed << std::setprecision(4) << s.confinement() << std::scientific << std::setprecision(7)
                  << std::setw(17) << s.pressure_drop(s.dragged()) << std::setw(16) << s.pressure_drop(s.fixed())
                  << std::setw(16) << s.pressure_drop(s.floating()) << '\n';
    }
    std::cout << "\nR0/Rc    Haberman & Sayre: K, error; fixed, error; U/u_max, error; Bohlin: K, error\n";
    const auto print = [](double value, const S& exact) {
        std::cout << std::fixed << std::setprecision(5) << std::setw(13) << value << std::setprecision(4)
                  << std::setw(10) << 100 * (static_cast<S>(value) / exact - 1) << '%';
    };
    for (const auto& s : spheres) {
        const auto x = static_cast<double>(s.confinement());
        const HabermanSayre h(x);
        std::cout << std::fixed << std::setprecision(4) << x;
        print(h.drag_factor, s.drag_factor());
        print(h.fixed_drag_factor, s.fixed_drag_factor());
        print(h.fixed_drag_factor / h.drag_factor, s.velocity_ratio());
        print(bohlin_drag_factor(x), s.drag_factor());
        std::cout << '\n';
    }
}

}  // namespace

TEST_CASE("the reference has converged", "[sphere]") {
    for (const double x : {0.1, 0.5, 0.9, 1 / 1.1}) {
        INFO("confinement " << x);
        const Reference sphere(x);
        const Reference finer(x, sphere.pairs() * 5 / 4);
        CHECK(sphere.error_bound(sphere.dragged()) < 1e-11 * sphere.drag_factor());
        CHECK(sphere.error_bound(sphere.fixed()) < 1e-11 * sphere.fixed_drag_factor());
        CHECK(sphere.drag_factor() == Approx(finer.drag_factor()).epsilon(1e-11));
        CHECK(sphere.fixed_drag_factor() == Approx(finer.fixed_drag_factor()).epsilon(1e-11));
    }
}

TEST_CASE("the reference's error stays within its bound", "[sphere]") {
    const double x = 0.8;
    const Reference exact(x);
    double last = std::numeric_limits<double>::infinity();
    for (const Index pairs : {4, 8, 12}) {
        INFO("pairs " << pairs);
        const Reference coarse(x, pairs);
        const double error = std::abs(coarse.drag_factor() - exact.drag_factor());
        CHECK(error < coarse.error_bound(coarse.dragged()));
        CHECK(error < last / 10);
        last = error;
    }
}

TEST_CASE("the reference refuses what it is not made for", "[sphere]") {
    for (const double x : {0.0, -0.5, 1.0, std::nan("")}) {
        CHECK(mentions(refusal([&] { Reference sphere(x); }), "confinement", "must be", "in (0, 1)"));
    }
    CHECK(mentions(refusal([] { Reference sphere(0.98); }), "confinement", "must be", "within the type's range"));
}

TEST_CASE("the reference agrees with published values", "[sphere]") {
    // Bohlin's series comes with 5 digits, the closed form is good to some 1e-4 up to 0.3.
    for (const double x : {0.05, 0.1}) {
        CHECK(bohlin_drag_factor(x) == Approx(Reference(x).drag_factor()).epsilon(1e-5));
    }
    for (const double x : {0.05, 0.1, 0.2, 0.3}) {
        INFO("confinement " << x);
        const Reference sphere(x);
        const HabermanSayre h(x);
        CHECK(h.drag_factor == Approx(sphere.drag_factor()).epsilon(2e-4));
        CHECK(h.fixed_drag_factor == Approx(sphere.fixed_drag_factor()).epsilon(7e-4));
        CHECK(h.fixed_drag_factor / h.drag_factor == Approx(sphere.velocity_ratio()).epsilon(9e-4));
    }
    const Reference half(0.5);
    CHECK(half.drag_factor() == Approx(5.94737425).epsilon(1e-9));
    CHECK(half.velocity_ratio() == Approx(0.83992337).epsilon(6e-9));
}

TEST_CASE("the reference's forces, tractions and pressure drops belong together", "[sphere]") {
    for (const double x : {0.2, 0.6, 0.9}) {
        INFO("confinement " << x);
        const Reference sphere(x);
        const double scale = sphere.force(sphere.fixed());
        for (const Motion& motion : {sphere.dragged(), sphere.fixed(), sphere.floating()}) {
            const double carried = Reference::integral([&](double theta) { return sphere.traction(motion, theta).z; });
            CHECK(carried == Approx(-sphere.force(motion)).margin(1e-10 * scale));
            CHECK(sphere.pressure_drop(motion) ==
                  Approx(reciprocal_pressure_drop(sphere, motion)).margin(1e-11 * scale * x * x));
        }
        // Reciprocal theorem between the dragged and the fixed sphere.
        CHECK(sphere.pressure_drop(sphere.dragged()) ==
              Approx(-12 * x * x * sphere.fixed_drag_factor()).epsilon(1e-11));
        CHECK(sphere.pressure_drop(sphere.floating()) > 0);
    }
}

TEST_CASE("the fluid inside the reference's traction moves like the sphere", "[sphere]") {
    for (const double x : {0.3, 0.8}) {
        const Reference sphere(x);
        for (const Motion& motion : {sphere.dragged(), sphere.fixed(), sphere.floating()}) {
            for (const Point<double> target : {Point<double>{0.0, 0.0}, {0.4, -0.3}}) {
                INFO("confinement " << x << ", point " << target.r << ' ' << target.z);
                const Point<double> u = single_layer(sphere, motion, target);
                const double undisturbed = motion.flow * (1 - x * x * target.r * target.r);
                CHECK(u.r == Approx(0.0).margin(1e-10));
                CHECK(u.z + undisturbed == Approx(motion.velocity).margin(1e-10));
            }
        }
    }
}

TEST_CASE("the drag of a sphere in a tube converges to the reference", "[sphere]") {
    const auto sequence = [](double x, Index elements) {
        return Sequence(elements, Reference(x).drag_factor(),
                        [&](Index n) { return -1 / evaluate(x, n, unit_weight).velocity; });
    };
    for (const double x : {0.1, 0.5}) {
        INFO("confinement " << x);
        const Sequence k = sequence(x, 32);
        CHECK(observed_order(k.errors[1], k.errors[2]) > 1.9);
        CHECK(k.errors[2] < 1e-4);
        CHECK(k.extrapolated < 1e-6);
    }
    // A gap of a ninth of the radius takes elements below it before the order shows.
    const Sequence k = sequence(0.9, 64);
    CHECK(observed_order(k.errors[1], k.errors[2]) > 1.9);
    CHECK(k.errors[2] < 3e-4);
    CHECK(k.extrapolated < 1e-4);
}

TEST_CASE("the velocity of a sphere in Poiseuille flow converges to the reference", "[sphere]") {
    for (const double x : {0.1, 0.5, 0.9}) {
        INFO("confinement " << x);
        const Sequence u(32, Reference(x).velocity_ratio(),
                         [&](Index n) { return evaluate(x, n, Poiseuille<double>(1, 1 / x)).velocity; });
        CHECK(observed_order(u.errors[1], u.errors[2]) > 1.8);
        CHECK(u.errors[2] < 4e-5);
        CHECK(u.extrapolated < 4e-6);
    }
}

TEST_CASE("the traction of a sphere in a tube is the reference's", "[sphere]") {
    for (const double x : {0.1, 0.5, 0.9}) {
        INFO("confinement " << x);
        const Reference sphere(x);
        const Motion settling = sphere.dragged() * (-1 / sphere.drag_factor());
        for (const bool floating : {false, true}) {
            std::array<double, 2> errors{};
            for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
                const Index n = Index{64} << i;
                const auto compare = [&](const auto& instant, const Motion& motion) {
                    const Vector<double>& f = instant.solution.force;
                    const double asymmetry = (f.tail(n + 1) - f.tail(n + 1).reverse()).cwiseAbs().maxCoeff() +
                                             (f.head(n + 1) + f.head(n + 1).reverse()).cwiseAbs().maxCoeff();
                    CHECK(asymmetry < 1e-8 * f.cwiseAbs().maxCoeff());
                    return traction_error(instant, sphere, motion);
                };
                errors[i] = floating ? compare(evaluate(x, n, Poiseuille<double>(1, 1 / x)), sphere.floating())
                                     : compare(evaluate(x, n, unit_weight), settling);
            }
            INFO((floating ? "floating, " : "settling, ") << errors[0] << ' ' << errors[1]);
            CHECK(observed_order(errors[0], errors[1]) > 1.5);
            CHECK(errors[1] < 2e-3);
        }
    }
}

TEST_CASE("the pressure drop of a sphere in a tube is the reference's", "[sphere]") {
    for (const double x : {0.2, 0.5, 0.8}) {
        INFO("confinement " << x);
        const Reference sphere(x);
        const Poiseuille<double> flow(1, 1 / x);
        const Sequence floating(32, reciprocal_pressure_drop(sphere, sphere.floating()),
                                [&](Index n) { return evaluate(x, n, flow).pressure_drop; });
        CHECK(observed_order(floating.errors[1], floating.errors[2]) > 1.8);
        CHECK(floating.extrapolated < 1e-4);
        // The weight that holds the sphere against the flow.
        const Gravity<double> held(4.5 * sphere.fixed_drag_factor());
        CHECK(std::abs(evaluate(x, 128, Sum(flow, held)).velocity) < 1e-3);
        const Sequence fixed(32, reciprocal_pressure_drop(sphere, sphere.fixed()),
                             [&](Index n) { return evaluate(x, n, Sum(flow, held)).pressure_drop; });
        CHECK(observed_order(fixed.errors[1], fixed.errors[2]) > 1.8);
        CHECK(fixed.extrapolated < 1e-4);
    }
}

TEST_CASE("report: a rigid sphere on the axis of a tube", "[.report]") {
    print_tables<long double>();
}

TEST_CASE("report: a rigid sphere that almost fills a tube", "[.report]") {
    std::cout << "R0/Rc  K  fixed  U/u_max  relative error below  multipoles\n";
    for (const long double x : {0.95L, 0.98L, 0.99L, 0.995L}) {
        const axistokes::test::SphereInTube<long double> s(x);
        std::cout << std::defaultfloat << std::setprecision(12) << x << "  " << s.drag_factor() << "  "
                  << s.fixed_drag_factor() << "  " << s.velocity_ratio() << "  " << std::setprecision(2)
                  << relative_bound(s) << "  " << 2 * s.pairs() << std::endl;
    }
}
