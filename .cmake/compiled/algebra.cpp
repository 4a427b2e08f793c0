// SPDX-License-Identifier: MIT
#define AXISTOKES_ALGEBRA template
#include <axistokes/compiled.hpp>
