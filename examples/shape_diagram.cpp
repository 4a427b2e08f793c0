// SPDX-License-Identifier: MIT
// Stationary shapes of vesicles in tube flow over a table of cases: bullet or parachute, and whether both are stable
// (docs/shape_diagram.md).
#include "support/cases.hpp"
#include "support/program.hpp"
#include <axistokes/discretization/spectral_meridian.hpp>
#include <axistokes/flow/poiseuille.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/io/atomic_file.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/scene.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/stationary_branch.hpp>
#include <axistokes/time/stationary_solver.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using examples::Case;

using TubeScene =
    Scene<TubeKernel<double>, SpectralMeridian<double>, Vesicle<double>, Poiseuille<double>, DenseLU<double>>;
using Solver = StationarySolver<TubeScene>;
using Branch = StationaryBranch<TubeScene>;

struct Settings {
    Index elements = 32;
    Index most_elements = 96;
    double tolerance = 1e-9;
    double unresolved = 1e-4;
    std::string shapes;  // directory; none if empty
};

struct Found {
    std::string start;
    Solver::State state;
    double growth = 0;
    double unresolved = 0;
    double seconds = 0;
};

double excess_area(double reduced_volume) {
    return 4 * detail::pi_value<double>() * (std::pow(reduced_volume, -2.0 / 3) - 1);
}

TubeScene scene_of(double confinement, double capillary_number) {
    return {TubeKernel<double>(1 / confinement), SpectralMeridian<double>(), Vesicle<double>(),
            Poiseuille<double>(capillary_number, 1 / confinement), DenseLU<double>()};
}

class Diagram {
  public:
    explicit Diagram(Settings settings) : settings_(settings) {}

    /// The states that the two starts lead to, one if it is the same, and what went wrong.
    std::pair<std::vector<Found>, std::string> solve(const Case& wanted) {
        std::vector<Found> found;
        std::string failure;
        for (const SpheroidKind kind : {SpheroidKind::prolate, SpheroidKind::oblate}) {
            const std::string name = kind == SpheroidKind::prolate ? "prolate" : "oblate";
            const auto begin = std::chrono::steady_clock::now();
            try {
                auto next = from(kind, wanted);
                if (next && (found.empty() || differ(found.front().state, next->state))) {
                    next->start = name;
                    next->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
                    found.push_back(std::move(*next));
                }
            } catch (const std::exception& error) {
                failure += (failure.empty() ? "" : "; ") + name + ": " + error.what();
            }
        }
        return {std::move(found), std::move(failure)};
    }

  private:
    static double area(const Case& c) { return 4 * detail::pi_value<double>() + excess_area(c.reduced_volume); }
    static double volume() { return 4 * detail::pi_value<double>() / 3; }

    static bool differ(const Solver::State& a, const Solver::State& b) {
        const auto length = [](const Solver::State& s) {
            const Meridian<double>& shape = s.configuration.shape;
            return shape.z[shape.elements()] - shape.z[0];
        };
        return std::abs(length(a) - length(b)) > 1e-3;
    }

    Solver solver(const Case& c) const {
        StationaryParams<double> params;
        params.tolerance = settings_.tolerance;
        params.most_iterations = 200;
        return Solver(scene_of(c.confinement, c.capillary_number), params);
    }

    /// An oblate start that does not fit is solved in a wider tube, which then is narrowed; or the last case's state is
    /// taken, if its tube was wider and the rest the same.
    std::optional<Found> from(SpheroidKind kind, const Case& wanted) {
        const double excess = excess_area(wanted.reduced_volume);
        const auto start = [&](double confinement) {
            return shape_in_tube<double>(excess, 1 / confinement, kind, settings_.elements);
        };
        if (kind == SpheroidKind::prolate) {
            return refined(solver(wanted).solve(start(wanted.confinement), area(wanted), volume()), wanted);
        }
        Case fitting = wanted;
        const auto spheroid = spheroid_of_excess_area<double>(excess, kind, settings_.elements);
        fitting.confinement = std::min(wanted.confinement, 0.8 / spheroid.r.maxCoeff());
        if (fitting.confinement == wanted.confinement) {
            return remembered(solver(wanted).solve(start(wanted.confinement), area(wanted), volume()), wanted);
        }
        Meridian<double> shape;
        if (last_ && last_->first.reduced_volume == wanted.reduced_volume &&
            last_->first.capillary_number == wanted.capillary_number && last_->first.confinement < wanted.confinement) {
            std::tie(fitting, shape) = *last_;
        } else {
            shape = solver(fitting).solve(start(fitting.confinement), area(wanted), volume()).configuration.shape;
        }
        const auto narrow = narrowed(shape, fitting, wanted);
        if (!narrow) {
            return std::nullopt;
        }
        return remembered(solver(wanted).solve(*narrow, area(wanted), volume()), wanted);
    }

    Found remembered(Solver::State state, const Case& wanted) {
        Found found = refined(std::move(state), wanted);
        last_.emplace(wanted, found.state.configuration.shape);
        return found;
    }

    /// Along the branch of states to the confinement wanted; none if the branch ends in a fold before.
    std::optional<Meridian<double>> narrowed(const Meridian<double>& shape, const Case& from, const Case& to) const {
        Branch branch([&](double confinement) { return scene_of(confinement, to.capillary_number); },
                      [&](double) { return area(to); }, [](double) { return volume(); });
        ContinuationParams<double> params;
        params.tolerance = settings_.tolerance;
        params.largest_parameter = to.confinement;
        Continuation<Branch> path(branch, params);
        std::optional<Meridian<double>> last;
        bool folded = false;
        const bool arrived =
            path.follow(branch.at(from.confinement, shape), 1, [&](const Continuation<Branch>::Record& record) {
                folded = record.event == BranchEvent::fold;
                last = record.point.state.configuration.shape;
                return !folded;
            });
        return arrived && !folded ? last : std::nullopt;
    }

    /// With more modes until the shape is resolved, and its stability.
    Found refined(Solver::State state, const Case& wanted) const {
        Found found;
        Solver newton = solver(wanted);
        const auto& discretization = newton.scene().discretization();
        for (;;) {
            const Meridian<double> shape = state.configuration.shape;
            found.unresolved = discretization.unresolved(shape);
            const Index elements = shape.elements() + shape.elements() / 2;
            if (found.unresolved <= settings_.unresolved || elements > settings_.most_elements) {
                break;
            }
            state = newton.solve(discretization.resampled(shape, elements), area(wanted), volume());
        }
        found.growth = newton.growth_rates(state).front().real();
        found.state = std::move(state);
        return found;
    }

    Settings settings_;
    std::optional<std::pair<Case, Meridian<double>>> last_;  // of the oblate start
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
        out << examples::key(c) << ",0,,,,,,,,,,,,,,,,," << cause << '\n';
    }
    const SpectralMeridian<double> discretization;
    for (const Found& f : found) {
        const Meridian<double>& shape = f.state.configuration.shape;
        const auto [rear, front] = discretization.pole_curvatures(shape);
        out << examples::key(c) << ',' << found.size() << ',' << f.start << ',' << (rear > 0 ? "bullet" : "parachute")
            << ',' << (f.growth < 0) << ',' << f.growth << ',' << f.state.instant.velocity << ','
            << shape.z[shape.elements()] - shape.z[0] << ',' << rear << ',' << front << ','
            << 1 / c.confinement - discretization.max_radius(shape) << ',' << f.state.instant.pressure_drop << ','
            << f.state.residual << ',' << f.unresolved << ',' << shape.elements() << ',' << f.state.evaluations << ','
            << f.seconds << ',' << cause << '\n';
    }
    return out.str();
}

void write_shapes(const std::filesystem::path& directory, const Case& c, const std::vector<Found>& found) {
    for (const Found& f : found) {
        std::ostringstream name;
        name << "shape_" << c.confinement << '_' << c.reduced_volume << '_' << c.capillary_number << '_' << f.start
             << ".csv";
        const Meridian<double>& shape = f.state.configuration.shape;
        write_atomically(directory / name.str(), [&](std::ostream& out) {
            out << "r,z\n";
            for (Index i = 0; i < shape.nodes(); ++i) {
                out << shape.r[i] << ',' << shape.z[i] << '\n';
            }
        });
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Stationary vesicles in the tube flow u_z = Ca (1 - (L r)^2), from a prolate and an oblate start: one row for\n"
        "each state of a case, written when it is known. Cases that the output has already are left out"};
    std::string input;
    std::string directory;
    examples::Range confinement(0.2, 0.9, 8);
    examples::Range reduced_volume(0.7, 0.98, 8);
    double capillary_number = 10;
    Settings settings;
    auto* cases = app.add_option("--cases", input,
                                 "CSV file with columns confinement (R0 over the tube's radius), reduced_volume and "
                                 "capillary_number");
    confinement.add_to(app, "--confinement", "R0 over the tube's radius")->excludes(cases);
    reduced_volume.add_to(app, "--reduced-volume", "volume over that of the sphere of equal area")->excludes(cases);
    examples::add_number(app, "--capillary-number", capillary_number, "Ca = eta u_max R0^2 / kappa")->excludes(cases);
    examples::add_number(app, "--elements", settings.elements, "modes to begin with");
    examples::add_number(app, "--max-elements", settings.most_elements, "modes to end with, at most");
    examples::add_number(app, "--unresolved", settings.unresolved, "share of the slope in the last quarter of modes");
    examples::add_number(app, "--tolerance", settings.tolerance, "residual");
    app.add_option("--shapes", settings.shapes, "directory that receives the shapes, a file each");
    app.add_option("--out", directory, "directory that receives diagram.csv; created if missing")->required();
    return examples::run_program("shape_diagram", app, argc, argv, [&] {
        detail::require(settings.elements >= 24, "elements", settings.elements, "at least 24");
        detail::require(settings.most_elements <= 400, "max-elements", settings.most_elements, "at most 400");
        detail::require(settings.unresolved > 0, "unresolved", settings.unresolved, "> 0");
        const std::vector<Case> wanted =
            cases->count() > 0 ? examples::read_cases(input)
                               : examples::grid(confinement.values(), reduced_volume.values(), capillary_number);
        examples::CaseTable table(std::filesystem::path(directory) / "diagram.csv", kHeader);
        Diagram diagram(settings);
        std::size_t done = 0;
        for (const Case& c : wanted) {
            ++done;
            if (table.has(c)) {
                continue;
            }
            const auto [found, failure] = diagram.solve(c);
            const std::string text = rows(c, found, failure);
            if (!settings.shapes.empty()) {
                write_shapes(settings.shapes, c, found);
            }
            table.append(text);
            std::cout << done << '/' << wanted.size() << ' ' << text << std::flush;
        }
        return examples::success;
    });
}
