// SPDX-License-Identifier: MIT
#include "../support/compile_layers.hpp"

template struct examples::Layers<examples::AnyDiscretization::Adaptive>;
