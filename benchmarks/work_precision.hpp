// SPDX-License-Identifier: MIT
// The scenes of the work_precision benchmark, for any discretisation.
#pragma once

#include <axistokes/axistokes.hpp>

namespace work_precision {

using axistokes::Index;

enum class Stepping { euler, order2, order3, adaptive, newton };
enum class Vesicle { settling, unbounded, tube };

/// What the errors are measured by, and the steps (or Newton's evaluations of the scene) that it took.
struct Outcome {
    double velocity = 0;  // drag factor for a sphere, position for a transient
    double length = 1;
    Index steps = 0;
};

/// How fine. The time step is fixed if `steps` is given, else automatic with `step_tolerance` where the integrator
/// estimates its error.
struct Setting {
    Index n = 0;
    Index steps = 0;
    double step_tolerance = 1e-4;
    double residual = 1e-6;
};

/// K of a sphere dragged along the axis of a tube.
template <class Discretization>
Outcome drag(double confinement, Index n);

/// Stationary velocity and length: D = 0.6, B0 = 47 (Fig. 5); D = 0.6, Ca_unb = 0.5 (Fig. 7); D = 1.59, Rc = 0.9,
/// Ca = 100 (Fig. 14). All from the prolate spheroid.
template <class Discretization>
Outcome stationary(Vesicle scene, Stepping stepping, const Setting& setting);

/// Position and length at time 0.1 of the settling vesicle.
template <class Discretization>
Outcome transient(Stepping stepping, const Setting& setting);

namespace detail {

using namespace axistokes;

/// Errors that do not limit the discretisation.
template <class Discretization>
constexpr double kernel_tolerance = std::is_same_v<Discretization, SpectralMeridian<double>> ? 1e-12 : 1e-8;

inline TubeKernel<double> tube(double radius, double tolerance) {
    TubeKernel<double>::Params params;
    params.tolerance = tolerance;
    return TubeKernel<double>(radius, params);
}

/// Of a time step; Newton's method is none.
inline ExtrapolatedEulerOfOrder integrator(Stepping stepping, double tolerance) {
    if (stepping == Stepping::adaptive) {
        return ExtrapolatedEulerOfOrder::for_tolerance(tolerance);
    }
    return ExtrapolatedEulerOfOrder(stepping == Stepping::order3 ? 3 : stepping == Stepping::order2 ? 2 : 1);
}

template <class Discretization, class Kernel, class Flow>
using March =
    Simulator<Kernel, Discretization, axistokes::Vesicle<double>, Flow, ExtrapolatedEulerOfOrder, DenseLU<double>>;

/// Marches to a residual of 1e-2, then Newton.
template <class Discretization, class Kernel, class Flow>
Outcome newton(const Kernel& kernel, const Flow& flow, const Meridian<double>& start, double residual) {
    SimulationParams<double> params;
    params.tolerance = 1e-2;
    March<Discretization, Kernel, Flow> simulator(start, flow, params, kernel);
    simulator.run();
    StationaryParams<double> newton_params;
    newton_params.tolerance = residual;
    StationarySolver solver(simulator.scene(), newton_params);
    const auto state =
        solver.solve(simulator.configuration().shape, simulator.initial_area(), simulator.initial_volume());
    const auto& z = state.configuration.shape.z;
    return {state.instant.velocity, z[z.size() - 1] - z[0],
            static_cast<Index>(simulator.history().size()) + state.evaluations};
}

template <class Discretization, class Kernel, class Flow>
Outcome stationary_of(const Kernel& kernel, const Flow& flow, const Meridian<double>& start, Stepping stepping,
                      const Setting& setting) {
    if (stepping == Stepping::newton) {
        return newton<Discretization>(kernel, flow, start, setting.residual);
    }
    SimulationParams<double> params;
    params.tolerance = setting.residual;
    params.step_tolerance = setting.step_tolerance;
    March<Discretization, Kernel, Flow> simulator(start, flow, params, kernel, Discretization(), {},
                                                  integrator(stepping, setting.step_tolerance));
    simulator.run();
    const auto& last = simulator.history().back();
    return {last.velocity, last.length, last.step};
}

}  // namespace detail

template <class Discretization>
Outcome drag(double confinement, Index n) {
    using namespace axistokes;
    using Kernel = TubeKernel<double>;
    Simulator<Kernel, Discretization, RigidBody<double>, Gravity<double>, ExplicitEuler, DenseLU<double>> simulator(
        sphere<double>(n), Gravity<double>(1.0), {},
        detail::tube(1 / confinement, detail::kernel_tolerance<Discretization>));
    return {-2.0 / 9 / simulator.step().velocity, 1, 1};
}

template <class Discretization>
Outcome stationary(Vesicle scene, Stepping stepping, const Setting& setting) {
    using namespace axistokes;
    const double excess_area = scene == Vesicle::tube ? 1.59 : 0.6;
    const auto start = spheroid_of_excess_area<double>(excess_area, SpheroidKind::prolate, setting.n);
    switch (scene) {
        case Vesicle::settling:
            return detail::stationary_of<Discretization>(FreeSpaceKernel<double>(), Gravity<double>(47.0), start,
                                                         stepping, setting);
        case Vesicle::unbounded:
            return detail::stationary_of<Discretization>(FreeSpaceKernel<double>(), UnboundedPoiseuille<double>(0.5),
                                                         start, stepping, setting);
        case Vesicle::tube:
            break;
    }
    constexpr double kRadius = 0.9;
    return detail::stationary_of<Discretization>(
        detail::tube(kRadius, detail::kernel_tolerance<Discretization>), Poiseuille<double>(100.0, kRadius),
        shape_in_tube<double>(excess_area, kRadius, SpheroidKind::prolate, setting.n), stepping, setting);
}

template <class Discretization>
Outcome transient(Stepping stepping, const Setting& setting) {
    using namespace axistokes;
    constexpr double kTime = 0.1;
    SimulationParams<double> params;
    params.tolerance = 1e-15;
    params.longest_time = kTime;
    params.step_tolerance = setting.step_tolerance;
    if (setting.steps > 0) {
        params.time_step = kTime / static_cast<double>(setting.steps);
        params.most_steps = setting.steps;
        params.longest_time = 2 * kTime;
    }
    const auto start = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, setting.n);
    detail::March<Discretization, FreeSpaceKernel<double>, Gravity<double>> simulator(
        start, Gravity<double>(47.0), params, {}, Discretization(), {},
        detail::integrator(stepping, setting.step_tolerance));
    simulator.run();
    const auto& last = simulator.history().back();
    return {last.position, last.length, last.step};
}

}  // namespace work_precision
