// SPDX-License-Identifier: MIT
// Bodies of CompiledSolver, for the files that compile it.
#pragma once

#include "compiled.hpp"

namespace examples {

template <class Scene>
CompiledSolver<Scene>::CompiledSolver(const Scene& scene, const Params& params)
    : solver_(std::make_unique<Solver>(scene, params)) {}

template <class Scene>
CompiledSolver<Scene>::~CompiledSolver() = default;

template <class Scene>
typename CompiledSolver<Scene>::State CompiledSolver<Scene>::solve(const axistokes::Meridian<double>& shape,
                                                                   double area, double volume) {
    return solver_->solve(shape, area, volume);
}

template <class Scene>
std::vector<std::complex<double>> CompiledSolver<Scene>::growth_rates(const State& state) {
    return solver_->growth_rates(state);
}

}  // namespace examples
