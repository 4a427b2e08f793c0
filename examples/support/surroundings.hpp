// SPDX-License-Identifier: MIT
// What drives and confines a particle, chosen at run time.
#pragma once

#include <axistokes/flow/background.hpp>
#include <axistokes/wall/wall_params.hpp>

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

/// What a particle is in: free space, a tube given by its Green function (slow_quadrature: the paper's), or one with a
/// meshed wall.
struct Surroundings {
    std::optional<double> tube_radius;
    bool slow_quadrature = false;
    std::optional<axistokes::WallMeshParams<double>> wall;
};

}  // namespace examples
