// SPDX-License-Identifier: MIT
// Follows a vesicle through a channel and writes what came of it.
#pragma once

#include "compiled.hpp"
#include "exit_code.hpp"
#include "frames.hpp"
#include "neck.hpp"
#include "passage_case.hpp"
#include "progress.hpp"
#include "resolution.hpp"
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/io/csv.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/wall/passage.hpp>
#include <axistokes/wall/wall_mesh.hpp>

#include <chrono>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace examples {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::Vector;

template <class Discretization>
using Passage = axistokes::Simulator<axistokes::FreeSpaceKernel<double>, Discretization, Vesicle<Discretization>,
                                     axistokes::Quiescent<double>, axistokes::ExtrapolatedEulerOfOrder,
                                     axistokes::DenseLU<double>, axistokes::WallMesh<Channel>>;

/// Largest relative deviation of the flow rate through sections all along the channel.
template <class Discretization>
double flow_rate_deviation(Passage<Discretization>& simulator, double flow_rate) {
    const auto instant = simulator.instant();
    axistokes::WallMesh<Channel> wall = simulator.scene().wall();
    const auto field = wall.field(simulator.scene().discretization(), simulator.scene().kernel(), simulator.shape(),
                                  instant.solution.force);
    constexpr int sections = 9;
    double largest = 0;
    for (int i = 0; i < sections; ++i) {
        const double begin = wall.profile().begin();
        const double z = begin + (wall.profile().end() - begin) * (i + 0.5) / sections;
        largest = std::max(largest, std::abs(field.flow_rate(z, wall.radius(z)) / flow_rate - 1));
    }
    return largest;
}

inline Vector<double> wall_radii(const Channel& profile, const Vector<double>& z) {
    Vector<double> r(z.size());
    for (Index i = 0; i < z.size(); ++i) {
        r[i] = axistokes::ChannelMesh<Channel>::channel_radius(profile, z[i]);
    }
    return r;
}

template <class Discretization>
int pass(const PassageOptions& options) {
    const Channel profile = options.channel();
    const auto accuracy = options.method.accuracy();
    constexpr bool spectral = judges_itself<Discretization>;
    const auto discretization = discretization_for<Discretization>(accuracy);
    const bool adapts = spectral && accuracy && !options.elements;
    const auto initial = [&](Index elements) {
        return axistokes::spheroid_of_excess_area<double>(options.excess_area, axistokes::SpheroidKind::prolate,
                                                          elements);
    };
    Meridian<double> shape = nodes_of(discretization, initial, options.elements.value_or(spectral ? 48 : 80));
    const axistokes::Measures<double> measures = discretization.measures(shape);
    axistokes::require_passage(profile, measures.area, measures.volume);

    // The vesicle starts a radius upstream of where the channel begins to narrow, and ends as far downstream.
    const double start = profile.begin() - options.wide - shape.z.maxCoeff();
    shape.z.array() += start;
    axistokes::WallMeshParams<double> wall;
    wall.flow_rate = options.flow_rate;
    wall.tolerance = options.tolerance();
    double unresolved = 0;
    axistokes::SimulationParams<double> params;
    params.largest_displacement = options.displacement;
    params.step_tolerance = options.step_tolerance.value_or(accuracy ? accuracy->step : params.step_tolerance);
    Passage<Discretization> simulator(shape, {}, params, {}, discretization, {}, options.method.steps(), {},
                                      axistokes::WallMesh<Channel>(profile, wall));
    const auto resolve = [&] {
        if constexpr (spectral) {
            const Meridian<double>& now = simulator.configuration().shape;
            const double share = adapts ? discretization.unresolved(now) : 0;
            if (adapts && share > accuracy->unresolved && now.elements() < most_elements<Discretization>) {
                simulator.refine(
                    more_modes(now.elements(), share, accuracy->unresolved, most_elements<Discretization>));
            }
            unresolved = std::max(unresolved, discretization.unresolved(simulator.configuration().shape));
        }
    };
    if (!options.directory.empty()) {
        axistokes::create_output_directory(options.directory);
    }

    Frames frames;
    std::vector<double> entered_or_left;
    double film = std::numeric_limits<double>::infinity();
    double drop = 0;
    double deviation = 0;
    std::string failure;
    bool passed = false;
    bool stopped = false;
    constexpr double stuck = 1e-4;  // velocity over that of the flow in the throat
    const auto begin = std::chrono::steady_clock::now();
    {
        const InterruptGuard guard;
        ProgressBar bar;
        Index kept = 0;
        try {
            for (Index step = 0; step < options.most_steps && !passed && !guard.interrupted(); ++step) {
                const double position = simulator.configuration().position;
                const double way = (position - start) / (-2 * start);
                const double time = simulator.history().empty() ? 0 : simulator.history().back().time;
                if (way * static_cast<double>(options.frames - 1) >= static_cast<double>(kept)) {
                    frames.add(time, drawn_curve(discretization, simulator.shape()));
                    deviation = std::max(deviation, flow_rate_deviation(simulator, options.flow_rate));
                    ++kept;
                }
                const auto record = simulator.step();
                resolve();
                film = std::min(film, record.film_thickness_min);
                drop = std::max(drop, record.pressure_drop);
                const Meridian<double> now = simulator.shape();
                const bool inside = now.z.maxCoeff() > profile.begin();
                const bool outside = now.z.minCoeff() > profile.end();
                if ((inside && entered_or_left.empty()) || (outside && entered_or_left.size() == 1)) {
                    entered_or_left.push_back(record.time);
                }
                passed = record.position >= -start;
                if (std::abs(record.velocity) < stuck * simulator.scene().velocity_scale()) {
                    throw axistokes::SimulationFailure(
                        "the vesicle is stuck at z = " + std::to_string(record.position) +
                        ": this flow rate does not press it through the throat");
                }
                const auto neck = thinnest_neck(now);
                if (neck && neck->radius < neck->element / 2) {
                    std::ostringstream cause;
                    cause << "the membrane pinches off at z = " << neck->z << ": the radius of its neck, "
                          << neck->radius << ", is less than half of an element there";
                    throw axistokes::SimulationFailure(cause.str());
                }
                std::ostringstream text;
                text << "step " << record.step << "  z " << record.position << "  film " << record.film_thickness_min;
                bar.show(way, text.str());
            }
        } catch (const axistokes::SimulationFailure& error) {
            failure = error.what();
        }
        stopped = guard.interrupted();
    }
    if (!passed && !stopped && failure.empty()) {
        failure = "not through after " + std::to_string(options.most_steps) +
                  " steps: the centroid is at z = " + std::to_string(simulator.configuration().position);
    }
    frames.add(simulator.history().empty() ? 0 : simulator.history().back().time,
               drawn_curve(discretization, simulator.shape()));
    deviation = std::max(deviation, flow_rate_deviation(simulator, options.flow_rate));

    nlohmann::ordered_json summary;
    summary["passed"] = passed;
    if (entered_or_left.size() == 2) {
        summary["transit_time"] = entered_or_left[1] - entered_or_left[0];
        // Of the fluid alone, at the mean velocity of each section.
        constexpr Index samples = 2000;
        const Vector<double> z = Vector<double>::LinSpaced(samples, profile.begin(), profile.end());
        const double section = wall_radii(profile, z).array().square().mean() * std::acos(-1.0);
        summary["transit_time_of_fluid"] = section * (profile.end() - profile.begin()) / options.flow_rate;
    }
    summary["smallest_film"] = film;
    summary["largest_pressure_drop"] = drop;
    summary["critical_tube_radius"] = axistokes::critical_tube_radius(measures.area, measures.volume);
    summary["critical_orifice_radius"] = axistokes::critical_orifice_radius(measures.area, measures.volume);
    if (!simulator.history().empty()) {
        const auto& last = simulator.history().back();
        summary["area_drift"] = last.area_drift;
        summary["volume_drift"] = last.volume_drift;
        summary["steps"] = last.step;
        summary["time"] = last.time;
    }
    summary["elements"] = simulator.configuration().shape.elements();
    options.method.describe(summary);
    if constexpr (spectral) {
        // Largest on the way, of the shape; the time steps' errors come on top.
        summary["error_estimate"] = unresolved / axistokes::Accuracy<double>::unresolved_to_error;
        if (accuracy) {
            summary["error_met"] = unresolved / axistokes::Accuracy<double>::unresolved_to_error <= accuracy->eps;
        }
    }
    summary["flow_rate_deviation"] = deviation;
    summary["wall_nodes"] = simulator.scene().wall().mesh()->curve().size();
    summary["wall_meshes"] = simulator.scene().wall().meshes();
    summary["wall_seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!failure.empty()) {
        summary["failure"] = failure;
    }
    summary["parameters"] = options.parameters();
    if (!options.directory.empty()) {
        const std::filesystem::path directory(options.directory);
        const Vector<double> z = Vector<double>::LinSpaced(400, 1.5 * start, -1.5 * start);
        axistokes::write_csv(directory / "frames.csv", frames.columns());
        axistokes::write_csv(directory / "wall.csv",
                             std::vector<axistokes::Column<double>>{{"z", z}, {"r", wall_radii(profile, z)}});
        axistokes::write_csv(directory / "history.csv", axistokes::history_columns(simulator.history()));
        axistokes::write_atomically(directory / "summary.json",
                                    [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
    }
    std::cout << (passed ? "passed\n" : "not passed\n") << std::setprecision(8);
    for (const auto& [key, value] : summary.items()) {
        if (value.is_number()) {
            std::cout << "  " << std::left << std::setw(24) << key << value << '\n';
        }
    }
    if (!failure.empty()) {
        throw axistokes::SimulationFailure(failure);
    }
    return passed ? success : interrupted;
}

}  // namespace examples
