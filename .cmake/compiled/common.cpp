// SPDX-License-Identifier: MIT
#define AXISTOKES_COMMON template
#include <axistokes/compiled.hpp>
