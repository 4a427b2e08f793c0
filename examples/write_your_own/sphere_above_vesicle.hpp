// SPDX-License-Identifier: MIT
// A scene of your own with bodies of two kinds: a rigid sphere sinks after a vesicle.
#pragma once

#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <utility>
#include <vector>

namespace write_your_own {

/// Both with the given Bond number, `distance` apart (centre to centre, in R0); the vesicle is body 0, below.
inline auto sphere_above_vesicle(double bond, double distance, axistokes::Index modes,
                                 axistokes::SimulationParams<double> params = {}) {
    using namespace axistokes;
    using Law = OneOf<Vesicle<>, RigidBody<>>;
    Scene scene(FreeSpaceKernel<>(), SpectralMeridian<>(), std::vector<Law>{Vesicle<>(), RigidBody<>()},
                Gravity<>(bond), DenseLU<>());
    Meridian<double> above = sphere<double>(modes);
    above.z.array() += distance;
    const std::vector<Meridian<double>> shapes{spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, modes),
                                               above};
    return Simulator(std::move(scene), ExtrapolatedEulerOfOrder(2), shapes, params);
}

}  // namespace write_your_own
