// SPDX-License-Identifier: MIT
#include "../support/compile_membranes.hpp"

using Surface = axistokes::SpectralMeridian<double>::Surface;
template class examples::CompiledMembrane<axistokes::Vesicle<double>, Surface>;
template class examples::CompiledMembrane<axistokes::RigidBody<double>, Surface>;
