// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"

int examples::run_spectral_in_mesh(const VesicleCase& c) {
    return run_in_mesh<SpectralMeridian>(c);
}
