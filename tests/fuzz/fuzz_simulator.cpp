// SPDX-License-Identifier: MIT
// Fuzz target: a few steps of a vesicle or two, in free space or in a tube, with any parameters.
#include "bytes.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/extrapolated_euler.hpp>

#include <vector>

namespace {

using namespace axistokes;
using fuzz::Bytes;
using fuzz::require_finite;

SimulationParams<double> some_params(Bytes& in) {
    SimulationParams<double> params;
    const auto change = [&](double& value) {
        if (in.choice(8) == 0) {
            value = in.number();
        }
    };
    for (double* value : {&params.first_time_step, &params.largest_time_step, &params.smallest_time_step.emplace(1e-9),
                          &params.step_tolerance, &params.largest_displacement, &params.largest_strain, &params.growth,
                          &params.tolerance, &params.longest_time}) {
        change(*value);
    }
    if (in.choice(4) == 0) {
        params.time_step = in.number();
    }
    if (in.choice(4) == 0) {
        params.landing_times = {in.number(), in.number()};
    }
    params.most_steps = in.choice(8) == 0 ? in.choice(2) : 3;
    return params;
}

template <class SimulatorType>
void follow(SimulatorType&& simulator) {
    try {
        simulator.run();
    } catch (const SimulationFailure&) {
        // The last good state stays.
    }
    for (std::size_t b = 0; b < simulator.bodies(); ++b) {
        for (const auto& record : simulator.history(b)) {
            require_finite("a velocity", record.velocity);
            require_finite("a length", record.length);
            require_finite("a time", record.time);
            require_finite("a residual", record.residual);
        }
        const auto& shape = simulator.state()[b].shape;
        require_finite("the shape", shape.r.sum() + shape.z.sum());
        validate(shape);
    }
}

void simulate(Bytes& in) {
    const Index elements = 8 + in.choice(9);
    const double excess_area = in.choice(4) == 0 ? in.number() : in.between(0, 3);
    const SpheroidKind kind = in.flag() ? SpheroidKind::prolate : SpheroidKind::oblate;
    const double drive = in.flag() ? in.number() : in.between(-1000, 1000);
    const auto params = some_params(in);
    const auto order = ExtrapolatedEulerOfOrder(in.choice(8) == 0 ? static_cast<int>(in.byte()) : 1 + in.choice(3));
    if (in.flag()) {
        const TubeKernel<double> tube(in.choice(4) == 0 ? in.number() : in.between(0.6, 3));
        const auto shape = shape_in_tube(excess_area, tube, kind, elements);
        return follow(Simulator(
            Scene(tube, LinearElements<double>(), Vesicle<double>(), Poiseuille(drive, tube), DenseLU<double>()), order,
            shape, params));
    }
    std::vector<Meridian<double>> shapes{spheroid_of_excess_area(excess_area, kind, elements)};
    if (in.choice(3) == 0) {
        shapes.push_back(shapes[0]);
        shapes[1].z.array() += in.flag() ? in.number() : in.between(0, 10);
    }
    follow(Simulator(Scene(FreeSpaceKernel<double>(), LinearElements<double>(), Vesicle<double>(),
                           Gravity<double>(drive), DenseLU<double>()),
                     order, shapes, params));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in(data, size);
    fuzz::attempt([&] { simulate(in); });
    return 0;
}
