// SPDX-License-Identifier: MIT
#define AXISTOKES_LINEAR template
#include <axistokes/compiled.hpp>
