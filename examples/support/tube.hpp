// SPDX-License-Identifier: MIT
// The confinement of simulations in a tube.
#pragma once

#include "options.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <optional>

namespace examples {

/// Confinement L = R0/Rc, the radius of the sphere of equal volume over that of the tube; may exceed 1 for a vesicle.
struct TubeOptions {
    std::optional<double> confinement;

    void add_to(CommandLine& app, const std::string& without);

    double radius() const {
        axistokes::detail::require(*confinement > 0 && std::isfinite(*confinement), "confinement", *confinement,
                                   "> 0 and finite");
        return 1 / *confinement;
    }

    /// The initial shape of a vesicle, which must fit.
    axistokes::Meridian<double> shape(const VesicleOptions& vesicle, axistokes::Index elements) const {
        return axistokes::shape_in_tube<double>(vesicle.excess_area, radius(), vesicle.spheroid_kind(), elements);
    }
};

}  // namespace examples
