// SPDX-License-Identifier: MIT
// A vesicle in a capillary, assembled from policies.
#include <axistokes/axistokes.hpp>

#include <iostream>

int main() {
    using namespace axistokes;
    using InCapillary = Simulator<TubeKernel<double>,      // Green function
                                  LinearElements<double>,  // discretisation of the meridian
                                  Vesicle<double>,         // membrane
                                  Poiseuille<double>,      // what drives it
                                  SemiImplicitEuler,       // time integrator
                                  DenseLU<double>>;        // linear solver

    const double tube_radius = 0.9;  // in R0, the radius of the sphere of equal volume
    const auto shape = shape_in_tube<double>(1.59, tube_radius, SpheroidKind::prolate, 64);  // excess area, elements
    InCapillary simulator(shape, Poiseuille<double>(100, tube_radius), {}, TubeKernel<double>(tube_radius));

    const bool stationary = simulator.run();

    const auto& last = simulator.history().back();
    std::cout << (stationary ? "stationary" : "still changing") << " after " << last.step << " steps, velocity "
              << last.velocity << ", film " << last.film_thickness_min << '\n';
    write_vtk_surface("vesicle.vtp", shape_columns(simulator.configuration(), simulator.instant()));
}
