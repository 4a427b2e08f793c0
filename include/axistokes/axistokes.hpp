// SPDX-License-Identifier: MIT
// Everything. A program that wants less includes the headers of its own policies and simulator.hpp.
#pragma once

#include "accuracy.hpp"
#include "accuracy/driver.hpp"
#include "discretization/adaptive_meridian.hpp"
#include "discretization/linear_elements.hpp"
#include "discretization/spectral_meridian.hpp"
#include "flow/background.hpp"
#include "geometry/tube_shapes.hpp"
#include "io/csv.hpp"
#include "io/step_journal.hpp"
#include "io/vtk.hpp"
#include "kernel/free_space.hpp"
#include "kernel/imaged.hpp"
#include "kernel/tube.hpp"
#include "kernel/tube_filon.hpp"
#include "membrane/rigid_body.hpp"
#include "membrane/vesicle.hpp"
#include "simulator.hpp"
#include "solver/dense.hpp"
#include "solver/gmres.hpp"
#include "stationary/continuation.hpp"
#include "stationary/stationary_branch.hpp"
#include "stationary/stationary_solver.hpp"
#include "time/explicit_euler.hpp"
#include "time/extrapolated_euler.hpp"
#include "time/semi_implicit_euler.hpp"
#include "wall/passage.hpp"
#include "wall/points_profile.hpp"
#include "wall/wall_mesh.hpp"

#ifdef AXISTOKES_COMPILED
#include "compiled.hpp"
#endif
