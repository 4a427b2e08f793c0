// SPDX-License-Identifier: MIT
// A vesicle is carried through a channel that narrows to less than its rest radius.
#include "support/passage_case.hpp"

int main(int argc, char** argv) {
    CLI::App app{"A vesicle is carried through a channel that narrows to less than its rest radius"};
    examples::PassageOptions options;
    options.add_to(app);
    return examples::run_program("vesicle_through_constriction", app, argc, argv, [&] {
        options.check();
        return options.method.spectral() ? examples::pass_spectral(options) : examples::pass_linear(options);
    });
}
