// SPDX-License-Identifier: MIT
// Follows a vesicle through a channel and writes what came of it.
#include "../support/passage_case.hpp"
#include "../support/progress.hpp"
#include "../support/results.hpp"
#include <axistokes/geometry/necks.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/io/csv.hpp>
#include <axistokes/wall/passage.hpp>

#include <boost/math/interpolators/barycentric_rational.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace examples {

namespace {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::Vector;

/// Largest relative deviation of the flow rate through sections all along the channel.
double flow_rate_deviation(const Simulation& simulation, const Simulation::InstantType& instant, double flow_rate) {
    AnyWall wall = simulation.scene().wall();
    const AnyField field = wall.field(simulation.scene().discretization(), simulation.scene().kernel(),
                                      simulation.shape(), instant.solution.force);
    const AnyWall::Mesh& mesh = *wall.mesh();
    constexpr int sections = 9;
    double largest = 0;
    for (int i = 0; i < sections; ++i) {
        const double begin = mesh.profile().begin();
        const double z = begin + (mesh.profile().end() - begin) * (i + 0.5) / sections;
        largest = std::max(largest, std::abs(field.flow_rate(z, mesh.radius(z)) / flow_rate - 1));
    }
    return largest;
}

Vector<double> wall_radii(const Channel& profile, const Vector<double>& z) {
    Vector<double> r(z.size());
    for (Index i = 0; i < z.size(); ++i) {
        r[i] = axistokes::ChannelMesh<Channel>::channel_radius(profile, z[i]);
    }
    return r;
}

/// Where the vesicle was when: its foremost and rearmost points.
class Track {
  public:
    /// Of a run that begins anew, or is looked at again, only the last word counts.
    void add(double time, const Meridian<double>& shape) {
        while (!time_.empty() && time_.back() >= time) {
            time_.pop_back();
            front_.pop_back();
            rear_.pop_back();
        }
        time_.push_back(time);
        front_.push_back(largest(shape.z));
        rear_.push_back(-largest(-shape.z));
    }

    /// From the front at `begin` to the rear at `end`; nothing if it did not get there.
    std::optional<double> time_between(double begin, double end) const {
        const auto entered = first_beyond(begin, front_);
        const auto left = first_beyond(end, rear_);
        if (!entered || !left) {
            return std::nullopt;
        }
        return *left - *entered;
    }

  private:
    /// Between the nodes too, by the parabola through three of them. At the poles the curve is level.
    static double largest(const Vector<double>& z) {
        Index i = 0;
        const double top = z.maxCoeff(&i);
        if (i == 0 || i + 1 == z.size()) {
            return top;
        }
        const double slope = (z[i + 1] - z[i - 1]) / 2;
        const double curvature = z[i + 1] - 2 * z[i] + z[i - 1];
        return curvature < 0 ? top - slope * slope / (2 * curvature) : top;
    }

    /// When `z` first passes `mark`: by the cubic polynomial through the two instants before and the two after.
    std::optional<double> first_beyond(double mark, const std::vector<double>& z) const {
        const auto after = std::find_if(z.begin(), z.end(), [&](double now) { return now > mark; }) - z.begin();
        const auto count = static_cast<std::ptrdiff_t>(z.size());
        constexpr std::ptrdiff_t points = 4;
        if (after == 0 || after == count || count < points) {
            return std::nullopt;
        }
        const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(after - points / 2, 0, count - points);
        const boost::math::barycentric_rational<double> position(time_.data() + first, z.data() + first, points,
                                                                 points - 1);
        const auto crossing = boost::math::tools::bisect(
            [&](double time) { return position(time) - mark; }, time_[static_cast<std::size_t>(after - 1)],
            time_[static_cast<std::size_t>(after)], boost::math::tools::eps_tolerance<double>());
        return crossing.first;
    }

    std::vector<double> time_, front_, rear_;
};

class PassageRun {
    using Instant = Simulation::InstantType;
    static constexpr double unresolved_to_error = axistokes::Accuracy<double>::unresolved_to_error;

  public:
    explicit PassageRun(const PassageOptions& options)
        : options_(options),
          profile_(options.channel()),
          accuracy_(*options.method.accuracy()),
          discretization_(discretization_for(options.method)) {
        const Meridian<double> shape = initial_shape(first_elements());
        measures_ = discretization_.measures(shape);
        axistokes::require_passage(profile_, measures_.area, measures_.volume);
        // It starts a radius upstream of where the channel begins to narrow, and ends as far downstream.
        start_ = profile_.begin() - options.wide - shape.z.maxCoeff();
        axistokes::DriverParams<double> params;
        params.eps = accuracy_.eps;
        params.unresolved = accuracy_.unresolved;
        params.transient = true;
        params.first_elements = first_elements();
        if (options.elements || !spectral()) {
            params.elements = first_elements();
        }
        driver_.emplace([this](Index elements) { return simulation(elements); }, params,
                        [this](const Simulation&) { return observe(); });
    }

    int operator()() {
        journal_ = options_.checkpoints.journal(options_.directory);
        now().record_in(journal_);
        const auto begin = std::chrono::steady_clock::now();
        {
            const InterruptGuard guard;
            ProgressBar bar;
            guard_ = &guard;
            bar_ = &bar;
            try {
                advance();
            } catch (const axistokes::SimulationFailure& error) {
                failure_ = error.what();
            } catch (const axistokes::OutputError& error) {
                failure_ = error.what();
                unrecorded_ = std::current_exception();
            } catch (const axistokes::SimulationStopped&) {
                // Not even the first instant is known.
            }
        }
        keep_last();
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return conclude();
    }

  private:
    bool spectral() const { return discretization_.judges_itself(); }
    Index first_elements() const { return options_.elements.value_or(spectral() ? 48 : 80); }

    Meridian<double> initial_shape(Index elements) const {
        const auto shape = [&](Index count) {
            return axistokes::shape_in_tube<double>(options_.excess_area, options_.wide,
                                                    axistokes::SpheroidKind::prolate, count);
        };
        return options_.elements ? axistokes::nodes_of(discretization_, shape, elements)
                                 : axistokes::resolved_nodes(discretization_, shape, elements, accuracy_.unresolved);
    }

    Simulation simulation(Index elements) const {
        Meridian<double> shape = initial_shape(elements);
        shape.z.array() += start_;
        axistokes::WallMeshParams<double> wall;
        wall.flow_rate = options_.flow_rate;
        wall.tolerance = options_.tolerance();
        axistokes::SimulationParams<double> params;
        params.largest_displacement = options_.displacement;
        params.step_tolerance = options_.step_tolerance.value_or(accuracy_.step);
        params.most_steps = options_.most_steps;
        params.referee = !options_.method.no_referee;
        params.proceed = [] { return !InterruptGuard::interrupted(); };
        Simulation simulation(
            Scene(OptionalTubeKernel(OptionalTubeImages()), discretization_, Law(Vesicle()),
                  Drive(axistokes::Quiescent<double>()), Solver(), AnyWall(AnyWall::Mesh(profile_, wall))),
            options_.method.steps(params.step_tolerance), shape, params);
        simulation.record_in(journal_);
        return simulation;
    }

    Simulation& now() { return driver_->simulation(); }
    double position() { return now().configuration().position; }
    double way() { return (position() - start_) / (-2 * start_); }

    void advance() {
        track_.add(0, now().shape());
        keep_frame(now().instant());
        driver_->run();
        passed_ = position() >= -start_;
        if (!passed_ && failure_.empty() && !guard_->interrupted()) {
            failure_ = "not through after " + std::to_string(options_.most_steps) +
                       " steps: the centroid is at z = " + std::to_string(position());
        }
    }

    /// After every step; whether to go on.
    bool observe() {
        Simulation& simulation = now();
        const auto& record = simulation.history().back();
        track_.add(record.time, simulation.shape());
        film_ = std::min(film_, record.film_thickness_min);
        drop_ = std::max(drop_, record.pressure_drop);
        const double share = discretization_.unresolved(simulation.configuration().shape);
        const bool refines = !options_.elements && share > accuracy_.unresolved &&
                             simulation.configuration().shape.elements() < axistokes::most_elements(discretization_);
        unresolved_ = refines ? unresolved_ : std::max(unresolved_, share);
        if (way() * static_cast<double>(options_.frames - 1) >= static_cast<double>(kept_)) {
            keep_frame(simulation.instant());
        }
        std::ostringstream text;
        text << "step " << record.step << "  z " << record.position << "  film " << record.film_thickness_min;
        bar_->show(way(), text.str());
        failure_ = obstacle(record.velocity);
        return failure_.empty() && position() < -start_ && !guard_->interrupted();
    }

    /// `instant`: nothing for a shape that has no velocities and forces, having caused a failure.
    void keep_frame(const std::optional<Instant>& instant) {
        frames_.add(now().time(), drawn_curve(discretization_, now().shape()));
        ++kept_;
        if (instant) {
            deviation_ = std::max(deviation_, flow_rate_deviation(now(), *instant, options_.flow_rate));
        }
    }

    void keep_last() {
        std::optional<Instant> instant;
        try {
            instant = now().instant();
        } catch (const axistokes::SimulationFailure& error) {
            failure_ = failure_.empty() ? error.what() : failure_;
        } catch (const axistokes::SimulationStopped&) {
            // Then not this one either.
        }
        keep_frame(instant);
        shape_ = last_shape_columns(now().configuration(), instant ? &*instant : nullptr);
    }

    /// Why a vesicle does not move on, or that its membrane is about to pinch off; empty if it does.
    std::string obstacle(double velocity) {
        std::ostringstream cause;
        constexpr double stuck = 1e-4;  // velocity over that of the flow in the throat
        if (std::abs(velocity) < stuck * now().scene().velocity_scale()) {
            cause << "the vesicle is stuck at z = " << position()
                  << ": this flow rate does not press it through the throat";
        } else if (const auto neck = axistokes::thinnest_neck(now().shape());
                   neck && neck->radius < neck->element / 2) {
            cause << "the membrane pinches off at z = " << neck->z << ": the radius of its neck, " << neck->radius
                  << ", is less than half of an element there";
        }
        return cause.str();
    }

    /// Whether it was stopped on the way.
    bool unfinished() const { return !passed_ && (failure_.empty() || unrecorded_); }

    nlohmann::ordered_json summary() {
        nlohmann::ordered_json summary;
        summary["passed"] = passed_;
        if (const auto transit = track_.time_between(profile_.begin(), profile_.end())) {
            summary["transit_time"] = *transit;
            // Of the fluid alone, at the mean velocity of each section.
            constexpr Index samples = 2000;
            const Vector<double> z = Vector<double>::LinSpaced(samples, profile_.begin(), profile_.end());
            const double section = wall_radii(profile_, z).array().square().mean() * std::numbers::pi;
            summary["transit_time_of_fluid"] = section * (profile_.end() - profile_.begin()) / options_.flow_rate;
        }
        if (std::isfinite(film_)) {
            summary["smallest_film"] = film_;  // unless there was no step
        }
        summary["largest_pressure_drop"] = drop_;
        summary["critical_tube_radius"] = axistokes::critical_tube_radius(measures_.area, measures_.volume);
        summary["critical_orifice_radius"] = axistokes::critical_orifice_radius(measures_.area, measures_.volume);
        if (!now().history().empty()) {
            const auto& last = now().history().back();
            summary["area_drift"] = last.area_drift;
            summary["volume_drift"] = last.volume_drift;
            summary["steps"] = last.step;
            summary["time"] = last.time;
        }
        summary["elements"] = now().configuration().shape.elements();
        options_.method.describe(summary);
        if (spectral()) {
            // Largest on the way, of the shape; the time steps' errors come on top.
            const double error = unresolved_ / unresolved_to_error;
            summary["error_estimate"] = error;
            summary["error_met"] = error <= accuracy_.eps;
        }
        summary["flow_rate_deviation"] = deviation_;
        const AnyWall::Mesh& wall = *now().scene().wall().mesh();
        summary["wall_nodes"] = wall.mesh()->curve().size();
        summary["wall_meshes"] = wall.meshes();
        summary["wall_seconds"] = seconds_;
        if (!failure_.empty()) {
            summary["failure"] = failure_;
        }
        if (unfinished()) {
            summary["interrupted"] = true;
        }
        summary["parameters"] = options_.parameters();
        return summary;
    }

    void write(const nlohmann::ordered_json& summary) {
        const std::filesystem::path directory(options_.directory);
        const Vector<double> z = Vector<double>::LinSpaced(400, 1.5 * start_, -1.5 * start_);
        axistokes::write_csv(directory / "frames.csv", frames_.columns());
        axistokes::write_csv(directory / "wall.csv",
                             std::vector<axistokes::Column<double>>{{"z", z}, {"r", wall_radii(profile_, z)}});
        axistokes::write_csv(directory / "shape.csv", shape_);
        axistokes::write_csv(directory / "history.csv", axistokes::history_columns(now().history()));
        axistokes::write_atomically(directory / "summary.json",
                                    [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
    }

    int conclude() {
        const nlohmann::ordered_json results = summary();
        if (!options_.directory.empty()) {
            write(results);
        }
        std::cout << (passed_ ? "passed\n" : "not passed\n") << std::setprecision(8);
        for (const auto& [key, value] : results.items()) {
            if (value.is_number()) {
                std::cout << "  " << std::left << std::setw(24) << key << value << '\n';
            }
        }
        std::exception_ptr error = unrecorded_;
        if (!error && !failure_.empty()) {
            error = std::make_exception_ptr(axistokes::SimulationFailure(failure_));
        }
        return finish(unfinished(), error, journal_.get());
    }

    PassageOptions options_;
    Channel profile_;
    axistokes::Accuracy<double> accuracy_;
    AnyDiscretization discretization_;
    axistokes::Measures<double> measures_;
    double start_ = 0;                  // of the centroid
    std::shared_ptr<Journal> journal_;  // from the first step on
    std::optional<Driver> driver_;
    const InterruptGuard* guard_ = nullptr;
    ProgressBar* bar_ = nullptr;
    Index kept_ = 0;  // frames
    Frames frames_;
    std::vector<axistokes::Column<double>> shape_;  // the last one
    Track track_;
    double film_ = std::numeric_limits<double>::infinity();
    double drop_ = 0;
    double deviation_ = 0;   // of the flow rate
    double unresolved_ = 0;  // largest share of the last modes
    double seconds_ = 0;
    std::string failure_;
    std::exception_ptr unrecorded_;  // why a step could not be recorded
    bool passed_ = false;
};

}  // namespace

int pass(const PassageOptions& options) {
    return PassageRun(options)();
}

}  // namespace examples
