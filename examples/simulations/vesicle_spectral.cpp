// SPDX-License-Identifier: MIT
#include "../support/vesicle_run.hpp"
#include <axistokes/discretization/spectral_meridian.hpp>

int examples::run_spectral(const VesicleCase& c) {
    return run_in<axistokes::SpectralMeridian<double>>(c);
}
