// SPDX-License-Identifier: MIT
#include "../support/body_run.hpp"

int examples::run_body_linear(const BodyCase& c) {
    return run_body_in<LinearElements>(c);
}
