// SPDX-License-Identifier: MIT
// What drives and confines a particle, chosen at run time: one compiled program serves all cases.
#pragma once

#include <axistokes/flow/background.hpp>
#include <axistokes/kernel/tube.hpp>
#include <axistokes/kernel/tube_filon.hpp>
#include <axistokes/wall/wall_mesh.hpp>

#include <limits>
#include <optional>
#include <utility>
#include <variant>

namespace examples {

/// One of the library's backgrounds.
class Drive {
  public:
    using Scalar = double;
    static constexpr bool has_flow = true;
    static constexpr bool has_load = true;
    using Choice = std::variant<axistokes::Quiescent<double>, axistokes::Gravity<double>, axistokes::Poiseuille<double>,
                                axistokes::UnboundedPoiseuille<double>>;

    explicit Drive(Choice choice) : choice_(choice) {}

    axistokes::Point<double> velocity(const axistokes::Point<double>& x) const {
        return std::visit([&](const auto& flow) { return flow.velocity(x); }, choice_);
    }
    double normal_load(const axistokes::Point<double>& x) const {
        return std::visit([&](const auto& flow) { return flow.normal_load(x); }, choice_);
    }
    double velocity_scale() const {
        return std::visit([](const auto& flow) { return flow.velocity_scale(); }, choice_);
    }

  private:
    Choice choice_;
};

/// The Green function of a tube, by either evaluation, or of free space: a tube of infinite radius.
class OptionalTubeKernel : public axistokes::FreeSpaceKernel<double> {
  public:
    using Scalar = double;
    static constexpr bool has_regular_part = true;
    using Tube = axistokes::TubeKernel<double>;
    using FilonTube = axistokes::TubeFilonKernel<double>;

    OptionalTubeKernel() = default;
    explicit OptionalTubeKernel(Tube tube) : tube_(std::move(tube)) {}
    explicit OptionalTubeKernel(FilonTube tube) : tube_(std::move(tube)) {}

    /// The same with the error `tolerance`, or the present one if that is larger.
    OptionalTubeKernel loosened(double tolerance) const {
        const auto* tube = std::get_if<Tube>(&tube_);
        return tube ? OptionalTubeKernel(tube->loosened(tolerance)) : *this;
    }

    double tube_radius() const {
        return visit([](const auto& tube) { return tube.tube_radius(); }, std::numeric_limits<double>::infinity());
    }

    template <class Quadrature>
    void regular(const axistokes::Meridian<double>& targets, const Quadrature& quadrature,
                 axistokes::Matrix<double>& out) const {
        visit(
            [&](const auto& tube) {
                tube.regular(targets, quadrature, out);
                return 0;
            },
            0);
    }

    template <class Surface>
    double pressure_drop(const Surface& surface, const axistokes::Vector<double>& force) const {
        return visit([&](const auto& tube) { return tube.pressure_drop(surface, force); }, 0.0);
    }

  private:
    template <class Function, class Result>
    Result visit(const Function& function, const Result& in_free_space) const {
        if (const auto* tube = std::get_if<Tube>(&tube_)) {
            return function(*tube);
        }
        if (const auto* tube = std::get_if<FilonTube>(&tube_)) {
            return function(*tube);
        }
        return in_free_space;
    }

    std::variant<std::monostate, Tube, FilonTube> tube_;
};

/// What a particle is in: free space, a tube given by its Green function (slow_quadrature: the paper's), or one with a
/// meshed wall.
struct Surroundings {
    std::optional<double> tube_radius;
    bool slow_quadrature = false;
    std::optional<axistokes::WallMeshParams<double>> wall;

    OptionalTubeKernel kernel(std::optional<double> tolerance) const {
        if (!tube_radius) {
            return OptionalTubeKernel();
        }
        axistokes::TubeKernel<double>::Params params;
        params.tolerance = tolerance.value_or(params.tolerance);
        return slow_quadrature ? OptionalTubeKernel(axistokes::TubeFilonKernel<double>(*tube_radius, params))
                               : OptionalTubeKernel(axistokes::TubeKernel<double>(*tube_radius, params));
    }
    axistokes::WallMesh<axistokes::StraightTube<double>> mesh() const {
        return axistokes::WallMesh(axistokes::StraightTube<double>(*tube_radius), *wall);
    }
};

}  // namespace examples
