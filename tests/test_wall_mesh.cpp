// SPDX-License-Identifier: MIT
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <Eigen/SVD>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace {

using namespace axistokes;

constexpr double kPi = std::numbers::pi;
const FreeSpaceKernel<double> kFreeSpace;

LinearElements<double> accurate_elements() {
    LinearElements<double>::Params params;
    params.tolerance = 1e-10;
    return LinearElements<double>(params);
}

/// Panels on the unit sphere.
PanelCurve<double> panel_sphere(Index panels, Index nodes) {
    PanelCurve<double> curve(nodes, 1e-12);
    const double turn = kPi / static_cast<double>(panels);
    for (Index e = 0; e < panels; ++e) {
        curve.append([&](double t) {
            const double angle = turn * (static_cast<double>(e) + t);
            CurvePoint<double> x;
            x.position = {std::sin(angle), -std::cos(angle)};
            x.first = {turn * std::cos(angle), turn * std::sin(angle)};
            return x;
        });
    }
    return curve;
}

template <class Profile>
WallMesh<Profile> wall(const Profile& profile, double flow_rate, double tolerance) {
    WallMeshParams<double> params;
    params.flow_rate = flow_rate;
    params.tolerance = tolerance;
    return WallMesh<Profile>(profile, params);
}

Meridian<double> shifted(Meridian<double> shape, double z) {
    shape.z.array() += z;
    return shape;
}

/// A rigid body on which a force acts, free to move, without the time stepper.
struct Motion {
    double velocity;
    double force;
    double pressure_drop;
    Vector<double> traction;
};

MobilitySolution<double> solve_rigid(const LinearSurface<double>& surface, const Matrix<double>& mobility,
                                     const Vector<double>& background, const Vector<double>& load) {
    DenseLU<double> solver;
    return detail::lone_motion<double>(RigidBody<double>(), surface, mobility, background, load, solver);
}

/// By the reciprocal theorem with the undisturbed flow of unit flow rate at the nodes.
double added_pressure_drop(const LinearSurface<double>& surface, const Vector<double>& force,
                           const Vector<double>& unit_flow) {
    Vector<double> weights(force.size());
    weights << surface.weight, surface.weight;
    return -weights.dot(force.cwiseProduct(unit_flow));
}

template <class Wall>
Motion motion(Wall& walls, const Meridian<double>& body, double load) {
    const LinearElements<double> elements = accurate_elements();
    const LinearSurface<double> surface = elements.surface(body);
    const Index n = body.nodes();
    Matrix<double> mobility = elements.single_layer(body, kFreeSpace);
    Vector<double> background = Vector<double>::Zero(2 * n);
    const Vector<double> unit_flow = walls.confine(elements, kFreeSpace, {body}, mobility, background);
    Vector<double> loads = Vector<double>::Zero(2 * n);
    loads.tail(n).setConstant(load);
    const auto solution = solve_rigid(surface, mobility, background, loads);
    return {solution.velocity[n], load * surface.weight.sum(), added_pressure_drop(surface, solution.force, unit_flow),
            solution.force};
}

template <class Wall>
double drag_factor(Wall& walls, const Meridian<double>& body) {
    const Motion m = motion(walls, body, 1.0);
    return m.force / (6 * kPi * m.velocity);
}

void check_refused(const std::function<void()>& action, const std::string& reason) {
    try {
        action();
        FAIL("not refused: " << reason);
    } catch (const InvalidArgument& error) {
        INFO(error.what());
        CHECK(std::string(error.what()).find(reason) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("Panels reproduce the single layer of a sphere spectrally") {
    // Traction 3/2 e_z makes the unit sphere translate with velocity e_z; a pressure moves nothing.
    double coarse = 0;
    for (const Index nodes : {6, 8, 10}) {
        const PanelCurve<double> curve = panel_sphere(2, nodes);
        const Index n = curve.size();
        const Matrix<double> g = curve.single_layer(kFreeSpace);
        Vector<double> expected = Vector<double>::Zero(2 * n);
        expected.tail(n).setOnes();
        const double error = (g * (1.5 * expected) - expected).lpNorm<Eigen::Infinity>();
        CHECK((g * curve.normals()).lpNorm<Eigen::Infinity>() < error + 1e-12);
        if (nodes > 6) {
            CHECK(error < coarse / 50);
        }
        coarse = error;
    }
    CHECK(coarse < 1e-10);
}

TEST_CASE("Panels serve targets at any distance") {
    const PanelCurve<double> curve = panel_sphere(4, 12);
    Vector<double> traction = Vector<double>::Zero(2 * curve.size());
    traction.tail(curve.size()).setConstant(1.5);
    for (const double gap : {0.5, 1e-2, 1e-4, 1e-6}) {
        const double angle = 1.1;
        const Meridian<double> inside{Vector<double>::Constant(1, (1 - gap) * std::sin(angle)),
                                      Vector<double>::Constant(1, (1 - gap) * std::cos(angle))};
        const Vector<double> u = curve.single_layer_at(inside, kFreeSpace) * traction;
        INFO("gap " << gap);
        CHECK(std::abs(u[0]) < 1e-11);
        CHECK(u[1] == Approx(1.0).epsilon(1e-11));
    }
}

TEST_CASE("Slopes of the profiles are the derivatives of their radii") {
    const auto check = [](const auto& profile) {
        for (int i = 0; i <= 40; ++i) {
            const double z = profile.begin() + (profile.end() - profile.begin()) * (i + 0.5) / 41;
            const double step = 1e-5;
            const double chord = (profile.radius(z + step) - profile.radius(z - step)) / (2 * step);
            CHECK(profile.slope(z) == Approx(chord).margin(1e-7));
        }
        CHECK(profile.slope(profile.begin()) == Approx(0.0).margin(1e-12));
        CHECK(profile.slope(profile.end()) == Approx(0.0).margin(1e-12));
    };
    check(Constriction<double>(0.6, 1.2, 2.5));
    check(Pore<double>(0.6, 1.2, 2.0, 1.5));
    check(PointsProfile<double>({-2.0, -1.0, 0.0, 1.5, 3.0}, {1.2, 1.0, 0.7, 0.8, 1.3}));
    check(CallableProfile(
        -kPi, kPi, [](double z) { return 1.2 - 0.2 * std::cos(z); }, [](double z) { return 0.2 * std::sin(z); }));
    CHECK(Pore<double>(0.6, 1.2, 2.0, 1.5).radius(-0.9) == 0.6);
    CHECK(Pore<double>(0.6, 1.2, 2.0, 1.5).radius(2.5) == Approx(1.2));
    CHECK(Constriction<double>(0.6, 1.2, 2.5).radius(0.0) == 0.6);
}

TEST_CASE("A profile through points has no extrema but at the points") {
    const PointsProfile<double> profile({0.0, 1.0, 1.1, 3.0, 4.0}, {2.0, 1.9, 0.8, 0.8, 1.0});
    double previous = 2.0;
    for (int i = 1; i <= 1000; ++i) {
        const double z = 3.0 * i / 1000;
        CHECK(profile.radius(z) <= previous + 1e-14);
        previous = profile.radius(z);
    }
    CHECK(previous == Approx(0.8));
}

TEST_CASE("The rank of the wall's block is completed") {
    const ChannelMesh<StraightTube<double>> mesh(StraightTube<double>(1.0), {}, sphere<double>(16, 0.3));
    const PanelCurve<double>& curve = mesh.curve();
    const Vector<double> normals = curve.normals();
    Vector<double> flux(2 * curve.size());
    flux << curve.weights(), curve.weights();
    flux.array() *= normals.array() / curve.weights().sum();
    const Matrix<double> a = curve.single_layer(kFreeSpace);
    CHECK((a * normals).lpNorm<Eigen::Infinity>() < 1e-6);
    CHECK((flux.transpose() * a).lpNorm<Eigen::Infinity>() < 1e-6);
    const Matrix<double> completed = a + normals * flux.transpose();
    const auto smallest = [](const Matrix<double>& m) {
        return Eigen::JacobiSVD<Matrix<double>>(m).singularValues().tail(1)[0];
    };
    CHECK(smallest(a) < 1e-7);
    CHECK(smallest(completed) > 1e-4);
    // The solution is the one without mean normal part.
    const Vector<double> g = mesh.boundary_velocity();
    CHECK(std::abs(flux.dot(g)) < 1e-12);
    const Vector<double> q = completed.partialPivLu().solve(g);
    CHECK(std::abs(flux.dot(q)) < 1e-6 * q.lpNorm<Eigen::Infinity>());
}

TEST_CASE("An empty straight tube carries Poiseuille flow") {
    const double radius = 1.3;
    const double flow_rate = 2.0;
    const Meridian<double> small = sphere<double>(16, 0.2);
    const Vector<double> no_force = Vector<double>::Zero(2 * small.nodes());
    const Vector<double> weight = linear_surface(small).weight;
    const LinearElements<double> elements;
    const auto error = [&](auto tube) {
        const auto field = tube.field(elements, kFreeSpace, small, no_force);
        const Meridian<double> points{Vector<double>::LinSpaced(7, 0.0, 0.99 * radius),
                                      Vector<double>::LinSpaced(7, -0.4, 0.3)};
        const Vector<double> u = field.velocity(points);
        double largest = u.head(7).lpNorm<Eigen::Infinity>();
        for (Index i = 0; i < 7; ++i) {
            const double x = points.r[i] / radius;
            largest = std::max(largest, std::abs(u[7 + i] - 2 * flow_rate / (kPi * radius * radius) * (1 - x * x)));
        }
        const double drop = field.axis_pressure(-0.5, weight) - field.axis_pressure(0.5, weight);
        largest = std::max(largest, std::abs(drop * kPi * std::pow(radius, 4) / (8 * flow_rate) - 1));
        return std::max(largest, std::abs(field.flow_rate(0.3, radius) / flow_rate - 1));
    };
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        CHECK(error(wall(StraightTube<double>(radius), flow_rate, tolerance)) < tolerance / 10);
    }
    double coarse = 1;
    for (const Index nodes : {3, 5, 7}) {
        WallMeshParams<double> params;
        params.flow_rate = flow_rate;
        params.tolerance = 1e-9;
        params.length = 2.0;
        params.panels = 4;
        params.nodes_per_panel = nodes;
        const double fine = error(WallMesh<StraightTube<double>>(StraightTube<double>(radius), params));
        CHECK(fine < coarse / 10);
        coarse = fine;
    }
}

TEST_CASE("The flow rate is the same through any section of a constriction") {
    const LinearElements<double> elements = accurate_elements();
    const Constriction<double> profile(0.6, 1.2, 2.0);
    const Meridian<double> body = shifted(spheroid<double>(0.45, 0.7, 60), -0.3);
    for (const double tolerance : {1e-3, 1e-5}) {
        auto channel = wall(profile, 1.5, tolerance);
        const Motion m = motion(channel, body, 0.0);
        const auto field = channel.field(elements, kFreeSpace, body, m.traction);
        for (const double z : {-2.2, -1.3, -0.55, -0.1, 0.2, 0.8, 2.1}) {
            INFO("z " << z << ", tolerance " << tolerance);
            CHECK(field.flow_rate(z, channel.radius(z)) == Approx(1.5).epsilon(tolerance));
        }
    }
}

TEST_CASE("Drag of a sphere in a tube converges to the exact one") {
    // Haberman & Sayre's series in 30 digits, for a radius ratio of 0.5.
    constexpr double kExact = 5.94737425;
    auto tube = wall(StraightTube<double>(2.0), 0.0, 1e-6);
    const double coarse = drag_factor(tube, sphere<double>(40)) - kExact;
    const double fine = drag_factor(tube, sphere<double>(80)) - kExact;
    CHECK(std::abs(fine) < 3e-4 * kExact);
    CHECK(std::log2(coarse / fine) > 1.8);
    CHECK((4 * fine - coarse) / 3 == Approx(0.0).margin(3e-5));
    CHECK(tube.meshes() <= 2);
}

TEST_CASE("Wall mesh and tube kernel give the same drag and pressure drop") {
    for (const double radius : {2.0, 1.1}) {
        const Meridian<double> body = sphere<double>(60);
        const LinearElements<double> elements = accurate_elements();
        const LinearSurface<double> surface = elements.surface(body);
        const Index n = body.nodes();
        TubeKernel<double>::Params kernel_params;
        kernel_params.tolerance = 1e-9;
        const TubeKernel<double> kernel(radius, kernel_params);
        const Matrix<double> mobility = elements.single_layer(body, kernel);
        Vector<double> load = Vector<double>::Zero(2 * n);
        load.tail(n).setOnes();
        const Vector<double> none = Vector<double>::Zero(2 * n);
        const auto exact = solve_rigid(surface, mobility, none, load);
        Vector<double> unit_flow(2 * n);
        for (Index i = 0; i < n; ++i) {
            const Point<double> u = kernel.unit_flow({body.r[i], body.z[i]});
            unit_flow[i] = u.r;
            unit_flow[n + i] = u.z;
        }
        for (const double tolerance : {1e-3, 1e-5, 1e-6}) {
            auto tube = wall(StraightTube<double>(radius), 0.0, tolerance);
            const Motion m = motion(tube, body, 1.0);
            INFO("radius " << radius << ", tolerance " << tolerance);
            CHECK(m.velocity == Approx(exact.velocity[n]).epsilon(tolerance));
            CHECK(m.pressure_drop == Approx(added_pressure_drop(surface, exact.force, unit_flow)).epsilon(tolerance));
            // Tractions are known up to a pressure.
            const Vector<double> difference = m.traction - exact.force;
            CHECK(difference.norm() < 10 * tolerance * exact.force.norm());
        }
    }
}

TEST_CASE("The Schur complement is the coupled system's solution") {
    const LinearElements<double> elements = accurate_elements();
    const Constriction<double> profile(0.7, 1.2, 2.0);
    const Meridian<double> body = shifted(spheroid<double>(0.5, 0.8, 20), 0.4);
    auto channel = wall(profile, 2.0, 1e-5);
    Matrix<double> mobility = elements.single_layer(body, kFreeSpace);
    const Matrix<double> unbounded = mobility;
    Vector<double> background = Vector<double>::Zero(2 * body.nodes());
    channel.confine(elements, kFreeSpace, {body}, mobility, background);

    const PanelCurve<double>& curve = channel.mesh()->curve();
    const Index w = 2 * curve.size();
    const Index p = 2 * body.nodes();
    Vector<double> flux(w);
    flux << curve.weights(), curve.weights();
    flux.array() *= curve.normals().array() / curve.weights().sum();
    // Unknowns: wall tractions q and particle velocities u for a given force density f.
    Matrix<double> coupled = Matrix<double>::Zero(w + p, w + p);
    coupled.topLeftCorner(w, w) = curve.single_layer(kFreeSpace) + curve.normals() * flux.transpose();
    coupled.bottomLeftCorner(p, w) = -curve.single_layer_at(body, kFreeSpace);
    coupled.bottomRightCorner(p, p).setIdentity();
    const Vector<double> f = Vector<double>::LinSpaced(p, -1.0, 2.0);
    Vector<double> rhs(w + p);
    rhs << 2.0 * channel.mesh()->boundary_velocity() - elements.single_layer_at(curve.nodes(), body, kFreeSpace) * f,
        unbounded * f;
    const Vector<double> u = coupled.fullPivLu().solve(rhs).tail(p);
    CHECK((mobility * f + background - u).lpNorm<Eigen::Infinity>() < 1e-9 * u.lpNorm<Eigen::Infinity>());
}

TEST_CASE("A confined mobility is symmetric as far as the particle's discretisation is") {
    // Reciprocity: W G is symmetric for the exact surface integrals, up to the P1 elements' error.
    const LinearElements<double> elements = accurate_elements();
    const auto asymmetry = [&](Index n) {
        const Meridian<double> body = sphere<double>(n, 0.8);
        auto tube = wall(StraightTube<double>(1.0), 0.0, 1e-7);
        Matrix<double> mobility = elements.single_layer(body, kFreeSpace);
        const Matrix<double> unbounded = mobility;
        Vector<double> background = Vector<double>::Zero(2 * body.nodes());
        tube.confine(elements, kFreeSpace, {body}, mobility, background);
        const Vector<double> weight = elements.surface(body).weight;
        Vector<double> weights(2 * body.nodes());
        weights << weight, weight;
        const Matrix<double> power = weights.asDiagonal() * (mobility - unbounded);
        return (power - power.transpose()).norm() / power.norm();
    };
    const double coarse = asymmetry(20);
    const double fine = asymmetry(40);
    CHECK(fine < 0.01);
    CHECK(fine < coarse / 2);
}

TEST_CASE("In a straight tube the flow may come from the wall or from the background") {
    const double radius = 1.25;
    const double peak = 3.0;
    const Meridian<double> body = sphere<double>(40);
    const LinearElements<double> elements = accurate_elements();
    auto carried = wall(StraightTube<double>(radius), kPi * radius * radius * peak / 2, 1e-6);
    Matrix<double> mobility = elements.single_layer(body, kFreeSpace);
    Vector<double> background = Vector<double>::Zero(2 * body.nodes());
    carried.confine(elements, kFreeSpace, {body}, mobility, background);
    const Poiseuille<double> imposed(peak, radius);
    double error = 0;
    for (Index i = 0; i < body.nodes(); ++i) {
        error = std::max(error, std::abs(background[i]));
        error = std::max(error, std::abs(background[body.nodes() + i] - imposed.velocity({body.r[i], body.z[i]}).z));
    }
    CHECK(error < 1e-6 * peak);
}

TEST_CASE("The added pressure drop is that of the pressures far up- and downstream") {
    const LinearElements<double> elements = accurate_elements();
    const auto check = [&](const auto& profile, double section) {
        const double flow_rate = 2.0;
        auto channel = wall(profile, flow_rate, 1e-6);
        double error[2];
        int k = 0;
        for (const Index n : {40, 80}) {
            const Meridian<double> body = shifted(spheroid<double>(0.5, 0.7, n), 0.2);
            const Motion m = motion(channel, body, 0.7);
            const Vector<double> weight = linear_surface(body).weight;
            const auto field = channel.field(elements, kFreeSpace, body, m.traction);
            const auto empty = channel.unit_field(elements, kFreeSpace, body);
            const auto drop = [&](const auto& f) {
                return f.axis_pressure(-section, weight) - f.axis_pressure(section, weight);
            };
            error[k++] = m.pressure_drop / (drop(field) - flow_rate * drop(empty)) - 1;
        }
        INFO(error[0] << " " << error[1]);
        CHECK(std::abs(error[1]) < 2e-3);
        CHECK(std::abs(error[1]) < std::abs(error[0]) / 2);
    };
    check(Constriction<double>(0.7, 1.0, 2.0), 3.0);
    check(Pore<double>(0.7, 0.9, 1.0, 1.5), 3.0);
}

TEST_CASE("Results do not depend on where in a straight tube the particle is") {
    auto tube = wall(StraightTube<double>(1.3), 2.0, 1e-5);
    const Motion here = motion(tube, sphere<double>(30), 0.3);
    const Motion there = motion(tube, shifted(sphere<double>(30), 17.0), 0.3);
    CHECK(there.velocity == Approx(here.velocity).epsilon(1e-10));
    CHECK(there.pressure_drop == Approx(here.pressure_drop).epsilon(1e-9));
    CHECK(tube.meshes() == 1);
}

TEST_CASE("Meshes as asked for") {
    const Meridian<double> body = sphere<double>(40);
    auto standard = wall(StraightTube<double>(1.5), 0.0, 1e-6);
    const double drag = drag_factor(standard, body);
    WallMeshParams<double> params;
    params.panels = 40;
    params.nodes_per_panel = 6;
    params.length = 3.0;
    for (const WallGrading grading : {WallGrading::uniform, WallGrading::quadratic, WallGrading::automatic}) {
        params.grading = grading;
        WallMesh<StraightTube<double>> tube(StraightTube<double>(1.5), params);
        CHECK(drag_factor(tube, body) == Approx(drag).epsilon(1e-4));
        CHECK(tube.mesh()->wall_panels() == 40);
        CHECK(tube.mesh()->upper() == Approx(4.0));
        CHECK(tube.mesh()->lower() == Approx(-4.0));
    }
}

TEST_CASE("Geometric limits of a vesicle's passage") {
    const double radius = 0.7;
    const double cylinder = 2.0;
    const double area = 2 * kPi * radius * cylinder + 4 * kPi * radius * radius;
    const double volume = kPi * radius * radius * cylinder + 4 * kPi / 3 * std::pow(radius, 3);
    CHECK(critical_tube_radius(area, volume) == Approx(radius).epsilon(1e-12));
    CHECK(critical_tube_length(area, radius) == Approx(cylinder + 2 * radius).epsilon(1e-12));
    CHECK(critical_tube_radius(4 * kPi, 4 * kPi / 3) == Approx(1.0).epsilon(1e-7));
    CHECK(critical_orifice_radius(4 * kPi, 4 * kPi / 3) == Approx(1.0).epsilon(1e-3));
    // Two spheres of half the volume have 2^(1/3) times the area and pass through any hole.
    CHECK(critical_orifice_radius(1.0001 * std::cbrt(2.0) * 4 * kPi, 4 * kPi / 3) == 0.0);
    const double hole = critical_orifice_radius(4 * kPi + 1, 4 * kPi / 3);
    CHECK(hole > 0.0);
    CHECK(hole < critical_tube_radius(4 * kPi + 1, 4 * kPi / 3));

    const double tube = critical_tube_radius(4 * kPi + 1, 4 * kPi / 3);
    CHECK_NOTHROW(require_passage(Pore<double>(tube * 1.01, 1.5, 20.0, 1.0), 4 * kPi + 1, 4 * kPi / 3));
    CHECK_NOTHROW(require_passage(Pore<double>(tube * 0.99, 1.5, 0.2, 1.0), 4 * kPi + 1, 4 * kPi / 3));
    check_refused([&] { require_passage(Pore<double>(tube * 0.99, 1.5, 20.0, 1.0), 4 * kPi + 1, 4 * kPi / 3); },
                  "over the length of the throat, no narrower tube holds");
    check_refused([&] { require_passage(Pore<double>(hole * 0.99, 1.5, 0.2, 1.0), 4 * kPi + 1, 4 * kPi / 3); },
                  "no narrower hole lets through");
    check_refused([&] { require_passage(StraightTube<double>(tube * 0.99), 4 * kPi + 1, 4 * kPi / 3); },
                  "no narrower tube holds");

    // Whatever fits into a tube of the throat's radius passes, however short or smooth the throat.
    CHECK_NOTHROW(require_passage(Constriction<double>(1.2, 2.0, 2.0), 4 * kPi, 4 * kPi / 3));
    for (const double excess_area : {0.1, 0.5, 1.0, 2.0}) {
        const double narrowest = critical_tube_radius(4 * kPi + excess_area, 4 * kPi / 3);
        for (const double throat : {1.0001 * narrowest, 0.5 + narrowest / 2, 1.05, 1.1}) {
            for (const double half_length : {0.1, 2.0, 20.0}) {
                CHECK_NOTHROW(require_passage(Constriction<double>(throat, 1.5, half_length), 4 * kPi + excess_area,
                                              4 * kPi / 3));
            }
        }
        check_refused(
            [&] {
                require_passage(Pore<double>(0.999 * narrowest, 1.5, 20.0, 1.0), 4 * kPi + excess_area, 4 * kPi / 3);
            },
            "throat radius = ");
    }
    // Two spheres on a thread pass any throat.
    CHECK_NOTHROW(require_passage(Pore<double>(0.1, 1.5, 20.0, 1.0), 4 * kPi + 4, 4 * kPi / 3));
}

TEST_CASE("Area needed halfway through a channel") {
    const double volume = 4 * kPi / 3;
    const auto area_to_pass_tube = [&](double radius) {
        // Cylinder with hemispherical ends.
        return 2 * volume / radius + 4 * kPi * radius * radius / 3;
    };
    // In a long throat the vesicle is that cylinder, in a short one nearly the two caps in a hole.
    CHECK(*halfway_area(Pore<double>(0.7, 1.5, 20.0, 1.0), volume) == Approx(area_to_pass_tube(0.7)).epsilon(1e-6));
    const double area = 4 * kPi + 1;
    const double hole = critical_orifice_radius(area, volume);
    CHECK(*halfway_area(Constriction<double>(hole, 4.0, 0.1), volume) == Approx(area).epsilon(5e-3));
    double before = area;
    for (const double half_length : {0.5, 1.0, 2.0}) {
        const double needed = *halfway_area(Constriction<double>(hole, 1.5, half_length), volume);
        CHECK(needed > before);
        CHECK(needed < area_to_pass_tube(hole));
        before = needed;
    }
    // Never more than two spheres.
    CHECK(*halfway_area(Pore<double>(0.45, 1.5, 20.0, 1.0), volume) == Approx(std::cbrt(2.0) * 4 * kPi));
    CHECK_FALSE(halfway_area(StraightTube<double>(0.7), volume).has_value());
    // A sphere that the throat does not touch.
    for (const double throat : {1.0, 1.2}) {
        CHECK(*halfway_area(Constriction<double>(throat, 1.5, 2.0), volume) == Approx(4 * kPi).epsilon(1e-14));
    }

    // A throat wider than the critical hole, and shorter than the vesicle.
    check_refused([&] { require_passage(Constriction<double>(0.5, 1.5, 2.0), 4 * kPi + 2, volume); },
                  "halfway through, a vesicle of volume 4.18879 needs an area of 14.7");
    CHECK_NOTHROW(require_passage(Constriction<double>(0.55, 1.5, 2.0), 4 * kPi + 2, volume));
}

TEST_CASE("Bad walls are refused with the reason") {
    check_refused([] { StraightTube<double>(0.0); }, "tube radius = 0");
    check_refused([] { Constriction<double>(-0.5, 1.0, 1.0); }, "throat radius = -0.5");
    check_refused([] { Constriction<double>(0.5, 0.4, 1.0); }, "radius of the wide ends");
    check_refused([] { Pore<double>(0.5, 1.0, -1.0, 1.0); }, "length of the throat");
    check_refused([] { Pore<double>(0.5, 1.0, 1.0, 0.0); }, "length of the transition");
    check_refused([] { PointsProfile<double>({0.0, 1.0, 2.0}, {1.0, 1.0, 1.0}); }, "number of profile points");
    check_refused([] { PointsProfile<double>({0.0, 1.0, 1.0, 2.0}, {1.0, 1.0, 1.0, 1.0}); }, "increasing");
    check_refused([] { PointsProfile<double>({0.0, 1.0, 1.5, 2.0}, {1.0, 1.0, -1.0, 1.0}); }, "r of profile point 2");
    const auto one = [](double) { return 1.0; };
    const auto zero = [](double) { return 0.0; };
    check_refused([&] { CallableProfile(1.0, 0.0, one, zero); }, "end of the profile");
    check_refused([&] { CallableProfile(0.0, 1.0, zero, zero); }, "profile radius at z = 0");
    check_refused([&] { CallableProfile(0.0, 1.0, one, one); }, "profile slope at z");
    WallMeshParams<double> params;
    const auto with = [&](const auto& change) {
        WallMeshParams<double> changed = params;
        change(changed);
        return [changed] { WallMesh<StraightTube<double>>(StraightTube<double>(1.0), changed); };
    };
    check_refused(with([](auto& p) { p.tolerance = 0.0; }), "wall tolerance");
    check_refused(with([](auto& p) { p.length = -1.0; }), "wall length");
    check_refused(with([](auto& p) { p.panels = 1; }), "number of wall panels");
    check_refused(with([](auto& p) { p.nodes_per_panel = 1; }), "nodes per panel");
    check_refused(with([](auto& p) { p.grading = WallGrading::uniform; }), "number of wall panels");
    check_refused(with([](auto& p) { p.flow_rate = std::nan(""); }), "flow rate");
}

namespace {

template <class Wall>
using ThroughChannel = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Quiescent<double>,
                                 SemiImplicitEuler, DenseLU<double>, Wall>;

template <class Profile>
ThroughChannel<WallMesh<Profile>> vesicle_in(const Profile& profile, double start, SimulationParams<double> params) {
    const auto shape = shifted(spheroid_of_excess_area<double>(2.0, SpheroidKind::prolate, 40), start);
    return ThroughChannel<WallMesh<Profile>>(shape, {}, params, {}, LinearElements<double>{}, {}, {}, {},
                                             wall(profile, 10.0, 1e-3));
}

}  // namespace

TEST_CASE("A particle that crosses the wall is refused") {
    check_refused([] { vesicle_in(Constriction<double>(0.6, 1.0, 2.0), 0.0, {}); }, "must fit between the walls");
    auto tube = wall(StraightTube<double>(0.9), 0.0, 1e-3);
    CHECK_THROWS_AS(motion(tube, sphere<double>(20), 1.0), SimulationFailure);
}

TEST_CASE("A vesicle passes a throat narrower than its rest radius and keeps its area and volume") {
    SimulationParams<double> params;
    params.tolerance = 1e-12;
    auto simulator = vesicle_in(Constriction<double>(0.8, 1.4, 2.5), -4.5, params);
    double largest_drop = 0;
    while (simulator.history().empty() || simulator.history().back().position < 3.5) {
        const auto& record = simulator.step();
        REQUIRE(record.step < 500);
        largest_drop = std::max(largest_drop, record.pressure_drop);
    }
    const auto& last = simulator.history().back();
    CHECK(std::abs(last.area_drift) < 1e-3);
    CHECK(std::abs(last.volume_drift) < 1e-3);
    CHECK(largest_drop > 10 * std::abs(last.pressure_drop));
}
