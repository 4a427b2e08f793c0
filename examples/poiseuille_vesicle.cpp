// SPDX-License-Identifier: MIT
// A vesicle on the axis of a Poiseuille flow.
#include "support/run.hpp"
#include <axistokes/axistokes.hpp>

int main(int argc, char** argv) {
    using namespace axistokes;
    using InFlow = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>,
                             UnboundedPoiseuille<double>, SemiImplicitEuler, DenseLU<double>>;

    CLI::App app{"An axisymmetric vesicle in the unbounded Poiseuille flow u_z = -Ca_unb r^2"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    double capillary_number = 0.5;
    vesicle.add_to(app);
    examples::add_number(app, "--unbounded-capillary-number", capillary_number,
                         "Ca_unb = eta c R0^4 / kappa of the flow -c r^2");
    run.add_to(app);

    return examples::run_program("poiseuille_vesicle", app, argc, argv, [&] {
        const auto params = run.params();
        InFlow simulator(vesicle.shape(run.elements), UnboundedPoiseuille<double>(capillary_number), params);
        return examples::run_to_end(
            simulator, run, {{"excess_area", vesicle.excess_area}, {"unbounded_capillary_number", capillary_number}});
    });
}
