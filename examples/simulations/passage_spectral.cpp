// SPDX-License-Identifier: MIT
#include "../support/passage_run.hpp"

int examples::pass_spectral(const PassageOptions& options) {
    return pass<SpectralMeridian>(options);
}
