// SPDX-License-Identifier: MIT
#include "../support/simulation.hpp"

namespace examples {

Newton::Newton(const Scene& scene, const Params& params) : solver_(std::make_unique<Solver>(scene, params)) {}

Newton::Newton(Newton&&) noexcept = default;

Newton::~Newton() = default;

Newton::State Newton::solve(const axistokes::Meridian<double>& shape, double area, double volume) {
    return solver_->solve(shape, area, volume);
}

Newton::State Newton::solve(const Scene::State& bodies, const std::vector<axistokes::Measures<double>>& measures) {
    return solver_->solve(bodies, measures);
}

std::vector<std::complex<double>> Newton::growth_rates(const State& state) {
    return solver_->growth_rates(state);
}

std::vector<std::complex<double>> Newton::growth_rates(const State& state, double step) {
    return solver_->growth_rates(state, step);
}

}  // namespace examples
