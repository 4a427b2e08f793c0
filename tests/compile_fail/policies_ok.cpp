// SPDX-License-Identifier: MIT
// The counterpart of the wrong policies that must compile: the same types, complete.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/law.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/euler.hpp>

using namespace axistokes;

struct Kernel {
    using Scalar = double;
    static constexpr bool has_images = false;
    static constexpr bool laboratory_frame = false;
    void singular(Point<double>, const double*, const double*, Index, KernelArrays<double>) const {}
    void singular_split(Point<double>, const double*, const double*, Index, KernelArrays<double>,
                        KernelArrays<double>) const {}
};

struct Law {
    using Scalar = double;
    static constexpr Constraint constraint = Constraint::none;
    static constexpr bool conserves_area = false;
    template <class Surface>
    Vector<double> force(const Surface& surface) const {
        return surface.normals();
    }
    template <class Surface>
    typename Surface::Operator linearisation(const Surface& surface, const Vector<double>&) const {
        return surface.along_normal(surface.mean_curvature_of);
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
    Vector<double> confine(const Discretization&, const SomeKernel&, const std::vector<Meridian<double>>&,
                           Matrix<double>&, Vector<double>&) {
        return {};
    }
    double gap(const Point<double>& x) const { return 2 - x.r; }
    double velocity_scale() const { return 0; }
    double centreline_velocity(double) const { return 0; }
};

struct Integrator {
    static constexpr int order = 1;
    template <class SceneType, class S>
    Step<S> step(SceneType&, const typename SceneType::Moment& start, const S&) const {
        return {start.bodies};
    }
};

struct Control {
    explicit Control(const StepControlParams<double>&) {}
    double step() const { return 1; }
    bool fixed() const { return true; }
    void judge(const StepReport<double>&) const {}
    bool shorten(double) { return false; }
    void accept(const StepReport<double>&, double, bool) {}
};

using Right = Simulator<Kernel, LinearElements<>, Law, Flow, Integrator, Solver, Wall, Control>;

double run(Right& simulator) {
    return simulator.step().velocity;
}
