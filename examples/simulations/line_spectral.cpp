// SPDX-License-Identifier: MIT
#include "../support/line_run.hpp"

int examples::run_line_spectral(const LineCase& c) {
    return LineRun<SpectralMeridian>(c)();
}
