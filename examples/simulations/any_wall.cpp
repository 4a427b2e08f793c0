// SPDX-License-Identifier: MIT
#include "../support/any_wall.hpp"

#include <limits>

namespace examples {

axistokes::Vector<double> AnyField::velocity(const Shape& points) const {
    return walled_ ? walled_->velocity(points) : discretization_->single_layer_at(points, body_, *kernel_) * force_;
}

double AnyField::flow_rate(double z, double radius) const {
    return walled_->flow_rate(z, radius);
}

axistokes::Vector<double> AnyWall::confine(const AnyDiscretization& discretization, const OptionalTubeKernel& kernel,
                                           const std::vector<Shape>& bodies, Matrix& mobility, Vector& background) {
    return mesh_ ? mesh_->confine(discretization, kernel.free_space(), bodies, mobility, background) : Vector();
}

double AnyWall::gap(const axistokes::Point<double>& x) const {
    return mesh_ ? mesh_->gap(x) : std::numeric_limits<double>::infinity();
}

double AnyWall::velocity_scale() const {
    return mesh_ ? mesh_->velocity_scale() : 0;
}

double AnyWall::centreline_velocity(double z) const {
    return mesh_ ? mesh_->centreline_velocity(z) : 0;
}

axistokes::Vector<double> AnyWall::memory() const {
    return mesh_ ? mesh_->memory() : Vector();
}

void AnyWall::recall(const Vector& memory) {
    if (mesh_) {
        mesh_->recall(memory);
    }
}

AnyWall AnyWall::reaching(double reach) const {
    return mesh_ ? AnyWall(mesh_->reaching(reach)) : AnyWall();
}

AnyField AnyWall::field(const AnyDiscretization& discretization, const OptionalTubeKernel& kernel, const Shape& body,
                        const Vector& force) {
    if (mesh_) {
        return AnyField(mesh_->field(discretization, kernel.free_space(), body, force));
    }
    return AnyField(discretization, kernel, body, force);
}

}  // namespace examples
