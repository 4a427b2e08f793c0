// SPDX-License-Identifier: MIT
// What the library axistokes::compiled holds for double. axistokes.hpp includes this where that library is linked,
// which defines AXISTOKES_COMPILED: no program then compiles it again (docs/compile_time.md).
//
// One list: .cmake/compiled/*.cpp define AXISTOKES_TEMPLATE as `template` for their share of it, everybody else sees
// `extern template`.
#pragma once

#include "discretization/linear_elements.hpp"
#include "discretization/spectral_meridian.hpp"
#include "equation/motion.hpp"
#include "geometry/distance.hpp"
#include "geometry/shapes.hpp"
#include "geometry/tube_shapes.hpp"
#include "io/csv.hpp"
#include "io/vtk.hpp"
#include "kernel/free_space.hpp"
#include "kernel/tube.hpp"
#include "membrane/vesicle.hpp"
#include "solver/dense.hpp"

#ifndef AXISTOKES_LINEAR
#define AXISTOKES_LINEAR extern template
#endif
#ifndef AXISTOKES_SPECTRAL
#define AXISTOKES_SPECTRAL extern template
#endif
#ifndef AXISTOKES_COMMON
#define AXISTOKES_COMMON extern template
#endif

namespace axistokes {

AXISTOKES_COMMON class DenseLU<double>;
AXISTOKES_COMMON void validate(const Meridian<double>&);
AXISTOKES_COMMON std::string detail::fault(const Meridian<double>&);
AXISTOKES_COMMON double least_distance(const Meridian<double>&, const Meridian<double>&);
AXISTOKES_COMMON Meridian<double> spheroid(const double&, const double&, Index, const NodeSpacing<double>&);
AXISTOKES_COMMON Meridian<double> spheroid_of_excess_area(const double&, SpheroidKind, Index,
                                                          const NodeSpacing<double>&);
AXISTOKES_COMMON Meridian<double> shape_in_tube(const double&, const double&, SpheroidKind, Index,
                                                const NodeSpacing<double>&);
AXISTOKES_COMMON std::vector<Column<double>> history_columns(const std::vector<StepRecord<double>>&);
AXISTOKES_COMMON void write_csv(const std::filesystem::path&, const std::vector<Column<double>>&);
AXISTOKES_COMMON void write_vtk_surface(const std::filesystem::path&, const std::vector<Column<double>>&, Index);

#define AXISTOKES_DISCRETISATION(TEMPLATE, DISCRETISATION, SURFACE)                                          \
    TEMPLATE Matrix<double> detail::LayerOperators<DISCRETISATION<double>, double>::single_layer(            \
        const Meridian<double>&, const FreeSpaceKernel<double>&) const;                                      \
    TEMPLATE Matrix<double> detail::LayerOperators<DISCRETISATION<double>, double>::single_layer(            \
        const Meridian<double>&, const TubeKernel<double>&) const;                                           \
    TEMPLATE Matrix<double> detail::LayerOperators<DISCRETISATION<double>, double>::single_layer_at(         \
        const Meridian<double>&, const Meridian<double>&, const FreeSpaceKernel<double>&) const;             \
    TEMPLATE Matrix<double> detail::LayerOperators<DISCRETISATION<double>, double>::single_layer_at(         \
        const Meridian<double>&, const Meridian<double>&, const TubeKernel<double>&) const;                  \
    TEMPLATE class detail::MotionEquation<double, SURFACE<double>, Vesicle<double>>;                         \
    TEMPLATE std::vector<MobilitySolution<double>>                                                           \
    detail::MotionEquation<double, SURFACE<double>, Vesicle<double>>::solve(DenseLU<double>&);               \
    TEMPLATE void detail::complete_rank(                                                                     \
        const std::vector<detail::EquationBody<double, SURFACE<double>, Vesicle<double>>>&, Matrix<double>&, \
        Vector<double>&);                                                                                    \
    TEMPLATE std::vector<Column<double>> shape_columns(const Configuration<double>&,                         \
                                                       const Instant<double, SURFACE<double>>&);

AXISTOKES_LINEAR class SplineGeometry<double>;
AXISTOKES_LINEAR LinearSurface<double> linear_surface(const Meridian<double>&, SurfaceParts);
AXISTOKES_DISCRETISATION(AXISTOKES_LINEAR, LinearElements, LinearSurface)
AXISTOKES_SPECTRAL class SpectralGeometry<double>;
AXISTOKES_SPECTRAL SpectralSurface<double> spectral_surface(const Meridian<double>&, SurfaceParts);
AXISTOKES_DISCRETISATION(AXISTOKES_SPECTRAL, SpectralMeridian, SpectralSurface)

#undef AXISTOKES_DISCRETISATION

}  // namespace axistokes
