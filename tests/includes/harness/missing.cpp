// includes: membrane
// omits: bessel
#include <axistokes/kernel/free_space.hpp>
