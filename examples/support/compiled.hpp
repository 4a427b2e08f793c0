// SPDX-License-Identifier: MIT
// Policies whose costly templates are compiled once, in simulations/operators_*.cpp and membranes_*.cpp, for all the
// programs that use them.
#pragma once

#include "surroundings.hpp"
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/solver/dense.hpp>

namespace examples {

template <class Discretization>
class Compiled : public Discretization {
  public:
    using Scalar = double;
    using Surface = typename Discretization::Surface;
    using Shape = axistokes::Meridian<double>;
    using Free = axistokes::FreeSpaceKernel<double>;
    using Discretization::Discretization;

    Surface surface(const Shape& meridian) const;
    axistokes::Matrix<double> single_layer(const Shape& meridian, const OptionalTubeKernel& kernel) const;
    axistokes::Matrix<double> single_layer(const Shape& meridian, const Free& kernel) const;
    axistokes::Matrix<double> single_layer_at(const Shape& targets, const Shape& meridian,
                                              const OptionalTubeKernel& kernel) const;
    axistokes::Matrix<double> single_layer_at(const Shape& targets, const Shape& meridian, const Free& kernel) const;
};

template <class Membrane, class Surface>
class CompiledMembrane : public Membrane {
  public:
    using Scalar = double;
    axistokes::MobilitySolution<double> solve(const axistokes::MobilityProblem<double, Surface>& problem,
                                              axistokes::DenseLU<double>& solver) const;
};

using LinearElements = Compiled<axistokes::LinearElements<double>>;
using SpectralMeridian = Compiled<axistokes::SpectralMeridian<double>>;
template <class Discretization>
using Vesicle = CompiledMembrane<axistokes::Vesicle<double>, typename Discretization::Surface>;
template <class Discretization>
using RigidBody = CompiledMembrane<axistokes::RigidBody<double>, typename Discretization::Surface>;

extern template class Compiled<axistokes::LinearElements<double>>;
extern template class Compiled<axistokes::SpectralMeridian<double>>;
extern template class CompiledMembrane<axistokes::Vesicle<double>, axistokes::LinearElements<double>::Surface>;
extern template class CompiledMembrane<axistokes::Vesicle<double>, axistokes::SpectralMeridian<double>::Surface>;
extern template class CompiledMembrane<axistokes::RigidBody<double>, axistokes::LinearElements<double>::Surface>;
extern template class CompiledMembrane<axistokes::RigidBody<double>, axistokes::SpectralMeridian<double>::Surface>;

}  // namespace examples
