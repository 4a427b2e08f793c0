// SPDX-License-Identifier: MIT
// What the library axistokes::compiled holds: the usual policies for double. A program that links it is compiled with
// AXISTOKES_COMPILED defined, and axistokes.hpp then declares these templates instead of letting the compiler
// instantiate them. Members defined inside their class would be instantiated all the same, and are not listed.
//
// One list for declarations and definitions: a source file of the library defines one of the AXISTOKES_... below as
// `template` before it includes this header.
#pragma once

#include "axistokes.hpp"

#ifndef AXISTOKES_GEOMETRY
#define AXISTOKES_GEOMETRY extern template
#endif
#ifndef AXISTOKES_ALGEBRA
#define AXISTOKES_ALGEBRA extern template
#endif
#ifndef AXISTOKES_TUBE
#define AXISTOKES_TUBE extern template
#endif
#ifndef AXISTOKES_ELEMENTS
#define AXISTOKES_ELEMENTS extern template
#endif
#ifndef AXISTOKES_SERIES
#define AXISTOKES_SERIES extern template
#endif

namespace axistokes {

AXISTOKES_GEOMETRY GaussLegendreRule<double> gauss_legendre(Index);
AXISTOKES_GEOMETRY void validate(const Meridian<double>&);
AXISTOKES_GEOMETRY std::string detail::fault(const Meridian<double>&);
AXISTOKES_GEOMETRY double bending_energy(const Meridian<double>&);
AXISTOKES_GEOMETRY bool restore_area_and_volume(Meridian<double>&, const double&, const double&, const double&);
AXISTOKES_GEOMETRY bool restore_volume(Meridian<double>&, const double&, const double&);
AXISTOKES_GEOMETRY double spacing_distortion(const Meridian<double>&, const NodeSpacing<double>&);
AXISTOKES_GEOMETRY Meridian<double> redistribute(const Meridian<double>&, const NodeSpacing<double>&, Index,
                                                 Meridian<double>&);
AXISTOKES_GEOMETRY double distance(const Meridian<double>&, const Meridian<double>&);
AXISTOKES_GEOMETRY Meridian<double> spheroid(const double&, const double&, Index, const NodeSpacing<double>&);
AXISTOKES_GEOMETRY Meridian<double> sphere(Index, const double&, const NodeSpacing<double>&);
AXISTOKES_GEOMETRY Meridian<double> spheroid_of_aspect(const double&, Index, const NodeSpacing<double>&);
AXISTOKES_GEOMETRY Meridian<double> spheroid_of_excess_area(const double&, SpheroidKind, Index,
                                                            const NodeSpacing<double>&);
AXISTOKES_GEOMETRY Meridian<double> shape_in_tube(const double&, const double&, SpheroidKind, Index,
                                                  const NodeSpacing<double>&);
AXISTOKES_GEOMETRY void write_csv(const std::filesystem::path&, const std::vector<Column<double>>&);
AXISTOKES_GEOMETRY void write_vtk_surface(const std::filesystem::path&, const std::vector<Column<double>>&, Index);
AXISTOKES_GEOMETRY void write_vtk_flow(const std::filesystem::path&, const FlowField<double>&, const double&);
AXISTOKES_GEOMETRY std::vector<Column<double>> history_columns(const std::vector<StepRecord<double>>&);

AXISTOKES_TUBE void detail::TubeAssembly<double>::add_to(Matrix<double>&,
                                                         const detail::TubeAssembly<double>::Quadrature&);

AXISTOKES_ALGEBRA void DenseLU<double>::factorize(const Matrix<double>&);
AXISTOKES_ALGEBRA Vector<double> DenseLU<double>::solve(const Vector<double>&) const;

// Parameters are names of templates, which bear no parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define AXISTOKES_LAYERS(where, basis, kernel)                                                     \
    where Matrix<double> detail::single_layer(const detail::basis<double>&, const kernel<double>&, \
                                              const Meridian<double>&, bool);                      \
    where Matrix<double> detail::double_layer(const detail::basis<double>&, const kernel<double>&, \
                                              const Meridian<double>&, bool);
AXISTOKES_LAYERS(AXISTOKES_ELEMENTS, ElementBasis, FreeSpaceKernel)
AXISTOKES_LAYERS(AXISTOKES_ELEMENTS, ElementBasis, TubeKernel)
AXISTOKES_LAYERS(AXISTOKES_SERIES, SeriesBasis, FreeSpaceKernel)
AXISTOKES_LAYERS(AXISTOKES_SERIES, SeriesBasis, TubeKernel)
#undef AXISTOKES_LAYERS

AXISTOKES_ELEMENTS LinearSurface<double> linear_surface(const Meridian<double>&, SurfaceParts);
AXISTOKES_SERIES SpectralSurface<double> spectral_surface(const Meridian<double>&, SurfaceParts);

#define AXISTOKES_MOTION(where, surface, law)                                                                        \
    where void detail::complete_rank(const std::vector<detail::EquationBody<double, surface<double>, law<double>>>&, \
                                     Matrix<double>&, Vector<double>&);                                              \
    where detail::MotionEquation<double, surface<double>, law<double>>::MotionEquation(                              \
        const std::vector<detail::EquationBody<double, surface<double>, law<double>>>&, const Matrix<double>&,       \
        const Vector<double>&, const double&);                                                                       \
    where std::vector<MobilitySolution<double>> detail::MotionEquation<double, surface<double>, law<double>>::solve( \
        DenseLU<double>&);
AXISTOKES_MOTION(AXISTOKES_ELEMENTS, LinearSurface, Vesicle)
AXISTOKES_MOTION(AXISTOKES_ELEMENTS, LinearSurface, RigidBody)
AXISTOKES_MOTION(AXISTOKES_SERIES, SpectralSurface, Vesicle)
AXISTOKES_MOTION(AXISTOKES_SERIES, SpectralSurface, RigidBody)
#undef AXISTOKES_MOTION
// NOLINTEND(bugprone-macro-parentheses)

AXISTOKES_ELEMENTS std::pair<double, Vector<double>> detail::relative_normal_velocity(const LinearSurface<double>&,
                                                                                      const Vector<double>&,
                                                                                      const Vector<double>&);
AXISTOKES_SERIES std::pair<double, Vector<double>> detail::relative_normal_velocity(const SpectralSurface<double>&,
                                                                                    const Vector<double>&,
                                                                                    const Vector<double>&);

AXISTOKES_ELEMENTS std::vector<Column<double>> shape_columns(const Configuration<double>&,
                                                             const Instant<double, LinearSurface<double>>&);
AXISTOKES_SERIES std::vector<Column<double>> shape_columns(const Configuration<double>&,
                                                           const Instant<double, SpectralSurface<double>>&);

}  // namespace axistokes
