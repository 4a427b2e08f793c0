// SPDX-License-Identifier: MIT
// Comma-separated tables: a shape with the forces on it, and the history of a simulation.
#pragma once

#include "../scene.hpp"
#include "../simulator.hpp"
#include "atomic_file.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace axistokes {

/// A named column of a table; all columns of a table are equally long.
template <class S>
struct Column {
    std::string name;
    Vector<S> values;
};

/// Header line and one line a row, 17 digits. Throws InvalidArgument for columns of unequal lengths and OutputError.
template <class S>
void write_csv(const std::filesystem::path& path, const std::vector<Column<S>>& columns) {
    for (const Column<S>& column : columns) {
        detail::require(column.values.size() == columns.front().values.size(),
                        ("length of column " + column.name).c_str(), column.values.size(), "that of the other columns");
    }
    write_atomically(path, [&](std::ostream& out) {
        const char* separator = "";
        for (const Column<S>& column : columns) {
            out << separator << column.name;
            separator = ",";
        }
        out << '\n';
        for (Index row = 0; !columns.empty() && row < columns.front().values.size(); ++row) {
            separator = "";
            for (const Column<S>& column : columns) {
                out << separator << column.values[row];
                separator = ",";
            }
            out << '\n';
        }
    });
}

/// The nodes from the lower pole to the upper one, z relative to the centroid, and what is known there. Force densities
/// (kappa/R0^3) are the membrane's on the fluid; velocities are in the laboratory frame. What a
/// body does not have, such as a tension or, rigid, a curvature and an elastic force, has no column.
template <class S, class Surface>
std::vector<Column<S>> shape_columns(const Configuration<S>& configuration, const Instant<S, Surface>& instant) {
    const Surface& surface = instant.surface;
    const MobilitySolution<S>& solution = instant.solution;
    const Index n = configuration.shape.nodes();
    std::vector<Column<S>> columns{
        {"arc_length", surface.arc_length}, {"r", configuration.shape.r},   {"z", configuration.shape.z},
        {"normal_r", surface.normal_r},     {"normal_z", surface.normal_z},
    };
    if (surface.mean_curvature.size() == n) {
        columns.push_back({"mean_curvature", surface.mean_curvature});
    }
    const auto add_field = [&](const std::string& name, const Vector<S>& field) {
        if (field.size() == 2 * n) {
            columns.push_back({name + "_r", field.head(n)});
            columns.push_back({name + "_z", field.tail(n)});
        }
    };
    if (solution.tension.size() > 0) {
        columns.push_back({"tension", surface.at_nodes(solution.tension)});
    }
    add_field("force", solution.force);
    add_field("elastic_force", solution.elastic);
    add_field("velocity", solution.velocity);
    return columns;
}

/// One row a time step, in the order and with the meaning of StepRecord; the columns of a
/// confined scene only if there is a wall.
template <class S>
std::vector<Column<S>> history_columns(const std::vector<StepRecord<S>>& history) {
    std::vector<Column<S>> columns;
    const auto add = [&](const char* name, auto StepRecord<S>::*member) {
        Vector<S> values(static_cast<Index>(history.size()));
        for (std::size_t i = 0; i < history.size(); ++i) {
            values[static_cast<Index>(i)] = static_cast<S>(history[i].*member);
        }
        columns.push_back({name, std::move(values)});
    };
    using Record = StepRecord<S>;
    add("step", &Record::step);
    add("time", &Record::time);
    add("dt", &Record::dt);
    add("position", &Record::position);
    add("velocity", &Record::velocity);
    add("length", &Record::length);
    add("max_radius", &Record::max_radius);
    add("area", &Record::area);
    add("volume", &Record::volume);
    add("area_drift", &Record::area_drift);
    add("volume_drift", &Record::volume_drift);
    add("area_error", &Record::area_error);
    add("volume_error", &Record::volume_error);
    add("bending_energy", &Record::bending_energy);
    add("residual", &Record::residual);
    add("power", &Record::power);
    add("power_mismatch", &Record::power_mismatch);
    if (!history.empty() && std::isfinite(static_cast<double>(history.back().film_thickness_min))) {
        add("film_thickness_min", &Record::film_thickness_min);
        add("film_thickness_mean", &Record::film_thickness_mean);
        add("pressure_drop", &Record::pressure_drop);
    }
    if (!history.empty() && std::isfinite(static_cast<double>(history.back().neighbour_distance))) {
        add("neighbour_distance", &Record::neighbour_distance);
    }
    add("rejected", &Record::rejected);
    add("redistributed", &Record::redistributed);
    return columns;
}

}  // namespace axistokes
