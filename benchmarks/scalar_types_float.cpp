// SPDX-License-Identifier: MIT
#include "scalar_types.hpp"

template std::vector<scalar_types::Result> scalar_types::results<float>();
