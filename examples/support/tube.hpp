// SPDX-License-Identifier: MIT
// What simulations in a tube share: the confinement and the summary's further keys.
#pragma once

#include "options.hpp"
#include "summary.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <optional>
#include <type_traits>

namespace examples {

/// Confinement L = R0/Rc, the radius of the sphere of equal volume over that of the tube; may exceed 1 for a vesicle.
struct TubeOptions {
    std::optional<double> confinement;

    void add_to(CLI::App& app, const std::string& without);

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

/// Film thickness (R0), pressure drop that the particle adds (kappa/R0^3) and, in a flow of the given mean velocity,
/// the mobility; of a meshed wall also its panels, without those on the ends, and all its nodes.
template <class Simulator>
nlohmann::ordered_json tube_summary(const Simulator& simulator, const Ending<Simulator>& ending, double mean_velocity) {
    const double radius = simulator.scene().gap({0, ending.configuration.position});
    nlohmann::ordered_json summary{{"tube_radius", radius}, {"confinement", 1 / radius}};
    const auto film = simulator.scene().film_thickness(ending.configuration);
    summary["film_thickness_min"] = film.min;
    summary["film_thickness_mean"] = film.mean;
    if constexpr (std::remove_cvref_t<decltype(simulator.scene().wall())>::present) {
        if (const auto& mesh = simulator.scene().wall().mesh()) {
            summary["wall_panels"] = mesh->wall_panels();
            summary["wall_nodes"] = mesh->curve().size();
        }
    }
    if (ending.velocity) {
        summary["pressure_drop"] = ending.pressure_drop;
        if (mean_velocity != 0) {
            summary["mobility"] = *ending.velocity / mean_velocity;
        }
    }
    return summary;
}

}  // namespace examples
