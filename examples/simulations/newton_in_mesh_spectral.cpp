// SPDX-License-Identifier: MIT
#include "../support/compile_solver.hpp"

template class examples::CompiledSolver<examples::MeshedScene<examples::SpectralMeridian>>;
