// SPDX-License-Identifier: MIT
#include "../support/simulation.hpp"

namespace examples {

Simulation free_simulation(const AnyDiscretization& discretization, const Law& law, const Drive& drive,
                           const axistokes::Meridian<double>& shape, const axistokes::SimulationParams<double>& params,
                           axistokes::ExtrapolatedEulerOfOrder steps) {
    return Simulation(Scene(OptionalTubeKernel(OptionalTubeImages()), discretization, law, drive, Solver(), AnyWall()),
                      steps, shape, params);
}

OptionalTubeKernel kernel_for(const Surroundings& surroundings, std::optional<double> tolerance) {
    const auto with = [&](auto params) {
        params.tolerance = tolerance.value_or(params.tolerance);
        return params;
    };
    using Images = OptionalTubeImages;
    if (!surroundings.tube_radius || surroundings.wall) {
        return OptionalTubeKernel(Images());
    }
    const double radius = *surroundings.tube_radius;
    return OptionalTubeKernel(surroundings.slow_quadrature
                                  ? Images(Images::FilonTube(radius, with(Images::FilonTube::Params())))
                                  : Images(Images::Tube(radius, with(Images::Tube::Params()))));
}

OptionalTubeKernel kernel_for(const Surroundings& surroundings, const MethodOptions& method) {
    const auto accuracy = method.accuracy();
    return kernel_for(surroundings, accuracy ? std::optional(accuracy->kernel) : std::nullopt);
}

AnyWall wall_for(const Surroundings& surroundings) {
    if (!surroundings.wall) {
        return AnyWall();
    }
    const Channel tube(axistokes::StraightTube<double>(*surroundings.tube_radius));
    return AnyWall(AnyWall::Mesh(tube, *surroundings.wall));
}

}  // namespace examples

template class axistokes::detail::MotionEquation<double, examples::AnySurface, examples::Law>;
template class axistokes::Scene<examples::OptionalTubeKernel, examples::AnyDiscretization, examples::Law,
                                examples::Drive, examples::Solver, examples::AnyWall>;
template class axistokes::Simulator<examples::OptionalTubeKernel, examples::AnyDiscretization, examples::Law,
                                    examples::Drive, axistokes::ExtrapolatedEulerOfOrder, examples::Solver,
                                    examples::AnyWall>;
