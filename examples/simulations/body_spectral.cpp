// SPDX-License-Identifier: MIT
#include "../support/body_run.hpp"

int examples::run_body_spectral(const BodyCase& c) {
    return run_body_in<SpectralMeridian>(c);
}
