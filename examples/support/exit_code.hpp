// SPDX-License-Identifier: MIT
#pragma once

namespace examples {

enum ExitCode { success = 0, internal_error = 1, bad_input = 2, simulation_failure = 3, interrupted = 130 };

}  // namespace examples
