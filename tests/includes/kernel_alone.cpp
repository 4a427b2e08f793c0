// includes: special/elliptic
// omits: geometry|discretization|membrane|solver|time/|flow|bessel|tube
// SPDX-License-Identifier: MIT
#include <axistokes/kernel/free_space.hpp>
