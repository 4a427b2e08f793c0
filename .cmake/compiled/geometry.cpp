// SPDX-License-Identifier: MIT
#define AXISTOKES_GEOMETRY template
#include <axistokes/compiled.hpp>
