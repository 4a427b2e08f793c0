// SPDX-License-Identifier: MIT
#define AXISTOKES_SPECTRAL template
#include <axistokes/compiled.hpp>
