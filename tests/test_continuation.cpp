// SPDX-License-Identifier: MIT
// Branches of an algebraic problem with known folds and a known change of stability.
#include "catch.hpp"
#include <axistokes/stationary/continuation.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace {

using namespace axistokes;

/// dx/dt = F(x, p), dy/dt = x - y, from derivatives of F given in closed form.
struct Planar {
    using Scalar = double;
    struct Point {
        double x, y, p;
    };

    double (*f)(double x, double p);
    double (*dfdx)(double x, double p);
    double (*dfdp)(double x, double p);

    static double parameter(const Point& point) { return point.p; }
    double residual(const Point& point) const { return defect(point).cwiseAbs().maxCoeff(); }
    Vector<double> defect(const Point& point) const { return Eigen::Vector2d(f(point.x, point.p), point.x - point.y); }
    Matrix<double> derivative(const Point& point) const {
        Matrix<double> d(2, 3);
        d << dfdx(point.x, point.p), 0, dfdp(point.x, point.p), 1, -1, 0;
        return d;
    }
    static std::optional<Point> moved(const Point& point, const Vector<double>& dx, double dp) {
        return Point{point.x + dx[0], point.y + dx[1], point.p + dp};
    }
    double growth(const Point& point, const Matrix<double>&) const { return std::max(dfdx(point.x, point.p), -1.0); }
};

/// Branch x^2 + p^2 = 1: folds at p = 1 and p = -1, stable for x < 0.
const Planar circle{[](double x, double p) { return x * x + p * p - 1; }, [](double x, double) { return 2 * x; },
                    [](double, double p) { return 2 * p; }};

using Path = Continuation<Planar>;

TEST_CASE("Arclength continuation passes the folds of a circle and finds them") {
    ContinuationParams<double> params;
    params.tolerance = 1e-12;
    params.most_points = 200;
    Path path(circle, params);
    std::vector<Planar::Point> folds;
    std::vector<double> growth;
    double farthest = 0;
    int changes = 0;
    const Planar::Point start{-0.8, -0.8, 0.6};
    double turned = 0;
    Planar::Point last = start;
    path.follow(start, 1, [&](const Path::Record& record) {
        const Planar::Point& at = record.point;
        farthest = std::max(farthest, std::abs(at.x * at.x + at.p * at.p - 1));
        turned += std::asin(last.x * at.p - last.p * at.x);
        last = at;
        if (record.event == BranchEvent::fold) {
            folds.push_back(at);
            growth.push_back(record.growth);
            CHECK(std::abs(record.slope) < 1e-4);
        } else {
            CHECK((record.growth < 0) == (at.x < 0));
        }
        changes += record.event == BranchEvent::stability_change ? 1 : 0;
        return std::abs(turned) < 6.5;
    });
    CHECK(std::abs(turned) >= 6.5);
    CHECK(farthest < 1e-11);
    REQUIRE(folds.size() == 2);
    CHECK(folds[0].p == Approx(1).epsilon(1e-8));
    CHECK(folds[1].p == Approx(-1).epsilon(1e-8));
    CHECK(std::abs(growth[0]) < 1e-3);
    CHECK(changes == 0);
}

TEST_CASE("Natural continuation stops short of a fold with the cause") {
    ContinuationParams<double> params;
    params.method = ContinuationMethod::natural;
    Path path(circle, params);
    double last = 0;
    CHECK_THROWS_WITH(path.follow(Planar::Point{-0.8, -0.8, 0.6}, 1,
                                  [&](const Path::Record& record) {
                                      last = record.parameter;
                                      return true;
                                  }),
                      Catch::Matchers::Contains("no solution beyond parameter"));
    CHECK(last > 0.99);
    CHECK(last <= 1 + params.tolerance);
}

TEST_CASE("A change of stability without a fold is found, and the bound is met exactly") {
    // x (p - 0.3 - x) = 0: the branch x = 0 loses its stability at p = 0.3.
    const Planar transcritical{[](double x, double p) { return x * (p - 0.3 - x); },
                               [](double x, double p) { return p - 0.3 - 2 * x; }, [](double x, double) { return x; }};
    ContinuationParams<double> params;
    params.largest_parameter = 0.77;
    Path path(transcritical, params);
    std::vector<double> changes;
    double last = 0;
    CHECK(path.follow(Planar::Point{0, 0, 0}, 1, [&](const Path::Record& record) {
        if (record.event == BranchEvent::stability_change) {
            changes.push_back(record.parameter);
        }
        CHECK(record.event != BranchEvent::fold);
        last = record.parameter;
        return true;
    }));
    REQUIRE(changes.size() == 1);
    CHECK(changes[0] == Approx(0.3).margin(1e-5));
    CHECK(last == Approx(0.77).epsilon(1e-12));
}

TEST_CASE("Continuation rejects bad parameters and a start without a solution") {
    ContinuationParams<double> params;
    params.first_step = 1e-9;
    CHECK_THROWS_AS(Path(circle, params), InvalidArgument);
    CHECK_THROWS_AS(Path(circle).follow(Planar::Point{0, 0, 3}, 1, [](const Path::Record&) { return true; }),
                    SimulationFailure);
}

}  // namespace
