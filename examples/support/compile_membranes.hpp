// SPDX-License-Identifier: MIT
// Body of CompiledMembrane, for the files that compile it.
#pragma once

#include "compiled.hpp"

namespace examples {

template <class Membrane, class Surface>
axistokes::MobilitySolution<double> CompiledMembrane<Membrane, Surface>::solve(
    const axistokes::MobilityProblem<double, Surface>& problem, axistokes::DenseLU<double>& solver) const {
    return Membrane::solve(problem, solver);
}

}  // namespace examples
