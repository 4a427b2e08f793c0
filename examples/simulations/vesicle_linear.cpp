// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"
#include <axistokes/discretization/linear_elements.hpp>

int examples::run_linear(const VesicleCase& c) {
    return run_in<axistokes::LinearElements<double>>(c);
}
