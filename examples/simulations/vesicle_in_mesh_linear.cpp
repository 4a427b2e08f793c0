// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"
#include <axistokes/discretization/linear_elements.hpp>

int examples::run_linear_in_mesh(const VesicleCase& c) {
    return run_in_mesh<axistokes::LinearElements<double>>(c);
}
