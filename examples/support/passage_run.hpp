// SPDX-License-Identifier: MIT
// Follows a vesicle through a channel and writes what came of it.
#pragma once

#include "compiled.hpp"
#include "exit_code.hpp"
#include "frames.hpp"
#include "last_shape.hpp"
#include "neck.hpp"
#include "passage_case.hpp"
#include "progress.hpp"
#include <axistokes/accuracy/resolution.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/geometry/shapes.hpp>
#include <axistokes/io/csv.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/wall/passage.hpp>
#include <axistokes/wall/wall_mesh.hpp>

#include <boost/math/interpolators/barycentric_rational.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace examples {

using axistokes::Index;
using axistokes::Meridian;
using axistokes::Vector;

template <class Discretization>
using Passage = axistokes::Simulator<axistokes::FreeSpaceKernel<double>, Discretization, axistokes::Vesicle<double>,
                                     axistokes::Quiescent<double>, axistokes::ExtrapolatedEulerOfOrder,
                                     axistokes::DenseLU<double>, axistokes::WallMesh<Channel>>;

/// Largest relative deviation of the flow rate through sections all along the channel.
template <class Discretization>
double flow_rate_deviation(const Passage<Discretization>& simulator,
                           const typename Passage<Discretization>::InstantType& instant, double flow_rate) {
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

/// Where the vesicle was when: its foremost and rearmost points.
class Track {
  public:
    void add(double time, const Meridian<double>& shape) {
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

template <class Discretization>
class PassageRun {
    using Instant = typename Passage<Discretization>::InstantType;
    static constexpr bool spectral = axistokes::JudgesItself<Discretization>;
    static constexpr double unresolved_to_error = axistokes::Accuracy<double>::unresolved_to_error;

  public:
    explicit PassageRun(const PassageOptions& options)
        : options_(options),
          profile_(options.channel()),
          accuracy_(*options.method.accuracy()),
          discretization_(axistokes::discretization_for<Discretization>(options.method.accuracy())) {
        Meridian<double> shape = initial_shape();
        measures_ = discretization_.measures(shape);
        axistokes::require_passage(profile_, measures_.area, measures_.volume);
        // It starts a radius upstream of where the channel begins to narrow, and ends as far downstream.
        start_ = profile_.begin() - options.wide - shape.z.maxCoeff();
        shape.z.array() += start_;
        axistokes::WallMeshParams<double> wall;
        wall.flow_rate = options.flow_rate;
        wall.tolerance = options.tolerance();
        axistokes::SimulationParams<double> params;
        params.largest_displacement = options.displacement;
        params.step_tolerance = options.step_tolerance.value_or(accuracy_.step);
        simulator_.emplace(shape, axistokes::Quiescent<double>{}, params, axistokes::FreeSpaceKernel<double>{},
                           discretization_, axistokes::Vesicle<double>{}, options.method.steps(params.step_tolerance),
                           axistokes::DenseLU<double>{}, axistokes::WallMesh<Channel>(profile_, wall));
    }

    int operator()() {
        if (!options_.directory.empty()) {
            axistokes::create_output_directory(options_.directory);
        }
        const auto begin = std::chrono::steady_clock::now();
        {
            const InterruptGuard guard;
            ProgressBar bar;
            try {
                advance(guard, bar);
            } catch (const axistokes::SimulationFailure& error) {
                failure_ = error.what();
            }
        }
        keep_last();
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return conclude();
    }

  private:
    Meridian<double> initial_shape() const {
        const auto spheroid = [&](Index elements) {
            return axistokes::spheroid_of_excess_area<double>(options_.excess_area, axistokes::SpheroidKind::prolate,
                                                              elements);
        };
        return options_.elements
                   ? axistokes::nodes_of(discretization_, spheroid, *options_.elements)
                   : axistokes::resolved_nodes(discretization_, spheroid, spectral ? 48 : 80, accuracy_.unresolved);
    }

    double time() const { return simulator_->history().empty() ? 0 : simulator_->history().back().time; }
    double position() const { return simulator_->configuration().position; }

    void advance(const InterruptGuard& guard, ProgressBar& bar) {
        Index kept = 0;
        track_.add(0, simulator_->shape());
        while (position() < -start_ && !guard.interrupted()) {
            if (static_cast<Index>(simulator_->history().size()) >= options_.most_steps) {
                throw axistokes::SimulationFailure("not through after " + std::to_string(options_.most_steps) +
                                                   " steps: the centroid is at z = " + std::to_string(position()));
            }
            const double way = (position() - start_) / (-2 * start_);
            if (way * static_cast<double>(options_.frames - 1) >= static_cast<double>(kept)) {
                keep_frame(simulator_->instant());
                ++kept;
            }
            const auto record = simulator_->step();
            resolve();
            track_.add(record.time, simulator_->shape());
            film_ = std::min(film_, record.film_thickness_min);
            drop_ = std::max(drop_, record.pressure_drop);
            require_passable(record.velocity);
            std::ostringstream text;
            text << "step " << record.step << "  z " << record.position << "  film " << record.film_thickness_min;
            bar.show(way, text.str());
        }
        passed_ = position() >= -start_;
    }

    /// `instant`: nothing for a shape that has no velocities and forces, having caused a failure.
    void keep_frame(const std::optional<Instant>& instant) {
        frames_.add(time(), drawn_curve(discretization_, simulator_->shape()));
        if (instant) {
            deviation_ = std::max(deviation_, flow_rate_deviation(*simulator_, *instant, options_.flow_rate));
        }
    }

    void keep_last() {
        std::optional<Instant> instant;
        try {
            instant = simulator_->instant();
        } catch (const axistokes::SimulationFailure& error) {
            failure_ = failure_.empty() ? error.what() : failure_;
        }
        keep_frame(instant);
        shape_ = last_shape_columns(simulator_->configuration(), instant);
    }

    /// More modes as soon as the shape needs them.
    void resolve() {
        if constexpr (spectral) {
            const Meridian<double>& now = simulator_->configuration().shape;
            double share = discretization_.unresolved(now);
            if (!options_.elements && now.elements() < axistokes::most_elements<Discretization> &&
                share > accuracy_.unresolved) {
                simulator_->refine(axistokes::more_modes(now.elements(), share, accuracy_.unresolved,
                                                         axistokes::most_elements<Discretization>));
                share = discretization_.unresolved(now);
            }
            unresolved_ = std::max(unresolved_, share);
        }
    }

    /// Throws SimulationFailure for a vesicle that does not move on, or whose membrane is about to pinch off.
    void require_passable(double velocity) const {
        constexpr double stuck = 1e-4;  // velocity over that of the flow in the throat
        if (std::abs(velocity) < stuck * simulator_->scene().velocity_scale()) {
            throw axistokes::SimulationFailure("the vesicle is stuck at z = " + std::to_string(position()) +
                                               ": this flow rate does not press it through the throat");
        }
        const auto neck = thinnest_neck(simulator_->shape());
        if (neck && neck->radius < neck->element / 2) {
            std::ostringstream cause;
            cause << "the membrane pinches off at z = " << neck->z << ": the radius of its neck, " << neck->radius
                  << ", is less than half of an element there";
            throw axistokes::SimulationFailure(cause.str());
        }
    }

    nlohmann::ordered_json summary() const {
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
        summary["smallest_film"] = film_;
        summary["largest_pressure_drop"] = drop_;
        summary["critical_tube_radius"] = axistokes::critical_tube_radius(measures_.area, measures_.volume);
        summary["critical_orifice_radius"] = axistokes::critical_orifice_radius(measures_.area, measures_.volume);
        if (!simulator_->history().empty()) {
            const auto& last = simulator_->history().back();
            summary["area_drift"] = last.area_drift;
            summary["volume_drift"] = last.volume_drift;
            summary["steps"] = last.step;
            summary["time"] = last.time;
        }
        summary["elements"] = simulator_->configuration().shape.elements();
        options_.method.describe(summary);
        if constexpr (spectral) {
            // Largest on the way, of the shape; the time steps' errors come on top.
            const double error = unresolved_ / unresolved_to_error;
            summary["error_estimate"] = error;
            summary["error_met"] = error <= accuracy_.eps;
        }
        summary["flow_rate_deviation"] = deviation_;
        summary["wall_nodes"] = simulator_->scene().wall().mesh()->curve().size();
        summary["wall_meshes"] = simulator_->scene().wall().meshes();
        summary["wall_seconds"] = seconds_;
        if (!failure_.empty()) {
            summary["failure"] = failure_;
        }
        summary["parameters"] = options_.parameters();
        return summary;
    }

    void write(const nlohmann::ordered_json& summary) const {
        const std::filesystem::path directory(options_.directory);
        const Vector<double> z = Vector<double>::LinSpaced(400, 1.5 * start_, -1.5 * start_);
        axistokes::write_csv(directory / "frames.csv", frames_.columns());
        axistokes::write_csv(directory / "wall.csv",
                             std::vector<axistokes::Column<double>>{{"z", z}, {"r", wall_radii(profile_, z)}});
        axistokes::write_csv(directory / "shape.csv", shape_);
        axistokes::write_csv(directory / "history.csv", axistokes::history_columns(simulator_->history()));
        axistokes::write_atomically(directory / "summary.json",
                                    [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
    }

    int conclude() const {
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
        if (!failure_.empty()) {
            throw axistokes::SimulationFailure(failure_);
        }
        return passed_ ? success : interrupted;
    }

    PassageOptions options_;
    Channel profile_;
    axistokes::Accuracy<double> accuracy_;
    Discretization discretization_;
    axistokes::Measures<double> measures_;
    double start_ = 0;  // of the centroid
    std::optional<Passage<Discretization>> simulator_;
    Frames frames_;
    std::vector<axistokes::Column<double>> shape_;  // the last one
    Track track_;
    double film_ = std::numeric_limits<double>::infinity();
    double drop_ = 0;
    double deviation_ = 0;   // of the flow rate
    double unresolved_ = 0;  // largest share of the last modes
    double seconds_ = 0;
    std::string failure_;
    bool passed_ = false;
};

}  // namespace examples
