// SPDX-License-Identifier: MIT
// The quasi-static part of a simulation: given a shape, the velocities and forces on it.
#pragma once

#include "concepts.hpp"

#include <utility>

namespace axistokes {

/// Where the membrane is and the tension it had last; the meridian is relative to the centroid.
template <class S>
struct Configuration {
    Meridian<S> shape;
    S position{};       // axial coordinate of the centroid in the laboratory frame
    Vector<S> tension;  // empty before the first step
};

/// Everything known about one instant. Velocities are in the laboratory frame.
template <class S, class Surface>
struct Instant {
    Surface surface;
    MobilitySolution<S> solution;
    S velocity{};  // of the centroid, along z
    /// Largest normal velocity relative to the centroid's: 0 in a stationary state.
    S deformation_rate{};
};

/// Policies of a scene. Every policy comes by value and is const afterwards, but for the solver, which may keep factors
/// between solves.
template <GreenKernel Kernel, DiscretizationFor<Kernel> Discretization, class Membrane, Background Flow,
          LinearSolver Solver>
    requires MembraneFor<Membrane, typename Discretization::Surface, Solver>
class Scene {
  public:
    using Scalar = typename Kernel::Scalar;
    using Surface = typename Discretization::Surface;
    using InstantType = Instant<Scalar, Surface>;

    Scene(Kernel kernel, Discretization discretization, Membrane membrane, Flow flow, Solver solver)
        : kernel_(std::move(kernel)),
          discretization_(std::move(discretization)),
          membrane_(std::move(membrane)),
          flow_(std::move(flow)),
          solver_(std::move(solver)) {}

    const Kernel& kernel() const { return kernel_; }
    const Discretization& discretization() const { return discretization_; }
    const Membrane& membrane() const { return membrane_; }
    const Flow& flow() const { return flow_; }
    const Solver& solver() const { return solver_; }

    /// Velocities with the membrane's forces taken at x + implicit_time * u (0: at x).
    /// Throws SimulationFailure when the system cannot be solved.
    InstantType evaluate(const Configuration<Scalar>& configuration, const Scalar& implicit_time) {
        InstantType instant;
        instant.surface = discretization_.surface(configuration.shape);
        const Surface& surface = instant.surface;
        const Index n = surface.size();
        const Matrix<Scalar> mobility = discretization_.single_layer(configuration.shape, kernel_);
        const Vector<Scalar> background = background_velocity(configuration);
        const Vector<Scalar> load = normal_load(configuration, surface);
        instant.solution = membrane_.solve(
            MobilityProblem<Scalar, Surface>{surface, mobility, background, load, configuration.tension, implicit_time},
            solver_);
        const Vector<Scalar>& u = instant.solution.velocity;
        const Vector<Scalar> normal_velocity =
            surface.normal_r.cwiseProduct(u.head(n)) + surface.normal_z.cwiseProduct(u.tail(n));
        // dz_c/dt = (1/V) Int (z - z_c) u.n dA, normalised so that u = e_z gives exactly 1.
        const Vector<Scalar> moment = surface.weight.cwiseProduct(configuration.shape.z);
        instant.velocity = moment.dot(normal_velocity) / moment.dot(surface.normal_z);
        instant.deformation_rate = (normal_velocity - instant.velocity * surface.normal_z).cwiseAbs().maxCoeff();
        return instant;
    }

    /// Undisturbed velocity at the nodes, stacked.
    Vector<Scalar> background_velocity(const Configuration<Scalar>& configuration) const {
        const Index n = configuration.shape.nodes();
        Vector<Scalar> velocity = Vector<Scalar>::Zero(2 * n);
        if constexpr (Flow::has_flow) {
            for (Index i = 0; i < n; ++i) {
                const Point<Scalar> u =
                    flow_.velocity({configuration.shape.r[i], configuration.shape.z[i] + configuration.position});
                velocity[i] = u.r;
                velocity[n + i] = u.z;
            }
        }
        return velocity;
    }

    /// Undisturbed velocity on the axis at the centroid.
    Scalar centreline_velocity(const Scalar& position) const {
        if constexpr (Flow::has_flow) {
            return flow_.velocity({Scalar(0), position}).z;
        } else {
            return Scalar(0);
        }
    }

  private:
    /// Gravity's load is taken relative to the centroid: the rest is a uniform pressure.
    Vector<Scalar> normal_load(const Configuration<Scalar>& configuration, const Surface& surface) const {
        const Index n = configuration.shape.nodes();
        Vector<Scalar> load = Vector<Scalar>::Zero(2 * n);
        if constexpr (Flow::has_load) {
            for (Index i = 0; i < n; ++i) {
                const Scalar pressure = flow_.normal_load({configuration.shape.r[i], configuration.shape.z[i]});
                load[i] = pressure * surface.normal_r[i];
                load[n + i] = pressure * surface.normal_z[i];
            }
        }
        return load;
    }

    Kernel kernel_;
    Discretization discretization_;
    Membrane membrane_;
    Flow flow_;
    Solver solver_;
};

}  // namespace axistokes
