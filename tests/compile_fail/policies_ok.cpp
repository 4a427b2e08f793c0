// SPDX-License-Identifier: MIT
// The counterpart of the wrong policies that must compile: the same types, complete.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/euler.hpp>

using namespace axistokes;

struct Kernel {
    using Scalar = double;
    static constexpr bool has_regular_part = false;
    void singular(Point<double>, const double*, const double*, Index, KernelArrays<double>) const {}
    void singular_split(Point<double>, const double*, const double*, Index, KernelArrays<double>,
                        KernelArrays<double>) const {}
};

struct Membrane {
    using Scalar = double;
    static constexpr bool deformable = false;
    template <class Surface, class Solver>
    MobilitySolution<double> solve(const MobilityProblem<double, Surface>&, Solver&) const {
        return {};
    }
};

struct Flow {
    using Scalar = double;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = false;
    Point<double> velocity(const Point<double>&) const { return {}; }
    double normal_load(const Point<double>&) const { return 0; }
    double velocity_scale() const { return 1; }
};

struct Solver {
    using Scalar = double;
    void factorize(const Matrix<double>&) {}
    Vector<double> solve(const Vector<double>& b) { return b; }
};

struct Wall {
    static constexpr bool present = true;
    template <class Discretization, class SomeKernel>
    void confine(const Discretization&, const SomeKernel&, const Meridian<double>&, Matrix<double>&, Vector<double>&) {}
    double radius(double) const { return 2; }
    template <class Surface>
    double pressure_drop(const Surface&, const Vector<double>&) const {
        return 0;
    }
    double velocity_scale() const { return 0; }
    double centreline_velocity(double) const { return 0; }
};

struct Integrator {
    static constexpr int order = 1;
    template <class S, class SceneType>
    auto step(SceneType& scene, const Configuration<S>& start, const S& dt) const {
        return detail::euler_step(scene, start, dt, S(0));
    }
};

using Right = Simulator<Kernel, LinearElements<>, Membrane, Flow, Integrator, Solver, Wall>;

double run(Right& simulator) {
    return simulator.step().velocity;
}
