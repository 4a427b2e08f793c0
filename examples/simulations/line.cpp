// SPDX-License-Identifier: MIT
// Follows bodies in line and writes what came of them.
#include "../support/line_case.hpp"
#include "../support/results.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace examples {

namespace {

/// Shapes of all bodies kept on the way, one row a node.
class LineFrames {
  public:
    void add(double time, std::size_t body, const axistokes::Meridian<double>& shape) {
        for (axistokes::Index i = 0; i < shape.nodes(); ++i) {
            const double row[] = {frame_, time, static_cast<double>(body), shape.r[i], shape.z[i]};
            for (std::size_t c = 0; c < columns_.size(); ++c) {
                columns_[c].push_back(row[c]);
            }
        }
    }
    void next() { ++frame_; }

    std::vector<axistokes::Column<double>> columns() const {
        static const char* const names[] = {"frame", "time", "body", "r", "z"};
        std::vector<axistokes::Column<double>> result;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            using axistokes::Vector;
            const auto size = static_cast<axistokes::Index>(columns_[c].size());
            result.push_back({names[c], Vector<double>(Eigen::Map<const Vector<double>>(columns_[c].data(), size))});
        }
        return result;
    }

  private:
    double frame_ = 0;
    std::vector<std::vector<double>> columns_ = std::vector<std::vector<double>>(5);
};

class LineRun {
  public:
    explicit LineRun(const LineCase& c)
        : case_(c), run_(c.run.resolved()), discretization_(discretization_for(run_.method)) {}

    int operator()() {
        const auto begin = std::chrono::steady_clock::now();
        const InterruptGuard guard;
        ProgressBar bar;
        const double duration = run_.time.value_or(0);
        Approach approach(run_.params().tolerance);
        Driver driver([&](axistokes::Index elements) { return simulation(elements); }, run_.driver_params(),
                      [&](const Simulation& s) {
                          std::ostringstream text;
                          text << "step " << s.history().size() << "  time " << s.time();
                          bar.show(duration > 0 ? s.time() / duration : approach.fraction(s.residual()), text.str());
                          visit(s, duration);
                          return !guard.interrupted();
                      });
        journal_ = run_.checkpoints.journal(run_.directory);
        driver.simulation().record_in(journal_);
        const Ending ending = run_to_the_end(driver, begin);
        bar.hide();
        if (duration == 0 && !case_.spheres) {
            keep(driver.simulation().time(), ending.result.bodies);
        }
        return conclude(driver.simulation(), ending);
    }

  private:
    Simulation simulation(axistokes::Index elements) {
        const double share = case_.spheres ? 1 : run_.driver_params().unresolved;
        const auto shape = run_.adapts() ? axistokes::resolved_nodes(discretization_, case_.initial, elements, share)
                                         : axistokes::nodes_of(discretization_, case_.initial, elements);
        std::vector<axistokes::Meridian<double>> shapes;
        for (axistokes::Index b = 0; b < case_.count; ++b) {
            const double place = (static_cast<double>(b) - static_cast<double>(case_.count - 1) / 2) * case_.distance;
            shapes.push_back(axistokes::detail::shifted(shape, place));
        }
        RigidBody sphere;
        if (case_.dragged) {
            sphere.velocity = 1;
        }
        const auto params = run_.params();
        Simulation simulation(Scene(kernel_for(case_.surroundings, run_.method), discretization_,
                                    case_.spheres ? Law(sphere) : Law(Vesicle()), case_.drive, Solver(), AnyWall()),
                              run_.method.steps(params.step_tolerance), shapes, params);
        simulation.record_in(journal_);
        frames_ = LineFrames();
        kept_ = 0;
        visit(simulation, run_.time.value_or(0));
        return simulation;
    }

    void visit(const Simulation& simulation, double duration) {
        const double due = static_cast<double>(kept_) / static_cast<double>(case_.frames - 1) * duration;
        const bool enough = kept_ >= (duration > 0 ? case_.frames : 1);
        if (enough || simulation.time() < due * (1 - 1e-12)) {
            return;
        }
        keep(simulation.time(), simulation.state());
    }

    void keep(double time, const Scene::State& bodies) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const auto shape = axistokes::detail::shifted(bodies[b].shape, bodies[b].position);
            frames_.add(time, b, drawn_curve(discretization_, shape));
        }
        frames_.next();
        ++kept_;
    }

    int conclude(const Simulation& simulation, const Ending& ending) const {
        const auto& result = ending.result;
        nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
        const auto films = simulation.scene().films(result.bodies);
        double drop = 0;
        for (std::size_t b = 0; b < simulation.bodies(); ++b) {
            const auto& configuration = result.configuration(b);
            const auto& shape = configuration.shape;
            const auto& film = films.bodies[b];
            nlohmann::ordered_json body{{"position", configuration.position},
                                        {"length", shape.z[shape.nodes() - 1] - shape.z[0]},
                                        {"max_radius", discretization_.max_radius(shape)},
                                        {"elements", shape.elements()}};
            if (std::isfinite(film.min)) {
                body["film_thickness_min"] = film.min;
                body["film_thickness_mean"] = film.mean;
            }
            if (std::isfinite(film.to_neighbour)) {
                body["neighbour_distance"] = film.to_neighbour;
            }
            // None where the last shapes are what a failure is about.
            if (const auto* instant = result.instant(b)) {
                body["velocity"] = instant->velocity;
                body["pressure_drop"] = instant->pressure_drop;
                drop += instant->pressure_drop;
                if (case_.dragged) {
                    const axistokes::Index n = shape.nodes();
                    body["drag_factor"] = instant->surface.weight.dot(instant->solution.force.tail(n)) /
                                          (6 * std::numbers::pi * instant->velocity);
                }
            }
            bodies.push_back(std::move(body));
        }
        nlohmann::ordered_json summary{{"bodies", bodies},
                                       {"stationary", result.stationary},
                                       {"time", simulation.time()},
                                       {"steps", simulation.history().size()},
                                       {"wall_seconds", ending.wall_seconds}};
        describe_ending(ending, summary);
        if (case_.surroundings.tube_radius && !result.instants.empty()) {
            summary["tube_radius"] = *case_.surroundings.tube_radius;
            summary["pressure_drop"] = drop;
        }
        run_.method.describe(summary);
        summary["parameters"] = case_.parameters;
        write(simulation, result, summary);
        print_bodies(summary);
        return finish(result.interrupted, ending.error, journal_.get());
    }

    void write(const Simulation& simulation, const Driver::Result& result,
               const nlohmann::ordered_json& summary) const {
        if (run_.directory.empty()) {
            return;
        }
        const std::filesystem::path directory(run_.directory);
        for (std::size_t b = 0; b < simulation.bodies(); ++b) {
            const std::string number = "_" + std::to_string(b);
            axistokes::write_csv(directory / ("shape" + number + ".csv"),
                                 last_shape_columns(result.configuration(b), result.instant(b)));
            axistokes::write_csv(directory / ("history" + number + ".csv"),
                                 axistokes::history_columns(simulation.history(b)));
        }
        axistokes::write_csv(directory / "frames.csv", frames_.columns());
        axistokes::write_atomically(directory / "summary.json",
                                    [&](std::ostream& out) { out << summary.dump(2) << '\n'; });
    }

    void print_bodies(const nlohmann::ordered_json& summary) const {
        print(summary, run_.directory);
        for (std::size_t b = 0; b < summary["bodies"].size(); ++b) {
            std::cout << "  body " << b;
            for (const auto& [key, value] : summary["bodies"][b].items()) {
                std::cout << "  " << key << ' ' << value;
            }
            std::cout << '\n';
        }
    }

    LineCase case_;
    RunOptions run_;
    AnyDiscretization discretization_;
    LineFrames frames_;
    axistokes::Index kept_ = 0;
    std::shared_ptr<Journal> journal_;  // from the first step on
};

}  // namespace

int run_line(const LineCase& c) {
    return LineRun(c)();
}

}  // namespace examples
