// SPDX-License-Identifier: MIT
// A vesicle in a capillary, assembled from policies.
#include <axistokes/axistokes.hpp>

#include <iostream>

int main() {
    using namespace axistokes;
    const TubeKernel tube(0.9);  // Green function; the radius in R0, that of the sphere of equal volume
    const Scene scene(tube,
                      LinearElements(),         // discretisation of the meridian
                      Vesicle(),                // law of the interface
                      Poiseuille(100.0, tube),  // what drives it: bending capillary number
                      DenseLU());               // linear solver
    const auto shape = shape_in_tube(1.59, tube, SpheroidKind::prolate, 64);  // excess area, elements
    Simulator simulator(scene, SemiImplicitEuler(), shape);

    const bool stationary = simulator.run();

    const auto& last = simulator.history().back();
    std::cout << (stationary ? "stationary" : "still changing") << " after " << last.step << " steps, velocity "
              << last.velocity << ", film " << last.film_thickness_min << '\n';
    write_vtk_surface("vesicle.vtp", shape_columns(simulator.configuration(), simulator.instant()));
}
