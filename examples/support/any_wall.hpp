// SPDX-License-Identifier: MIT
// A meshed wall of a profile chosen at run time, or none.
#pragma once

#include "any_discretization.hpp"
#include "channel.hpp"
#include <axistokes/wall/wall_mesh.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace examples {

/// The flow around a body, with or without a wall: as ChannelField. Refers to the wall and the discretisation.
class AnyField {
  public:
    using Shape = axistokes::Meridian<double>;
    using Vector = axistokes::Vector<double>;
    using Walled = axistokes::ChannelField<AnyDiscretization, axistokes::FreeSpaceKernel<double>>;

    explicit AnyField(Walled field) : walled_(std::move(field)) {}
    AnyField(const AnyDiscretization& discretization, const OptionalTubeKernel& kernel, Shape body, Vector force)
        : discretization_(&discretization), kernel_(&kernel), body_(std::move(body)), force_(std::move(force)) {}

    Vector velocity(const Shape& points) const;
    /// With a wall.
    double flow_rate(double z, double radius) const;

  private:
    std::optional<Walled> walled_;
    const AnyDiscretization* discretization_ = nullptr;
    const OptionalTubeKernel* kernel_ = nullptr;
    Shape body_;
    Vector force_;
};

class AnyWall {
  public:
    using Scalar = double;
    using Shape = axistokes::Meridian<double>;
    using Vector = axistokes::Vector<double>;
    using Matrix = axistokes::Matrix<double>;
    using Mesh = axistokes::WallMesh<Channel>;
    static constexpr bool present = true;

    AnyWall() = default;
    explicit AnyWall(Mesh mesh) : mesh_(std::move(mesh)) {}

    Vector confine(const AnyDiscretization& discretization, const OptionalTubeKernel& kernel,
                   const std::vector<Shape>& bodies, Matrix& mobility, Vector& background);
    double gap(const axistokes::Point<double>& x) const;
    double velocity_scale() const;
    double centreline_velocity(double z) const;
    Vector memory() const;
    void recall(const Vector& memory);
    AnyWall reaching(double reach) const;
    AnyField field(const AnyDiscretization& discretization, const OptionalTubeKernel& kernel, const Shape& body,
                   const Vector& force);
    /// Nothing without a wall.
    std::optional<Mesh>& mesh() { return mesh_; }
    const std::optional<Mesh>& mesh() const { return mesh_; }

  private:
    std::optional<Mesh> mesh_;
};

}  // namespace examples
