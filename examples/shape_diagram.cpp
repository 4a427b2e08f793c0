// SPDX-License-Identifier: MIT
// Stationary shapes of vesicles in tube flow over a table of cases: bullet or parachute, and whether both are stable
// (docs/shape_diagram.md).
#include "support/cases.hpp"
#include "support/command_line.hpp"
#include "support/simulation.hpp"
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/io/atomic_file.hpp>
#include <axistokes/stationary/stationary_branch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using examples::Case;

using examples::Newton;
using Branch = StationaryBranch<examples::Scene>;

struct Settings {
    Index elements = 32;
    Index most_elements = 96;
    double tolerance = 1e-9;
    double unresolved = 1e-4;
    std::string shapes;  // directory; none if empty
};

struct Found {
    std::string start;
    Newton::State state;
    double growth = 0;
    double unresolved = 0;
    double seconds = 0;
};

/// What later cases start from.
struct Starts {
    std::optional<Meridian<double>> oblate;     // where the oblate start led
    std::optional<Meridian<double>> parachute;  // a stable one
};

struct Solution {
    std::vector<Found> found;
    std::string failure;
    Starts starts;
};

double excess_area(double reduced_volume) {
    return 4 * detail::pi_value<double>() * (std::pow(reduced_volume, -2.0 / 3) - 1);
}

const auto discretization = examples::AnyDiscretization::of(examples::DiscretizationKind::spectral, std::nullopt);

examples::Scene scene_of(double confinement, double capillary_number) {
    examples::Surroundings tube;
    tube.tube_radius = 1 / confinement;
    return {examples::kernel_for(tube, std::nullopt),
            discretization,
            examples::Law(examples::Vesicle()),
            examples::Drive(Poiseuille<double>(capillary_number, 1 / confinement)),
            examples::Solver(),
            examples::AnyWall()};
}

class Diagram {
  public:
    explicit Diagram(Settings settings) : settings_(settings) {}

    /// The states that the starts lead to, one if they are the same, and what went wrong. Where the oblate start finds
    /// nothing else, the parachute of a case that differs in reduced volume only is tried.
    Solution solve(const Case& wanted) {
        Solution solution;
        auto& [found, failure, starts] = solution;
        const auto attempt = [&](const std::string& name, const auto& state) {
            const auto begin = std::chrono::steady_clock::now();
            try {
                std::optional<Found> next = state();
                if (next && (found.empty() || differ(found.front().state, next->state))) {
                    next->start = name;
                    next->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
                    found.push_back(std::move(*next));
                }
            } catch (const std::exception& error) {
                failure += (failure.empty() ? "" : "; ") + name + ": " + error.what();
            }
        };
        if (const double narrowest = critical_tube_radius(area(wanted), volume());
            !(1 / wanted.confinement > narrowest)) {
            failure = "the tube's radius, " + detail::text(1 / wanted.confinement) + ", is not more than " +
                      detail::text(narrowest) + ", which this vesicle needs";
            remember(wanted, starts);
            return solution;
        }
        attempt("prolate", [&] { return from_prolate(wanted); });
        attempt("oblate", [&] { return from_oblate(wanted, starts.oblate); });
        if (found.size() < 2) {
            attempt("neighbour", [&] { return from_neighbour(wanted); });
        }
        for (const Found& f : found) {
            if (is_parachute(f) && f.growth < 0) {
                starts.parachute = f.state.configuration().shape;
            }
        }
        remember(wanted, starts);
        return solution;
    }

    /// Of a case that was solved, now or in an earlier run.
    void remember(const Case& solved, const Starts& starts) {
        if (starts.oblate) {
            oblate_.emplace(solved, *starts.oblate);
        }
        const std::pair column(solved.confinement, solved.capillary_number);
        parachutes_.erase(column);  // one attempt: further away there is less hope
        if (starts.parachute) {
            parachutes_.insert_or_assign(column, std::pair(solved, *starts.parachute));
        }
    }

    static bool is_parachute(const Found& f) {
        return discretization.pole_curvatures(f.state.configuration().shape).first <= 0;
    }

  private:
    static double area(const Case& c) { return 4 * detail::pi_value<double>() + excess_area(c.reduced_volume); }
    static double volume() { return 4 * detail::pi_value<double>() / 3; }

    static bool differ(const Newton::State& a, const Newton::State& b) {
        const auto length = [](const Newton::State& s) {
            const Meridian<double>& shape = s.configuration().shape;
            return shape.z[shape.elements()] - shape.z[0];
        };
        return std::abs(length(a) - length(b)) > 1e-3;
    }

    Newton solver(const Case& c) const {
        StationaryParams<double> params;
        params.tolerance = settings_.tolerance;
        params.most_iterations = 200;
        return Newton(scene_of(c.confinement, c.capillary_number), params);
    }

    Meridian<double> start(SpheroidKind kind, const Case& c) const {
        return shape_in_tube<double>(excess_area(c.reduced_volume), 1 / c.confinement, kind, settings_.elements);
    }

    std::optional<Found> from_prolate(const Case& wanted) const {
        return refined(solver(wanted).solve(start(SpheroidKind::prolate, wanted), area(wanted), volume()), wanted);
    }

    /// An oblate start that does not fit is solved in a wider tube, which then is narrowed; or the last case's state is
    /// taken, if its tube was wider and the rest the same.
    std::optional<Found> from_oblate(const Case& wanted, std::optional<Meridian<double>>& start_of_next) const {
        const double excess = excess_area(wanted.reduced_volume);
        Case fitting = wanted;
        const auto spheroid = spheroid_of_excess_area<double>(excess, SpheroidKind::oblate, settings_.elements);
        fitting.confinement = std::min(wanted.confinement, 0.8 / spheroid.r.maxCoeff());
        std::optional<Found> found;
        if (fitting.confinement == wanted.confinement) {
            found = refined(solver(wanted).solve(start(SpheroidKind::oblate, wanted), area(wanted), volume()), wanted);
        } else if (oblate_ && oblate_->first.reduced_volume == wanted.reduced_volume &&
                   oblate_->first.capillary_number == wanted.capillary_number &&
                   oblate_->first.confinement < wanted.confinement) {
            found = continued(oblate_->second, oblate_->first, wanted);
        } else {
            const auto state = solver(fitting).solve(start(SpheroidKind::oblate, fitting), area(wanted), volume());
            found = continued(state.configuration().shape, fitting, wanted);
        }
        if (found) {
            start_of_next = found->state.configuration().shape;
        }
        return found;
    }

    std::optional<Found> from_neighbour(const Case& wanted) const {
        const auto known = parachutes_.find({wanted.confinement, wanted.capillary_number});
        if (known == parachutes_.end()) {
            return std::nullopt;
        }
        return continued(known->second.second, known->second.first, wanted);
    }

    /// Along the branch of states from one case to another; none if it ends in a fold before.
    std::optional<Found> continued(const Meridian<double>& shape, const Case& from, const Case& to) const {
        const auto at = [&](double t) {
            return Case{from.confinement + t * (to.confinement - from.confinement),
                        from.reduced_volume + t * (to.reduced_volume - from.reduced_volume), to.capillary_number};
        };
        const double change =
            std::max({std::abs(to.confinement - from.confinement), std::abs(to.reduced_volume - from.reduced_volume)});
        if (change == 0) {
            return refined(solver(to).solve(shape, area(to), volume()), to);
        }
        Branch::Params derivatives;
        derivatives.parameter_step /= change;
        Branch branch([&](double t) { return scene_of(at(t).confinement, to.capillary_number); },
                      [&](double t) { return area(at(t)); }, [](double) { return volume(); }, derivatives);
        ContinuationParams<double> params;
        params.tolerance = settings_.tolerance;
        params.largest_parameter = 1;
        params.parameter_scale = 1 / change;
        Continuation<Branch> path(branch, params);
        std::optional<Meridian<double>> last;
        bool folded = false;
        const bool arrived = path.follow(branch.at(0, shape), 1, [&](const Continuation<Branch>::Record& record) {
            folded = record.event == BranchEvent::fold;
            last = record.point.state.configuration().shape;
            return !folded;
        });
        if (!arrived || folded) {
            return std::nullopt;
        }
        return refined(solver(to).solve(*last, area(to), volume()), to);
    }

    /// With more modes until the shape is resolved, and its stability.
    Found refined(Newton::State state, const Case& wanted) const {
        Found found;
        Newton newton = solver(wanted);
        for (;;) {
            const Meridian<double> shape = state.configuration().shape;
            found.unresolved = discretization.unresolved(shape);
            const Index elements = shape.elements() + shape.elements() / 2;
            if (found.unresolved <= settings_.unresolved || elements > settings_.most_elements) {
                break;
            }
            state = newton.solve(detail::resampled(shape, elements), area(wanted), volume());
        }
        found.growth = newton.growth_rates(state).front().real();
        found.state = std::move(state);
        return found;
    }

    Settings settings_;
    std::optional<std::pair<Case, Meridian<double>>> oblate_;  // the last state of the oblate start
    std::map<std::pair<double, double>, std::pair<Case, Meridian<double>>> parachutes_;  // by confinement and Ca
};

const char* const kHeader =
    "confinement,reduced_volume,capillary_number,states,start,branch,stable,growth_rate,velocity,length,"
    "rear_curvature,front_curvature,film_thickness,pressure_drop,residual,unresolved,elements,evaluations,seconds,"
    "failure";

/// The rows of a case: one for each state, or one with the cause alone.
std::string rows(const Case& c, const std::vector<Found>& found, const std::string& failure) {
    std::ostringstream out;
    out.precision(10);
    const std::string cause = examples::quoted(failure);
    if (found.empty()) {
        out << examples::key(c) << ",0,,,,,,,,,,,,,,,," << cause << '\n';
    }
    for (const Found& f : found) {
        const Meridian<double>& shape = f.state.configuration().shape;
        const auto [rear, front] = discretization.pole_curvatures(shape);
        out << examples::key(c) << ',' << found.size() << ',' << f.start << ',' << (rear > 0 ? "bullet" : "parachute")
            << ',' << (f.growth < 0) << ',' << f.growth << ',' << f.state.instant().velocity << ','
            << shape.z[shape.elements()] - shape.z[0] << ',' << rear << ',' << front << ','
            << 1 / c.confinement - discretization.max_radius(shape) << ',' << f.state.instant().pressure_drop << ','
            << f.state.residual << ',' << f.unresolved << ',' << shape.elements() << ',' << f.state.evaluations << ','
            << f.seconds << ',' << cause << '\n';
    }
    return out.str();
}

/// A file of the starts of all cases solved, with which another run goes on as this one would: a line each, of the
/// case, the kind, and r and z of each node.
class StartsTable {
  public:
    explicit StartsTable(std::filesystem::path path) : path_(std::move(path)) {
        std::ifstream input(path_);
        std::string line;
        while (std::getline(input, line) && !input.eof()) {
            read(line);
        }
    }

    Starts of(const Case& c) const {
        const auto known = starts_.find(examples::key(c));
        return known == starts_.end() ? Starts{} : known->second;
    }

    void append(const Case& c, const Starts& starts) const {
        std::ostringstream out;
        out.precision(17);
        const auto write = [&](const char* kind, const std::optional<Meridian<double>>& shape) {
            if (shape) {
                out << examples::key(c) << ' ' << kind;
                for (Index i = 0; i < shape->nodes(); ++i) {
                    out << ' ' << shape->r[i] << ' ' << shape->z[i];
                }
                out << '\n';
            }
        };
        write("oblate", starts.oblate);
        write("parachute", starts.parachute);
        examples::append(path_, out.str());
    }

  private:
    void read(const std::string& line) {
        std::istringstream in(line);
        std::string known;
        std::string kind;
        in >> known >> kind;
        std::vector<double> values;
        for (double value = 0; in >> value;) {
            values.push_back(value);
        }
        const auto nodes = static_cast<Index>(values.size() / 2);
        if (nodes < 9) {
            return;  // torn
        }
        Meridian<double> shape{Vector<double>(nodes), Vector<double>(nodes)};
        for (Index i = 0; i < nodes; ++i) {
            shape.r[i] = values[static_cast<std::size_t>(2 * i)];
            shape.z[i] = values[static_cast<std::size_t>(2 * i + 1)];
        }
        (kind == "oblate" ? starts_[known].oblate : starts_[known].parachute) = std::move(shape);
    }

    std::filesystem::path path_;
    std::map<std::string, Starts> starts_;
};

void write_shapes(const std::filesystem::path& directory, const Case& c, const std::vector<Found>& found) {
    for (const Found& f : found) {
        std::string name = "shape_" + examples::key(c) + '_' + f.start + ".csv";
        std::replace(name.begin(), name.end(), ',', '_');
        const Meridian<double>& shape = f.state.configuration().shape;
        write_atomically(directory / name, [&](std::ostream& out) {
            out.precision(17);
            out << "r,z\n";
            for (Index i = 0; i < shape.nodes(); ++i) {
                out << shape.r[i] << ',' << shape.z[i] << '\n';
            }
        });
    }
}

}  // namespace

int main(int argc, char** argv) {
    examples::CommandLine app{
        "shape_diagram",
        "Stationary vesicles in the tube flow u_z = Ca (1 - (L r)^2), from several starts: one row for\n"
        "each state of a case, written when it is known. Cases that the output has already are left out"};
    std::string input;
    std::string directory;
    examples::Range confinement(0.2, 0.9, 8);
    examples::Range reduced_volume(0.7, 0.98, 8);
    double capillary_number = 10;
    Settings settings;
    const examples::Option cases =
        app.text("--cases", input,
                 "CSV file with columns confinement (R0 over the tube's radius), reduced_volume and "
                 "capillary_number");
    confinement.add_to(app, "--confinement", "R0 over the tube's radius").excludes(cases);
    reduced_volume.add_to(app, "--reduced-volume", "volume over that of the sphere of equal area").excludes(cases);
    app.number("--capillary-number", capillary_number, "Ca = eta u_max R0^2 / kappa").excludes(cases);
    app.number("--elements", settings.elements, "modes to begin with");
    app.number("--max-elements", settings.most_elements, "modes to end with, at most");
    app.number("--unresolved", settings.unresolved, "share of the slope in the last quarter of modes");
    app.number("--tolerance", settings.tolerance, "residual");
    app.text("--shapes", settings.shapes, "directory that receives the shapes, a file each");
    app.text("--out", directory, "directory that receives diagram.csv; created if missing").required();
    return app.run(argc, argv, [&] {
        detail::require(settings.elements >= 24, "elements", settings.elements, "at least 24");
        detail::require(settings.most_elements >= settings.elements && settings.most_elements <= 400, "max-elements",
                        settings.most_elements, "from elements to 400");
        detail::require(settings.tolerance > 0 && settings.tolerance < 1, "tolerance", settings.tolerance, "in (0, 1)");
        detail::require(settings.unresolved > 0, "unresolved", settings.unresolved, "> 0");
        const std::vector<Case> wanted =
            cases.given() ? examples::read_cases(input)
                          : examples::grid(confinement.values(), reduced_volume.values(), capillary_number);
        examples::CaseTable table(std::filesystem::path(directory) / "diagram.csv", kHeader);
        const StartsTable starts(std::filesystem::path(directory) / "starts.txt");
        Diagram diagram(settings);
        std::size_t done = 0;
        for (const Case& c : wanted) {
            ++done;
            if (table.has(c)) {
                diagram.remember(c, starts.of(c));
                continue;
            }
            const Solution solution = diagram.solve(c);
            const std::string text = rows(c, solution.found, solution.failure);
            if (!settings.shapes.empty()) {
                write_shapes(settings.shapes, c, solution.found);
            }
            starts.append(c, solution.starts);
            table.append(text);
            std::cout << done << '/' << wanted.size() << ' ' << text << std::flush;
        }
        return examples::success;
    });
}
