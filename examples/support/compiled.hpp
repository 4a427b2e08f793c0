// SPDX-License-Identifier: MIT
// Policies whose costly templates are compiled once, in simulations/operators_*.cpp and newton*.cpp,
// for all the programs that use them.
#pragma once

#include "surroundings.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/stationary/stationary_solver.hpp>
#include <axistokes/wall/no_wall.hpp>

#include <complex>
#include <memory>
#include <vector>

namespace examples {

template <class Discretization>
class Compiled : public Discretization {
  public:
    using Scalar = double;
    using Surface = typename Discretization::Surface;
    using Shape = axistokes::Meridian<double>;
    using Free = axistokes::FreeSpaceKernel<double>;
    using Discretization::Discretization;

    /// As the discretisation's own, if it has one.
    Compiled loosened(double tolerance) const
        requires(requires(const Discretization& discretization) { discretization.loosened(0.0); }) {
        return Compiled(Discretization::loosened(tolerance).params());
    }

    Surface surface(const Shape& meridian, axistokes::SurfaceParts parts = axistokes::SurfaceParts::all) const;
    axistokes::Matrix<double> single_layer(const Shape& meridian, const OptionalTubeKernel& kernel) const;
    axistokes::Matrix<double> single_layer(const Shape& meridian, const Free& kernel) const;
    axistokes::Matrix<double> single_layer_at(const Shape& targets, const Shape& meridian,
                                              const OptionalTubeKernel& kernel) const;
    axistokes::Matrix<double> single_layer_at(const Shape& targets, const Shape& meridian, const Free& kernel) const;
};

/// A StationarySolver.
template <class Scene>
class CompiledSolver {
  public:
    using Solver = axistokes::StationarySolver<Scene>;
    using State = typename Solver::State;
    using Params = typename Solver::Params;

    CompiledSolver(const Scene& scene, const Params& params);
    CompiledSolver(const CompiledSolver&) = delete;
    CompiledSolver& operator=(const CompiledSolver&) = delete;
    ~CompiledSolver();

    State solve(const axistokes::Meridian<double>& shape, double area, double volume);
    std::vector<std::complex<double>> growth_rates(const State& state);

  private:
    std::unique_ptr<Solver> solver_;
};

using LinearElements = Compiled<axistokes::LinearElements<double>>;
using SpectralMeridian = Compiled<axistokes::SpectralMeridian<double>>;
template <class Discretization>
using OpenScene = axistokes::Scene<OptionalTubeKernel, Discretization, axistokes::Vesicle<double>, Drive,
                                   axistokes::DenseLU<double>, axistokes::NoWall>;
template <class Discretization>
using MeshedScene =
    axistokes::Scene<axistokes::FreeSpaceKernel<double>, Discretization, axistokes::Vesicle<double>, Drive,
                     axistokes::DenseLU<double>, axistokes::WallMesh<axistokes::StraightTube<double>>>;

extern template class Compiled<axistokes::LinearElements<double>>;
extern template class Compiled<axistokes::SpectralMeridian<double>>;

extern template class CompiledSolver<OpenScene<LinearElements>>;
extern template class CompiledSolver<OpenScene<SpectralMeridian>>;
extern template class CompiledSolver<MeshedScene<LinearElements>>;
extern template class CompiledSolver<MeshedScene<SpectralMeridian>>;

}  // namespace examples
