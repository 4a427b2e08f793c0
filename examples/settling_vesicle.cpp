// SPDX-License-Identifier: MIT
// A vesicle, heavier than the fluid, settles along its axis until it is stationary, in an unbounded fluid or in a tube.
#include "support/run.hpp"
#include "support/tube.hpp"
#include <axistokes/axistokes.hpp>

int main(int argc, char** argv) {
    using namespace axistokes;
    using Settling = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                               SemiImplicitEuler, DenseLU<double>>;
    using SettlingInTube = Simulator<TubeKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                                     SemiImplicitEuler, DenseLU<double>>;

    CLI::App app{"An axisymmetric vesicle settles under gravity (along -z), in an unbounded fluid or along a tube"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    examples::TubeOptions tube;
    double bond = 47;
    vesicle.add_to(app);
    examples::add_number(app, "--bond", bond, "Bond number B0 = (rho_in - rho_out) g R0^4 / kappa (< 0: rises)");
    tube.add_to(app, "the fluid is unbounded");
    run.add_to(app);

    return examples::run_program("settling_vesicle", app, argc, argv, [&] {
        const nlohmann::ordered_json parameters{{"excess_area", vesicle.excess_area}, {"bond", bond}};
        const auto params = run.params();
        if (!tube.confinement) {
            Settling simulator(vesicle.shape(run.elements), Gravity<double>(bond), params);
            return examples::run_to_end(simulator, run, parameters);
        }
        SettlingInTube simulator(tube.shape(vesicle, run.elements), Gravity<double>(bond), params,
                                 TubeKernel<double>(tube.radius()));
        return examples::run_to_end(simulator, run, parameters,
                                    [](const auto& s, const auto&) { return examples::tube_summary(s, 0); });
    });
}
