// SPDX-License-Identifier: MIT
// What simulations in a tube share: the confinement and the summary's further keys.
#pragma once

#include "options.hpp"
#include "summary.hpp"
#include <axistokes/geometry/tube_shapes.hpp>

#include <numbers>
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

/// Of a particle in a tube (docs/gallery.md, "The summary of a scene in a tube"): the film (R0), the pressure drop that
/// the particle adds (kappa/R0^3) and, in a flow of the given mean velocity V, that drop in eta V/Rc, the mobility U/V,
/// the ratio of tube to discharge haematocrit V/U, the viscosity relative to the fluid's of a piece of tube as long as
/// the particle, and the intrinsic one (the relative increase over the volume fraction, whatever the length); of a
/// meshed wall also its panels, without those on the ends, and all its nodes.
template <class Simulator>
nlohmann::ordered_json tube_summary(const Simulator& simulator, const Ending<Simulator>& ending, double mean_velocity) {
    const auto& result = ending.result;
    const auto& shape = result.configuration.shape;
    const double radius = simulator.scene().gap({0, result.configuration.position});
    nlohmann::ordered_json summary{{"tube_radius", radius}, {"confinement", 1 / radius}};
    const auto film = simulator.scene().film_thickness(result.configuration);
    summary["film_thickness_min"] = film.min;
    summary["film_thickness_min_z"] = film.where - result.configuration.position;
    summary["film_thickness_mean"] = film.mean;
    if constexpr (std::remove_cvref_t<decltype(simulator.scene().wall())>::present) {
        if (const auto& mesh = simulator.scene().wall().mesh()) {
            summary["wall_panels"] = mesh->wall_panels();
            summary["wall_nodes"] = mesh->curve().size();
        }
    }
    if (result.instant) {
        const double drop = result.instant->pressure_drop;
        summary["pressure_drop"] = drop;
        if (mean_velocity != 0) {
            const double volume = simulator.scene().discretization().measures(shape).volume;
            const double length = shape.z[shape.nodes() - 1] - shape.z[0];
            summary["mobility"] = *result.velocity / mean_velocity;
            summary["haematocrit_ratio"] = mean_velocity / *result.velocity;
            summary["pressure_drop_viscous"] = drop * radius / mean_velocity;
            const double increase = drop * radius * radius / (8 * mean_velocity);  // times the piece's length
            summary["relative_apparent_viscosity"] = 1 + increase / length;
            summary["intrinsic_viscosity"] = increase * std::numbers::pi * radius * radius / volume;
        }
    }
    return summary;
}

}  // namespace examples
