// SPDX-License-Identifier: MIT
#include "../support/compile_operators.hpp"

template class examples::Compiled<axistokes::LinearElements<double>>;
