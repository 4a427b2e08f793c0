// SPDX-License-Identifier: MIT
// A settling vesicle, assembled from policies.
#include <axistokes/axistokes.hpp>

#include <iostream>

int main() {
    using namespace axistokes;
    using Settling = Simulator<FreeSpaceKernel<double>,  // Green function
                               LinearElements<double>,   // discretisation of the meridian
                               Vesicle<double>,          // membrane
                               Gravity<double>,          // what drives it
                               SemiImplicitEuler,        // time integrator
                               DenseLU<double>>;         // linear solver

    const auto shape = spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, 64);
    Settling simulator(shape, Gravity<double>(47));  // Bond number

    const bool stationary = simulator.run();

    const auto& last = simulator.history().back();
    std::cout << (stationary ? "stationary" : "still changing") << " after " << last.step << " steps, velocity "
              << last.velocity << ", length " << last.length << '\n';
    write_vtk_surface("vesicle.vtp", shape_columns(simulator.configuration(), simulator.instant()));
}
