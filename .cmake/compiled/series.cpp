// SPDX-License-Identifier: MIT
#define AXISTOKES_SERIES template
#include <axistokes/compiled.hpp>
