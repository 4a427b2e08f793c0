// SPDX-License-Identifier: MIT
#define AXISTOKES_ELEMENTS template
#include <axistokes/compiled.hpp>
