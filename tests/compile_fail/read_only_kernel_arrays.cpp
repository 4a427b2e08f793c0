// expect: const double ?\*
// SPDX-License-Identifier: MIT
// Kernel entries cannot be written into read-only memory.
#include <axistokes/core.hpp>

void receive(const double* values) {
    axistokes::KernelArrays<double> arrays;
    arrays.rr = values;
}
