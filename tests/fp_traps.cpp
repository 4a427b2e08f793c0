// SPDX-License-Identifier: MIT
// Preloaded into a program, or linked to it: invalid operations and overflows end it with SIGFPE. Divisions by zero do
// not: infinities are used on purpose.
#include <cfenv>

namespace {

[[maybe_unused]] const int trapped = feenableexcept(FE_INVALID | FE_OVERFLOW);

}  // namespace
