// SPDX-License-Identifier: MIT
#include "../support/line_run.hpp"

int examples::run_line_linear(const LineCase& c) {
    return LineRun<LinearElements>(c)();
}
