// SPDX-License-Identifier: MIT
#include "../support/passage_run.hpp"

int examples::pass_linear(const PassageOptions& options) {
    return PassageRun<LinearElements>(options)();
}
