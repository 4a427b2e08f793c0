// SPDX-License-Identifier: MIT
// One of the library's channels, chosen at run time.
#pragma once

#include <axistokes/wall/profile.hpp>

#include <utility>
#include <variant>

namespace examples {

class Channel {
  public:
    using Scalar = double;
    using Choice =
        std::variant<axistokes::StraightTube<double>, axistokes::Constriction<double>, axistokes::Pore<double>>;

    explicit Channel(Choice choice)
        : uniform(std::visit([](const auto& profile) { return profile.uniform; }, choice)),
          choice_(std::move(choice)) {}

    bool uniform;

    double radius(const double& z) const {
        return std::visit([&](const auto& profile) { return profile.radius(z); }, choice_);
    }
    double slope(const double& z) const {
        return std::visit([&](const auto& profile) { return profile.slope(z); }, choice_);
    }
    double begin() const {
        return std::visit([](const auto& profile) { return profile.begin(); }, choice_);
    }
    double end() const {
        return std::visit([](const auto& profile) { return profile.end(); }, choice_);
    }

  private:
    Choice choice_;
};

}  // namespace examples
