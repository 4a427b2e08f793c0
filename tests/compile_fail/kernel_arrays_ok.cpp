// SPDX-License-Identifier: MIT
// The counterpart of read_only_kernel_arrays.cpp that must compile.
#include <axistokes/core.hpp>

void receive(double* values) {
    axistokes::KernelArrays<double> arrays;
    arrays.rr = values;
}
