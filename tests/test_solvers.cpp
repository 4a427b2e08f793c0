// SPDX-License-Identifier: MIT
// Linear solvers: accuracy on random systems, singular matrices, and the factors GMRES keeps.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/concepts.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/solver/gmres.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace {

using axistokes::DenseLU;
using axistokes::DenseQR;
using axistokes::Gmres;
using axistokes::Index;
using axistokes::Matrix;
using axistokes::Vector;

static_assert(axistokes::LinearSolver<DenseLU<double>>);
static_assert(axistokes::LinearSolver<DenseQR<long double>>);
static_assert(axistokes::LinearSolver<Gmres<float>>);

template <class S>
Matrix<S> random_matrix(Index n, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Matrix<S> a(n, n);
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < n; ++j) {
            a(i, j) = static_cast<S>(normal(random));
        }
    }
    return a;
}

template <class S>
Vector<S> ramp(Index n) {
    return Vector<S>::LinSpaced(n, S(-1), S(2));
}

template <class Solver>
void check_solves(double bound) {
    using S = typename Solver::Scalar;
    Solver solver;
    for (const Index n : {1, 2, 30, 90}) {
        INFO(n << " unknowns");
        const Matrix<S> a = random_matrix<S>(n, static_cast<unsigned>(n)) + Matrix<S>::Identity(n, n) * S(2);
        const Vector<S> b = ramp<S>(n);
        solver.factorize(a);
        const Vector<S> x = solver.solve(b);
        const S residual = (a * x - b).norm() / (a.norm() * x.norm() + b.norm());
        CHECK(static_cast<double>(residual) < bound * static_cast<double>(std::numeric_limits<S>::epsilon()));
        // A second right-hand side with the same factors.
        const Vector<S> y = solver.solve(Vector<S>::Zero(n));
        CHECK(y.norm() == S(0));
    }
}

/// Rank n - 1, exactly (a zero column) or up to round-off.
template <class Solver>
void check_refuses_singular() {
    Solver solver;
    Matrix<double> exact = random_matrix<double>(12, 5);
    exact.col(7).setZero();
    Matrix<double> rounded = random_matrix<double>(12, 6);
    rounded.row(3) = 0.3 * rounded.row(1) - 0.7 * rounded.row(8);
    Matrix<double> undefined = random_matrix<double>(12, 7);
    undefined(4, 4) = std::numeric_limits<double>::quiet_NaN();
    for (const Matrix<double>& a : {exact, rounded, undefined, Matrix<double>(Matrix<double>::Zero(12, 12))}) {
        const auto attempt = [&] {
            solver.factorize(a);
            return solver.solve(ramp<double>(12));
        };
        CHECK(axistokes::test::failure(attempt).find("singular") != std::string::npos);
    }
    // It recovers.
    const Matrix<double> regular = random_matrix<double>(12, 8);
    solver.factorize(regular);
    CHECK((regular * solver.solve(ramp<double>(12)) - ramp<double>(12)).norm() < 1e-11);
}

}  // namespace

TEST_CASE("dense LU solves", "[solver]") {
    check_solves<DenseLU<float>>(20);
    check_solves<DenseLU<double>>(20);
    check_solves<DenseLU<long double>>(20);
}

TEST_CASE("dense QR solves", "[solver]") {
    check_solves<DenseQR<float>>(20);
    check_solves<DenseQR<double>>(20);
}

TEST_CASE("GMRES solves", "[solver]") {
    // Converged to 100 eps in the preconditioned residual.
    check_solves<Gmres<float>>(200);
    check_solves<Gmres<double>>(200);
}

TEST_CASE("singular matrices are a SimulationFailure", "[solver]") {
    SECTION("LU") {
        check_refuses_singular<DenseLU<double>>();
    }
    SECTION("QR") {
        check_refuses_singular<DenseQR<double>>();
    }
    SECTION("GMRES") {
        check_refuses_singular<Gmres<double>>();
    }
}

TEST_CASE("badly scaled but regular matrices are solved", "[solver]") {
    Matrix<double> a = random_matrix<double>(20, 9);
    a.topRows(10) *= 1e6;
    const Vector<double> x = ramp<double>(20);
    DenseLU<double> lu;
    lu.factorize(a);
    CHECK((lu.solve(a * x) - x).norm() < 1e-8);
    DenseQR<double> qr;
    qr.factorize(a);
    CHECK((qr.solve(a * x) - x).norm() < 1e-8);
}

TEST_CASE("GMRES keeps its factors as long as they serve", "[solver]") {
    const Index n = 60;
    const Matrix<double> a = random_matrix<double>(n, 1) + Matrix<double>::Identity(n, n) * 3;
    const Vector<double> b = ramp<double>(n);
    Gmres<double> gmres;
    gmres.factorize(a);
    gmres.solve(b);
    CHECK(gmres.factorizations() == 1);
    CHECK(gmres.iterations() <= 2);
    // A matrix close by: a few iterations, the old factors.
    const Matrix<double> near = a + 1e-3 * random_matrix<double>(n, 2);
    gmres.factorize(near);
    CHECK((near * gmres.solve(b) - b).norm() < 1e-10);
    CHECK(gmres.factorizations() == 1);
    CHECK(gmres.iterations() > 2);
    // One far away: new factors.
    const Matrix<double> far = random_matrix<double>(n, 3) + Matrix<double>::Identity(n, n) * 3;
    gmres.factorize(far);
    CHECK((far * gmres.solve(b) - b).norm() < 1e-10);
    CHECK(gmres.factorizations() == 2);
    // Another size: new factors at once.
    gmres.factorize(random_matrix<double>(n / 2, 4));
    CHECK(gmres.factorizations() == 3);
}

TEST_CASE("GMRES parameters out of range are refused", "[solver]") {
    using axistokes::test::mentions;
    using axistokes::test::refusal;
    using Params = Gmres<double>::Params;
    CHECK(mentions(refusal([] { Gmres<double>(Params{0.0, 20}); }), "GMRES tolerance", "0", "in (0, 1)"));
    CHECK(mentions(refusal([] { Gmres<double>(Params{1e-10, 0}); }), "GMRES patience", "0", "at least 1"));
}

TEST_CASE("GMRES: old factors that hide a residual are renewed") {
    Gmres<double> gmres;
    axistokes::Matrix<double> a = axistokes::Matrix<double>::Identity(2, 2);
    a(1, 1) = 1e14;
    gmres.factorize(a);
    gmres.factorize(axistokes::Matrix<double>::Identity(2, 2));
    const axistokes::Vector<double> x = gmres.solve(axistokes::Vector<double>::Ones(2));
    CHECK(x[0] == Approx(1));
    CHECK(x[1] == Approx(1));
}
