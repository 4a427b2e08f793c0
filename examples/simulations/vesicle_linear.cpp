// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"

int examples::run_linear(const VesicleCase& c) {
    return run_in<LinearElements>(c);
}
