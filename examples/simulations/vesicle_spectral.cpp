// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"

int examples::run_spectral(const VesicleCase& c) {
    return run_in<SpectralMeridian>(c);
}
