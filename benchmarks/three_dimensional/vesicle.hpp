// SPDX-License-Identifier: MIT
// A vesicle in space, semi-implicit in time: its velocities in an unbounded flow, and its way to a stationary shape.
#pragma once

#include "single_layer.hpp"
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace three_dimensional {

/// What drives the vesicle; lengths in R0, velocities in kappa/(eta R0^2).
struct Drive {
    double bond = 0;              // gravity along -z on a heavy interior: the load -bond z n
    double capillary_number = 0;  // unbounded Poiseuille flow -capillary_number (x^2 + y^2) along z

    /// Of a rigid sphere, or of the flow at a distance R0 from the axis.
    double velocity_scale() const { return std::max(std::abs(bond) * 2 / 9, std::abs(capillary_number)); }
};

/// The equations of one shape; forces are integrals against the hat functions. Vectors are x, y, z node by node.
class Motion {
  public:
    Motion(const Mesh& mesh, const Drive& drive, const QuadratureParams& quadrature = {})
        : surface(mesh), nodes_(mesh.nodes), mobility_(single_layer(mesh, quadrature)) {
        const Index n = size();
        mobility_ = surface.over_mass(mobility_.transpose()).transpose().eval();
        // No flux from any force, no velocity from a uniform pressure.
        const VectorXd flux = surface.flux.reshaped().normalized();
        mobility_ -= (mobility_ * flux).eval() * flux.transpose();
        mobility_ -= flux * (flux.transpose() * mobility_).eval();

        free_ = mobility_ * (surface.bending_force() - drive.bond * surface.buoyancy.reshaped());
        for (Index i = 0; i < n; ++i) {
            free_[3 * i + 2] -= drive.capillary_number * nodes_.col(i).head<2>().squaredNorm();
        }
        velocity = constrained(free_, mobility_ * surface.area_slopes.transpose());
    }

    /// Mean velocity over a step of length dt with the bending forces at its end, by L M^-1 L, the part of the
    /// energy's Hessian that has the highest derivatives: it does not mind translations.
    VectorXd implicit_velocity(double dt) const {
        const Index n = size();
        const MatrixXd stiffness = surface.area_hessian * surface.over_mass(MatrixXd(surface.area_hessian));
        const Eigen::PartialPivLU<MatrixXd> system(MatrixXd::Identity(3 * n, 3 * n) + dt * (mobility_ * stiffness));
        return constrained(system.solve(free_), system.solve(mobility_ * surface.area_slopes.transpose()));
    }

    /// Of the enclosed volume's centroid, where the surface moves with `u`.
    Vector3d drift(const VectorXd& u) const {
        Matrix3d moments = Matrix3d::Zero();
        Vector3d rate = Vector3d::Zero();
        for (Index i = 0; i < size(); ++i) {
            moments += nodes_.col(i) * surface.flux.col(i).transpose();
            rate += nodes_.col(i) * surface.flux.col(i).dot(u.segment<3>(3 * i));
        }
        return moments.lu().solve(rate);
    }

    /// `u` in the frame of the centroid, a node a column.
    Points relative(const VectorXd& u) const { return u.reshaped(3, size()).colwise() - drift(u); }

    Surface surface;
    VectorXd velocity;

  private:
    Index size() const { return nodes_.cols(); }

    /// With the tensions (up to their sign) that keep the area around every node.
    VectorXd constrained(const VectorXd& u, const MatrixXd& by_tension) const {
        const MatrixXd rates = surface.area_slopes * by_tension;
        return u - by_tension * rates.partialPivLu().solve(surface.area_slopes * u);
    }

    Points nodes_;
    MatrixXd mobility_;
    VectorXd free_;
};

struct MarchParams {
    double residual = 1e-4;      // largest normal velocity relative to the centroid, over the velocity scale
    double displacement = 0.05;  // a step's largest, in R0
    double longest_step = 0.1;   // over R0/(velocity scale)
    int most_steps = 300;
    double smoothing = 0;  // after each step nodes move by that share of the way to the middle of their neighbours
};

/// The last step of a march.
struct State {
    double velocity = 0;  // along z
    double sideways = 0;  // speed across z
    double length = 0;    // along z
    double radius = 0;    // largest distance from the z axis through the centroid
    double bending_energy = 0;
    double area_error = 0;  // largest relative change in a step, before its correction
    double volume_error = 0;
    double residual = 0;
    double slip = 0;  // largest |u| in the centroid's frame, over the velocity scale
    int steps = 0;
};

/// Steps until the residual or the number of steps is reached. Throws std::runtime_error if the mesh degenerates.
inline State march(Mesh& mesh, const Drive& drive, const MarchParams& params = {}) {
    const Measures wanted = measures(mesh, normals(mesh));
    State state;
    for (;; ++state.steps) {
        const Motion motion(mesh, drive);
        const Points relative = motion.relative(motion.velocity);
        const VectorXd normal_speed = relative.cwiseProduct(motion.surface.normal).colwise().sum().transpose();
        state.residual = normal_speed.cwiseAbs().maxCoeff() / drive.velocity_scale();
        state.slip = relative.colwise().norm().maxCoeff() / drive.velocity_scale();
        const Vector3d drift = motion.drift(motion.velocity);
        state.velocity = drift[2];
        state.sideways = drift.head<2>().norm();
        state.length = mesh.nodes.row(2).maxCoeff() - mesh.nodes.row(2).minCoeff();
        state.radius = mesh.nodes.topRows<2>().colwise().norm().maxCoeff();
        state.bending_energy = motion.surface.bending_energy();
        if (state.residual < params.residual || state.steps == params.most_steps) {
            return state;
        }
        double dt = params.longest_step / drive.velocity_scale();
        Points step = motion.relative(motion.implicit_velocity(dt));
        const double largest = dt * step.colwise().norm().maxCoeff();
        if (largest > params.displacement) {
            dt *= params.displacement / largest;
            step = motion.relative(motion.implicit_velocity(dt));
        }
        mesh.nodes += dt * step;
        mesh.nodes += params.smoothing * motion.surface.smoothing(mesh.nodes);
        const Measures now = measures(mesh, normals(mesh));
        state.area_error = std::max(state.area_error, std::abs(now.area / wanted.area - 1));
        state.volume_error = std::max(state.volume_error, std::abs(now.volume / wanted.volume - 1));
        restore(mesh, wanted);
    }
}

}  // namespace three_dimensional
