// SPDX-License-Identifier: MIT
// Policies can be exchanged: solvers and scalars agree, a user's own kernel and background fit, and what a background
// does not have is never evaluated.
#include "catch.hpp"
#include "support.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/solver/gmres.hpp>

#include <cmath>
#include <memory>

namespace {

using axistokes::Configuration;
using axistokes::DenseLU;
using axistokes::DenseQR;
using axistokes::FreeSpaceKernel;
using axistokes::Gmres;
using axistokes::Gravity;
using axistokes::Index;
using axistokes::KernelArrays;
using axistokes::LinearElements;
using axistokes::Meridian;
using axistokes::Point;
using axistokes::RigidBody;
using axistokes::Scene;
using axistokes::Vesicle;
using axistokes::test::Spheroid;

/// Free space in a fluid of twice the viscosity.
class ViscousKernel {
  public:
    using Scalar = double;
    static constexpr bool has_images = false;
    static constexpr bool laboratory_frame = false;

    void singular(Point<double> target, const double* r, const double* z, Index n, KernelArrays<double> out) const {
        inner_.singular(target, r, z, n, out);
        halve(n, out);
    }
    void singular_split(Point<double> target, const double* r, const double* z, Index n, KernelArrays<double> smooth,
                        KernelArrays<double> logarithm) const {
        inner_.singular_split(target, r, z, n, smooth, logarithm);
        halve(n, smooth);
        halve(n, logarithm);
    }

  private:
    static void halve(Index n, KernelArrays<double> out) {
        for (double* entry : {out.rr, out.rz, out.zr, out.zz}) {
            for (Index i = 0; i < n; ++i) {
                entry[i] /= 2;
            }
        }
    }
    FreeSpaceKernel<double> inner_;
};

/// Counts how often it is asked for what it claims to have or not to have.
template <bool flow, bool load>
struct CountingBackground {
    using Scalar = double;
    static constexpr bool has_flow = flow;
    static constexpr bool has_load = load;

    Point<double> velocity(const Point<double>&) const {
        ++*flows;
        return {0, 1};
    }
    double normal_load(const Point<double>& x) const {
        ++*loads;
        return -x.z;
    }
    double velocity_scale() const { return 1; }

    std::shared_ptr<int> flows = std::make_shared<int>(0);
    std::shared_ptr<int> loads = std::make_shared<int>(0);
};

template <class S>
Meridian<S> shape() {
    const auto m = Spheroid{0.85, 1.3}.meridian(40, 0.2);
    return {m.r.cast<S>(), m.z.cast<S>()};
}

template <class S, class Kernel, class Membrane, class Solver>
auto evaluate(Kernel kernel, Membrane membrane, Solver solver, double implicit_time = 0) {
    Scene scene(kernel, LinearElements<S>{}, membrane, Gravity<S>(S(3)), solver);
    return scene.evaluate(Configuration<S>{shape<S>(), S(0), {}}, static_cast<S>(implicit_time));
}

template <class Solver>
void check_solver() {
    const FreeSpaceKernel<double> kernel;
    const double rigid = evaluate<double>(kernel, RigidBody<double>{}, DenseLU<double>{}).velocity;
    CHECK(evaluate<double>(kernel, RigidBody<double>{}, Solver{}).velocity == Approx(rigid).epsilon(1e-10));
    for (const double time : {0.0, 0.1}) {
        const auto vesicle = evaluate<double>(kernel, Vesicle<double>{}, DenseLU<double>{}, time);
        const auto other = evaluate<double>(kernel, Vesicle<double>{}, Solver{}, time);
        CHECK((vesicle.solution.velocity - other.solution.velocity).cwiseAbs().maxCoeff() < 1e-8);
        CHECK((vesicle.solution.tension - other.solution.tension).cwiseAbs().maxCoeff() < 1e-6);
    }
}

template <class Background>
void count(Background background) {
    Scene scene(FreeSpaceKernel<double>{}, LinearElements<double>{}, RigidBody<double>{}, background,
                DenseLU<double>{});
    scene.evaluate(Configuration<double>{shape<double>(), 0.0, {}}, 0.0);
    scene.centreline_velocity(0.0);
}

}  // namespace

TEST_CASE("all solvers give the same velocities and tensions", "[policies]") {
    SECTION("QR") {
        check_solver<DenseQR<double>>();
    }
    SECTION("GMRES") {
        check_solver<Gmres<double>>();
    }
}

TEST_CASE("a user's kernel: twice the viscosity, half the velocity", "[policies]") {
    const double thin = evaluate<double>(FreeSpaceKernel<double>{}, RigidBody<double>{}, DenseLU<double>{}).velocity;
    const double thick = evaluate<double>(ViscousKernel{}, RigidBody<double>{}, DenseLU<double>{}).velocity;
    CHECK(thick == Approx(thin / 2).epsilon(1e-12));
}

TEST_CASE("what a background does not have is never evaluated", "[policies]") {
    CountingBackground<false, false> nothing;
    count(nothing);
    CHECK(*nothing.flows == 0);
    CHECK(*nothing.loads == 0);
    CountingBackground<false, true> load;
    count(load);
    CHECK(*load.flows == 0);
    CHECK(*load.loads > 0);
    CountingBackground<true, false> flow;
    count(flow);
    CHECK(*flow.flows > 0);
    CHECK(*flow.loads == 0);
}

TEST_CASE("scenes in float and long double", "[policies]") {
    const double usual = evaluate<double>(FreeSpaceKernel<double>{}, RigidBody<double>{}, DenseLU<double>{}).velocity;
    const float single = evaluate<float>(FreeSpaceKernel<float>{}, RigidBody<float>{}, DenseLU<float>{}).velocity;
    const long double precise =
        evaluate<long double>(FreeSpaceKernel<long double>{}, RigidBody<long double>{}, DenseLU<long double>{})
            .velocity;
    CHECK(static_cast<double>(precise) == Approx(usual).epsilon(1e-5));
    CHECK(static_cast<double>(single) == Approx(usual).epsilon(1e-4));
}
