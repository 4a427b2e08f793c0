// SPDX-License-Identifier: MIT
// A vesicle, heavier than the fluid, settles along its axis until it is stationary.
#include "support/run.hpp"
#include <axistokes/axistokes.hpp>

int main(int argc, char** argv) {
    using namespace axistokes;
    using Settling = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                               SemiImplicitEuler, DenseLU<double>>;

    CLI::App app{"An axisymmetric vesicle settles under gravity (along -z) in an unbounded fluid"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    double bond = 47;
    vesicle.add_to(app);
    examples::add_number(app, "--bond", bond, "Bond number B0 = (rho_in - rho_out) g R0^4 / kappa (< 0: rises)");
    run.add_to(app);

    return examples::run_program("settling_vesicle", app, argc, argv, [&] {
        const auto params = run.params();
        Settling simulator(vesicle.shape(run.elements), Gravity<double>(bond), params);
        return examples::run_to_end(simulator, run, {{"excess_area", vesicle.excess_area}, {"bond", bond}});
    });
}
