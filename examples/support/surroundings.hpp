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

/// The images of a tube, by either evaluation, or none: a tube of infinite radius.
class OptionalTubeImages {
  public:
    using Scalar = double;
    using Tube = axistokes::TubeImages<double>;
    using FilonTube = axistokes::TubeFilonImages<double>;

    OptionalTubeImages() = default;
    explicit OptionalTubeImages(Tube tube) : tube_(std::move(tube)) {}
    explicit OptionalTubeImages(FilonTube tube) : tube_(std::move(tube)) {}

    /// The same with the error `tolerance`, or the present one if that is larger.
    OptionalTubeImages loosened(double tolerance) const {
        const auto* tube = std::get_if<Tube>(&tube_);
        return tube ? OptionalTubeImages(tube->loosened(tolerance)) : *this;
    }

    double gap(const axistokes::Point<double>& x) const {
        return visit([&](const auto& tube) { return tube.gap(x); }, std::numeric_limits<double>::infinity());
    }

    axistokes::KernelBlock<double> correction(const axistokes::Point<double>& target,
                                              const axistokes::Point<double>& source) const {
        return visit([&](const auto& tube) { return tube.correction(target, source); },
                     axistokes::KernelBlock<double>{});
    }

    template <class Quadrature>
    void regular(const axistokes::Meridian<double>& targets, const Quadrature& quadrature,
                 axistokes::Matrix<double>& out) const {
        if (const auto* tube = std::get_if<Tube>(&tube_)) {
            tube->regular(targets, quadrature, out);
        } else {
            axistokes::detail::regular_by_pairs<double>(*this, targets, quadrature(0.0), out);
        }
    }

    axistokes::Point<double> unit_flow(const axistokes::Point<double>& x) const {
        return visit([&](const auto& tube) { return tube.unit_flow(x); }, axistokes::Point<double>{});
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

using OptionalTubeKernel = axistokes::ImagedKernel<double, OptionalTubeImages>;

/// What a particle is in: free space, a tube given by its Green function (slow_quadrature: the paper's), or one with a
/// meshed wall.
struct Surroundings {
    std::optional<double> tube_radius;
    bool slow_quadrature = false;
    std::optional<axistokes::WallMeshParams<double>> wall;

    OptionalTubeKernel kernel(std::optional<double> tolerance) const {
        if (!tube_radius) {
            return OptionalTubeKernel(OptionalTubeImages());
        }
        using Images = OptionalTubeImages;
        if (slow_quadrature) {
            Images::FilonTube::Params params;
            params.tolerance = tolerance.value_or(params.tolerance);
            return OptionalTubeKernel(Images(Images::FilonTube(*tube_radius, params)));
        }
        Images::Tube::Params params;
        params.tolerance = tolerance.value_or(params.tolerance);
        return OptionalTubeKernel(Images(Images::Tube(*tube_radius, params)));
    }
    axistokes::WallMesh<axistokes::StraightTube<double>> mesh() const {
        return axistokes::WallMesh(axistokes::StraightTube<double>(*tube_radius), *wall);
    }
};

}  // namespace examples
