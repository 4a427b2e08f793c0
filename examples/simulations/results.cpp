// SPDX-License-Identifier: MIT
#include "../support/results.hpp"

#include "../support/exit_code.hpp"
#include <axistokes/io/vtk.hpp>
#include <axistokes/io/wall_stress.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <numbers>
#include <vector>

namespace examples {

Ending run_to_the_end(Driver& driver, std::chrono::steady_clock::time_point begin) {
    Ending ending;
    bool recorded = true;
    const auto keep = [&](const std::exception& error) {
        ending.failure = error.what();
        ending.error = std::current_exception();
    };
    try {
        driver.run();
    } catch (const axistokes::SimulationFailure& failure) {
        keep(failure);
    } catch (const axistokes::OutputError& error) {
        keep(error);
        recorded = false;
    }
    ending.result = driver.result();
    ending.result.interrupted = ending.result.interrupted || !recorded;
    ending.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return ending;
}

double wall_error(const Simulation& simulation, const Driver::Result& result, const Surroundings& surroundings) {
    if (!surroundings.wall || !result.instant()) {
        return 0;
    }
    Surroundings finer = surroundings;
    // Not a mesh of twice the given length and panels: far from convergence that may change little.
    finer.wall->tolerance /= 10;
    finer.wall->panels.reset();
    finer.wall->length.reset();
    finer.wall->grading = axistokes::WallGrading::automatic;
    const Scene& scene = simulation.scene();
    try {
        Scene other(scene.kernel(), scene.discretization(), scene.laws(), scene.flow(), Solver(), wall_for(finer));
        const double exact = other.evaluate(result.bodies, 0.0).front().velocity;
        return std::abs(*result.velocity - exact) / std::abs(exact);
    } catch (const axistokes::SimulationFailure&) {
        return std::numeric_limits<double>::infinity();
    }
}

std::vector<axistokes::Column<double>> last_shape_columns(const axistokes::Configuration<double>& configuration,
                                                          const Simulation::InstantType* instant) {
    if (instant) {
        return axistokes::shape_columns(configuration, *instant);
    }
    return {{"r", configuration.shape.r}, {"z", configuration.shape.z}};
}

void describe_ending(const Ending& ending, nlohmann::ordered_json& summary) {
    const auto& result = ending.result;
    summary["error_estimate"] = std::isfinite(result.error_estimate) ? nlohmann::ordered_json(result.error_estimate)
                                                                     : nlohmann::ordered_json(nullptr);
    summary["error_met"] = result.error_met();
    summary["accuracy"] = result.eps;
    summary["power_mismatch"] = result.power_mismatch;
    summary["largest_power_mismatch"] = std::max(result.power_mismatch, result.largest_power_mismatch);
    if (!result.newton_failure.empty()) {
        summary["newton_failure"] = result.newton_failure;
    }
    if (!result.refinement_failure.empty()) {
        summary["refinement_failure"] = result.refinement_failure;
    }
    if (result.newton_iterations > 0) {
        summary["newton_iterations"] = result.newton_iterations;
        summary["newton_evaluations"] = result.newton_evaluations;
    }
    if (result.growth_rate) {
        summary["stable"] = *result.growth_rate < 0;
        summary["leading_growth_rate"] = *result.growth_rate;
        summary["stability_elements"] = result.stability_elements;
    }
    if (!ending.failure.empty()) {
        summary["failure"] = ending.failure;
    }
    if (result.interrupted) {
        summary["interrupted"] = true;
    }
}

nlohmann::ordered_json summarize(const Simulation& simulation, const Ending& ending) {
    const auto& result = ending.result;
    const auto& configuration = result.configuration();
    const auto& shape = configuration.shape;
    const auto& discretization = simulation.scene().discretization();
    const axistokes::Measures<double> measures = discretization.measures(shape);
    const auto [bottom, top] = discretization.pole_curvatures(shape);

    nlohmann::ordered_json summary;
    if (result.velocity) {
        summary["velocity"] = *result.velocity;
        summary["lag"] = *result.velocity - simulation.scene().centreline_velocity(configuration.position);
    }
    summary["length"] = shape.z[shape.nodes() - 1] - shape.z[0];
    summary["max_radius"] = discretization.max_radius(shape);
    summary["curvature_top"] = top;
    summary["curvature_bottom"] = bottom;
    summary["bending_energy"] = discretization.bending_energy(shape);
    summary["area"] = measures.area;
    summary["volume"] = measures.volume;
    summary["reduced_volume"] = measures.reduced_volume();
    summary["area_drift"] = measures.area / simulation.initial_area() - 1;
    summary["volume_drift"] = measures.volume / simulation.initial_volume() - 1;
    summary["stationary"] = result.stationary;
    summary["time"] = simulation.time();
    summary["steps"] = simulation.history().size();
    summary["elements"] = shape.elements();
    summary["wall_seconds"] = ending.wall_seconds;
    summary["position"] = configuration.position;
    if (result.residual) {
        summary["residual"] = *result.residual;
    }
    if (const auto* instant = result.instant(); instant && instant->solution.tension.size() > 0) {
        const auto tension = instant->surface.at_nodes(instant->solution.tension);
        summary["tension_min"] = tension.minCoeff();
        summary["tension_max"] = tension.maxCoeff();
    }
    describe_ending(ending, summary);
    return summary;
}

nlohmann::ordered_json tube_summary(const Simulation& simulation, const Ending& ending, double mean_velocity) {
    const auto& result = ending.result;
    const auto& shape = result.configuration().shape;
    const double position = result.configuration().position;
    const double radius = simulation.scene().gap({0, position});
    nlohmann::ordered_json summary{{"tube_radius", radius}, {"confinement", 1 / radius}};
    const auto film = simulation.scene().film_thickness(result.configuration());
    summary["film_thickness_min"] = film.min;
    summary["film_thickness_min_z"] = film.where - position;
    summary["film_thickness_mean"] = film.mean;
    if (const auto& wall = simulation.scene().wall().mesh(); wall && wall->mesh()) {
        summary["wall_panels"] = wall->mesh()->wall_panels();
        summary["wall_nodes"] = wall->mesh()->curve().size();
    }
    if (const auto* instant = result.instant()) {
        const double drop = instant->pressure_drop;
        summary["pressure_drop"] = drop;
        if (mean_velocity != 0) {
            const double volume = simulation.scene().discretization().measures(shape).volume;
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

void print(const nlohmann::ordered_json& summary, const std::string& directory) {
    const bool stationary = summary.at("stationary").get<bool>();
    const std::string state = summary.contains("failure")       ? "FAILED"
                              : summary.contains("interrupted") ? "interrupted"
                              : stationary                      ? "stationary"
                                                                : "not stationary";
    std::cout << state << " after " << summary.at("steps") << " steps, time " << std::setprecision(6)
              << summary.at("time").get<double>() << ", " << std::setprecision(2)
              << summary.at("wall_seconds").get<double>() << " s\n"
              << std::setprecision(8);
    for (const auto& [key, value] : summary.items()) {
        const bool shown = key != "stationary" && key != "steps" && key != "time" && key != "wall_seconds";
        if (shown && value.is_number()) {
            std::cout << "  " << std::left << std::setw(22) << key << std::right << std::setw(16);
            value.is_number_float() ? std::cout << value.get<double>() : std::cout << value;
            std::cout << '\n';
        }
    }
    if (!summary.value("error_met", true)) {
        std::cout << "  the accuracy is not met"
                  << (summary["error_estimate"].is_null() ? ", or there is no telling" : "") << '\n';
    }
    for (const char* failure : {"spectral_failure", "newton_failure", "refinement_failure"}) {
        if (summary.contains(failure)) {
            std::cout << "  " << failure << ": " << summary[failure].get<std::string>() << '\n';
        }
    }
    if (!directory.empty()) {
        std::cout << "written to " << directory << '\n';
    }
}

namespace {

void write_results(const Simulation& simulation, const Ending& ending, const RunOptions& options, const Frames& frames,
                   const nlohmann::ordered_json& summary) {
    if (options.directory.empty()) {
        return;
    }
    const std::filesystem::path directory(options.directory);
    const auto& configuration = ending.result.configuration();
    const auto* instant = ending.result.instant();
    const std::vector<axistokes::Column<double>> shape = last_shape_columns(configuration, instant);
    axistokes::write_csv(directory / "shape.csv", shape);
    axistokes::write_csv(directory / "history.csv", axistokes::history_columns(simulation.history()));
    if (!frames.empty()) {
        axistokes::write_csv(directory / "frames.csv", frames.columns());
    }
    if (instant && std::isfinite(simulation.scene().gap({0, configuration.position}))) {
        const double radius = simulation.scene().gap({0, configuration.position});
        const auto wall = axistokes::wall_stress(simulation.scene(), configuration, *instant, 3 * radius);
        axistokes::write_csv(directory / "wall.csv",
                             std::vector<axistokes::Column<double>>{
                                 {"z", wall.z}, {"shear_stress", wall.shear}, {"pressure", wall.pressure}});
    }
    if (options.vtk) {
        axistokes::write_vtk_surface(directory / "surface.vtp", shape);
    }
    if (options.flow_field && instant) {
        axistokes::write_vtk_flow(directory / "flow.vts",
                                  axistokes::flow_field(simulation.scene(), configuration, *instant),
                                  instant->velocity);
    }
    // Last: a summary means that the other files are there.
    axistokes::write_atomically(directory / "summary.json", [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
}

}  // namespace

int finish(bool unfinished, const std::exception_ptr& error, Journal* journal) {
    if (journal && unfinished) {
        journal->flush();
        std::cout << "to go on: --resume " << journal->path().parent_path().string() << '\n';
    } else if (journal) {
        journal->remove();
    }
    if (error) {
        std::rethrow_exception(error);
    }
    return unfinished ? interrupted : success;
}

int conclude(const Simulation& simulation, const Ending& ending, const RunOptions& options, const Frames& frames,
             const nlohmann::ordered_json& summary, Journal* journal) {
    write_results(simulation, ending, options, frames, summary);
    print(summary, options.directory);
    return finish(ending.result.interrupted, ending.error, journal);
}

}  // namespace examples
