// includes: core
// omits: special/elliptic
#include <axistokes/kernel/free_space.hpp>
