// SPDX-License-Identifier: MIT
// A vesicle is carried through a channel that narrows to less than its rest radius.
#include "support/frames.hpp"
#include "support/neck.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"
#include <axistokes/axistokes.hpp>
#include <axistokes/io/csv.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace axistokes;

struct Options {
    std::string profile = "constriction";
    double throat = 0.8;
    double wide = 1.5;
    double length = 2;
    double transition = 2;
    double excess_area = 2;
    double flow_rate = 10;
    double tolerance = 1e-4;
    double displacement = 0.01;
    Index elements = 80;
    Index most_steps = 5000;
    Index frames = 9;
    std::string directory;

    void add_to(CLI::App& app) {
        using examples::add_number;
        app.add_option("--profile", profile, "constriction (smooth) or pore (a straight throat)")
            ->capture_default_str();
        add_number(app, "--throat", throat, "radius of the throat, in R0");
        add_number(app, "--wide", wide, "radius of the channel on either side");
        add_number(app, "--length", length, "length of a pore's throat");
        add_number(app, "--transition", transition, "length of the narrowing, and of the widening behind");
        add_number(app, "--excess-area", excess_area, "area of the membrane minus 4 pi, in R0^2");
        add_number(app, "--flow-rate", flow_rate, "flow rate, in R0 kappa/eta, > 0");
        add_number(app, "--tolerance", tolerance, "relative error allowed of the wall");
        add_number(app, "--displacement", displacement, "largest normal displacement in a time step, in R0");
        add_number(app, "--elements", elements, "elements on the meridian");
        add_number(app, "--max-steps", most_steps, "give up after this many steps");
        add_number(app, "--frames", frames, "shapes to keep, evenly along the way");
        app.add_option("--out", directory, "directory for summary.json, history.csv, frames.csv and wall.csv");
    }

    nlohmann::ordered_json parameters() const {
        return {{"profile", profile},
                {"throat", throat},
                {"wide", wide},
                {"length", length},
                {"transition", transition},
                {"flow_rate", flow_rate},
                {"tolerance", tolerance},
                {"elements", elements},
                {"excess_area", excess_area},
                {"displacement", displacement}};
    }
};

template <class Profile>
using Passage = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Quiescent<double>,
                          SemiImplicitEuler, DenseLU<double>, WallMesh<Profile>>;

/// Largest relative deviation of the flow rate through sections all along the channel.
template <class Profile>
double flow_rate_deviation(Passage<Profile>& simulator, double flow_rate) {
    const auto instant = simulator.instant();
    WallMesh<Profile> wall = simulator.scene().wall();
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

template <class Profile>
Vector<double> wall_radii(const Profile& profile, const Vector<double>& z) {
    Vector<double> r(z.size());
    for (Index i = 0; i < z.size(); ++i) {
        r[i] = ChannelMesh<Profile>::channel_radius(profile, z[i]);
    }
    return r;
}

template <class Profile>
int run(const Options& options, const Profile& profile) {
    detail::require(options.flow_rate > 0, "flow rate", options.flow_rate, "> 0");
    detail::require(options.frames >= 2, "number of frames", options.frames, "at least 2");
    Meridian<double> shape =
        spheroid_of_excess_area<double>(options.excess_area, SpheroidKind::prolate, options.elements);
    const Measures<double> measures = MeridianSpline<double>(shape).measures();
    require_passage(profile, measures.area, measures.volume);

    // The vesicle starts a radius upstream of where the channel begins to narrow, and ends as far downstream.
    const double start = profile.begin() - options.wide - shape.z.maxCoeff();
    shape.z.array() += start;
    WallMeshParams<double> wall;
    wall.flow_rate = options.flow_rate;
    wall.tolerance = options.tolerance;
    SimulationParams<double> params;
    params.largest_displacement = options.displacement;
    Passage<Profile> simulator(shape, {}, params, {}, LinearElements<double>{}, {}, {}, {},
                               WallMesh<Profile>(profile, wall));
    if (!options.directory.empty()) {
        create_output_directory(options.directory);
    }

    examples::Frames frames;
    std::vector<double> entered_or_left;
    double film = std::numeric_limits<double>::infinity();
    double drop = 0;
    double deviation = 0;
    std::string failure;
    bool passed = false;
    bool interrupted = false;
    constexpr double stuck = 1e-4;  // velocity over that of the flow in the throat
    const auto begin = std::chrono::steady_clock::now();
    {
        const examples::InterruptGuard guard;
        examples::ProgressBar bar;
        Index kept = 0;
        try {
            for (Index step = 0; step < options.most_steps && !passed && !guard.interrupted(); ++step) {
                const double position = simulator.configuration().position;
                const double way = (position - start) / (-2 * start);
                const double time = simulator.history().empty() ? 0 : simulator.history().back().time;
                if (way * static_cast<double>(options.frames - 1) >= static_cast<double>(kept)) {
                    frames.add(time, simulator.shape());
                    deviation = std::max(deviation, flow_rate_deviation(simulator, options.flow_rate));
                    ++kept;
                }
                const auto& record = simulator.step();
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
                    throw SimulationFailure("the vesicle is stuck at z = " + std::to_string(record.position) +
                                            ": this flow rate does not press it through the throat");
                }
                const auto neck = examples::thinnest_neck(now);
                if (neck && neck->radius < neck->element / 2) {
                    std::ostringstream cause;
                    cause << "the membrane pinches off at z = " << neck->z << ": the radius of its neck, "
                          << neck->radius << ", is less than half of an element there";
                    throw SimulationFailure(cause.str());
                }
                std::ostringstream text;
                text << "step " << record.step << "  z " << record.position << "  film " << record.film_thickness_min;
                bar.show(way, text.str());
            }
        } catch (const SimulationFailure& error) {
            failure = error.what();
        }
        interrupted = guard.interrupted();
    }
    if (!passed && !interrupted && failure.empty()) {
        failure = "not through after " + std::to_string(options.most_steps) +
                  " steps: the centroid is at z = " + std::to_string(simulator.configuration().position);
    }
    frames.add(simulator.history().empty() ? 0 : simulator.history().back().time, simulator.shape());
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
    summary["critical_tube_radius"] = critical_tube_radius(measures.area, measures.volume);
    summary["critical_orifice_radius"] = critical_orifice_radius(measures.area, measures.volume);
    if (!simulator.history().empty()) {
        const auto& last = simulator.history().back();
        summary["area_drift"] = last.area_drift;
        summary["volume_drift"] = last.volume_drift;
        summary["steps"] = last.step;
        summary["time"] = last.time;
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
        write_csv(directory / "frames.csv", frames.columns());
        write_csv(directory / "wall.csv", std::vector<Column<double>>{{"z", z}, {"r", wall_radii(profile, z)}});
        write_csv(directory / "history.csv", history_columns(simulator.history()));
        write_atomically(directory / "summary.json", [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
    }
    std::cout << (passed ? "passed\n" : "not passed\n") << std::setprecision(8);
    for (const auto& [key, value] : summary.items()) {
        if (value.is_number()) {
            std::cout << "  " << std::left << std::setw(24) << key << value << '\n';
        }
    }
    if (!failure.empty()) {
        throw SimulationFailure(failure);
    }
    return passed ? examples::success : examples::interrupted;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"A vesicle is carried through a channel that narrows to less than its rest radius"};
    Options options;
    options.add_to(app);
    return examples::run_program("vesicle_through_constriction", app, argc, argv, [&] {
        detail::require(options.profile == "constriction" || options.profile == "pore", "profile", options.profile,
                        "constriction or pore");
        if (options.profile == "pore") {
            return run(options, Pore<double>(options.throat, options.wide, options.length, options.transition));
        }
        return run(options, Constriction<double>(options.throat, options.wide, options.transition));
    });
}
