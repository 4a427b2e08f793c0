// SPDX-License-Identifier: MIT
#define AXISTOKES_TUBE template
#include <axistokes/compiled.hpp>
