// SPDX-License-Identifier: MIT
// The one simulation that all programs run: every policy is chosen at run time. It is compiled in simulations/, in
// pieces.
#pragma once

#include "any_wall.hpp"
#include "method.hpp"
#include "surroundings.hpp"
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <complex>
#include <memory>
#include <vector>

namespace examples {

using Vesicle = axistokes::Vesicle<double>;
using RigidBody = axistokes::RigidBody<double>;
using Law = axistokes::OneOf<Vesicle, RigidBody>;
using Solver = axistokes::DenseLU<double>;
using Scene = axistokes::Scene<OptionalTubeKernel, AnyDiscretization, Law, Drive, Solver, AnyWall>;
using Simulation = axistokes::Simulator<OptionalTubeKernel, AnyDiscretization, Law, Drive,
                                        axistokes::ExtrapolatedEulerOfOrder, Solver, AnyWall>;

/// With integrals as accurate as a preset takes; without one the discretisation's own default.
inline AnyDiscretization discretization_for(const MethodOptions& method) {
    const auto accuracy = method.accuracy();
    return AnyDiscretization::of(method.kind(), accuracy ? std::optional(accuracy->quadrature) : std::nullopt);
}

/// One body in free space.
Simulation free_simulation(const AnyDiscretization& discretization, const Law& law, const Drive& drive,
                           const axistokes::Meridian<double>& shape, const axistokes::SimulationParams<double>& params,
                           axistokes::ExtrapolatedEulerOfOrder steps = axistokes::ExtrapolatedEulerOfOrder(1));

/// Of a tube without a mesh, with that tolerance or the kernel's own.
OptionalTubeKernel kernel_for(const Surroundings& surroundings, std::optional<double> tolerance);
/// Likewise, with what a preset takes.
OptionalTubeKernel kernel_for(const Surroundings& surroundings, const MethodOptions& method);

AnyWall wall_for(const Surroundings& surroundings);

/// A StationarySolver.
class Newton {
  public:
    using Solver = axistokes::StationarySolver<Scene>;
    using State = Solver::State;
    using Params = Solver::Params;

    explicit Newton(const Scene& scene, const Params& params = {});
    Newton(Newton&&) noexcept;
    Newton(const Newton&) = delete;
    Newton& operator=(const Newton&) = delete;
    ~Newton();

    State solve(const axistokes::Meridian<double>& shape, double area, double volume);
    State solve(const Scene::State& bodies, const std::vector<axistokes::Measures<double>>& measures);
    std::vector<std::complex<double>> growth_rates(const State& state);
    /// By differences of the full equations.
    std::vector<std::complex<double>> growth_rates(const State& state, double step);

  private:
    std::unique_ptr<Solver> solver_;
};

}  // namespace examples

extern template class axistokes::detail::MotionEquation<double, examples::AnySurface, examples::Law>;
extern template class axistokes::Scene<examples::OptionalTubeKernel, examples::AnyDiscretization, examples::Law,
                                       examples::Drive, examples::Solver, examples::AnyWall>;
extern template class axistokes::Simulator<examples::OptionalTubeKernel, examples::AnyDiscretization, examples::Law,
                                           examples::Drive, axistokes::ExtrapolatedEulerOfOrder, examples::Solver,
                                           examples::AnyWall>;
