// SPDX-License-Identifier: MIT
#include "work_precision.hpp"

namespace work_precision {

using Discretization = axistokes::SpectralMeridian<double>;
template Outcome drag<Discretization>(double, Index);
template Outcome stationary<Discretization>(Vesicle, Stepping, const Setting&);
template Outcome transient<Discretization>(Stepping, const Setting&);

}  // namespace work_precision
