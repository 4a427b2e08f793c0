// SPDX-License-Identifier: MIT
// The quasi-static part of a simulation: given a shape, the velocities and forces on it.
#pragma once

#include "concepts.hpp"
#include "wall/no_wall.hpp"

#include <algorithm>
#include <limits>
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
    /// Added by the particle to the pressure drop along the tube or channel, in kappa/R0^3; 0 without walls.
    S pressure_drop{};
    /// Largest difference of the undisturbed flow along an element over its length.
    S shear_rate{};
};

/// How close the membrane comes to the wall, in R0.
template <class S>
struct FilmThickness {
    S min = std::numeric_limits<S>::infinity();
    /// Over the part of the meridian within 10 % of the largest radius, by arc length.
    S mean = std::numeric_limits<S>::infinity();
};

namespace detail {

/// Velocity of the centroid, and normal velocities relative to it, of a velocity field given at the nodes of `surface`:
/// dz_c/dt = (1/V) Int (z - z_c) u.n dA, normalised so that u = e_z gives exactly 1. `z` is relative to the centroid.
template <class S, class Surface>
std::pair<S, Vector<S>> relative_normal_velocity(const Surface& surface, const Vector<S>& z, const Vector<S>& u) {
    const Index n = surface.size();
    Vector<S> w = surface.normal_r.cwiseProduct(u.head(n)) + surface.normal_z.cwiseProduct(u.tail(n));
    const Vector<S> moment = surface.weight.cwiseProduct(z);
    const S velocity = moment.dot(w) / moment.dot(surface.normal_z);
    w -= velocity * surface.normal_z;
    return {velocity, std::move(w)};
}

}  // namespace detail

/// Policies of a scene. Every policy comes by value and is const afterwards, but for the solver and the wall, which may
/// keep factors between solves.
template <GreenKernel Kernel, DiscretizationFor<Kernel> Discretization, class Membrane, Background Flow,
          LinearSolver Solver, WallFor<Kernel, Discretization> Wall = NoWall>
requires MembraneFor<Membrane, typename Discretization::Surface, Solver>
class Scene {
  public:
    using Scalar = typename Kernel::Scalar;
    using Surface = typename Discretization::Surface;
    using InstantType = Instant<Scalar, Surface>;
    static constexpr bool deformable = Membrane::deformable;
    static constexpr bool confined = ConfiningKernel<Kernel> || Wall::present;

    Scene(Kernel kernel, Discretization discretization, Membrane membrane, Flow flow, Solver solver, Wall wall = {})
        : kernel_(std::move(kernel)),
          discretization_(std::move(discretization)),
          membrane_(std::move(membrane)),
          flow_(std::move(flow)),
          solver_(std::move(solver)),
          wall_(std::move(wall)) {}

    const Kernel& kernel() const { return kernel_; }
    const Discretization& discretization() const { return discretization_; }
    const Membrane& membrane() const { return membrane_; }
    const Flow& flow() const { return flow_; }
    const Solver& solver() const { return solver_; }
    const Wall& wall() const { return wall_; }

    /// What an evaluation needs of a configuration however implicit it is: the costly part.
    struct Frozen {
        Surface surface;
        Matrix<Scalar> mobility;
        Vector<Scalar> background;
        Vector<Scalar> load;
        Scalar shear_rate{};
    };

    Frozen freeze(const Configuration<Scalar>& configuration) {
        Frozen frozen;
        frozen.surface = discretization_.surface(configuration.shape);
        frozen.mobility = discretization_.single_layer(configuration.shape, kernel_);
        frozen.background = background_velocity(configuration);
        if constexpr (Wall::present) {
            Meridian<Scalar> particle = configuration.shape;
            particle.z.array() += configuration.position;
            wall_.confine(discretization_, kernel_, particle, frozen.mobility, frozen.background);
        }
        frozen.shear_rate = shear_rate(configuration.shape, frozen.background);
        frozen.load = normal_load(configuration, frozen.surface);
        return frozen;
    }

    /// Velocities with the membrane's forces taken at x + implicit_time * u (0: at x).
    /// Throws SimulationFailure when the system cannot be solved.
    InstantType evaluate(const Configuration<Scalar>& configuration, const Scalar& implicit_time) {
        return evaluate(freeze(configuration), configuration, implicit_time);
    }

    /// The same, for a configuration that is frozen already.
    InstantType evaluate(const Frozen& frozen, const Configuration<Scalar>& configuration,
                         const Scalar& implicit_time) {
        InstantType instant;
        instant.surface = frozen.surface;
        instant.shear_rate = frozen.shear_rate;
        const Surface& surface = frozen.surface;
        instant.solution =
            membrane_.solve(MobilityProblem<Scalar, Surface>{surface, frozen.mobility, frozen.background, frozen.load,
                                                             configuration.tension, implicit_time},
                            solver_);
        const auto [velocity, deformation] =
            detail::relative_normal_velocity<Scalar>(surface, configuration.shape.z, instant.solution.velocity);
        instant.velocity = velocity;
        instant.deformation_rate = deformation.cwiseAbs().maxCoeff();
        if constexpr (ConfiningKernel<Kernel>) {
            instant.pressure_drop = kernel_.pressure_drop(surface, instant.solution.force);
        }
        if constexpr (Wall::present) {
            instant.pressure_drop = wall_.pressure_drop(surface, instant.solution.force);
        }
        return instant;
    }

    /// A typical velocity of what drives the scene.
    Scalar velocity_scale() const {
        if constexpr (Wall::present) {
            return std::max<Scalar>(flow_.velocity_scale(), wall_.velocity_scale());
        } else {
            return flow_.velocity_scale();
        }
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

    /// Undisturbed velocity on the axis at the centroid.
    Scalar centreline_velocity(const Scalar& position) const {
        Scalar velocity = 0;
        if constexpr (Flow::has_flow) {
            velocity += flow_.velocity({Scalar(0), position}).z;
        }
        if constexpr (Wall::present) {
            velocity += wall_.centreline_velocity(position);
        }
        return velocity;
    }

    /// Distance of the wall from the axis at z in the laboratory frame; infinite without a wall.
    Scalar wall_radius(const Scalar& z) const {
        Scalar radius = std::numeric_limits<Scalar>::infinity();
        if constexpr (ConfiningKernel<Kernel>) {
            radius = kernel_.tube_radius();
        }
        if constexpr (Wall::present) {
            radius = std::min<Scalar>(radius, wall_.radius(z));
        }
        return radius;
    }

    /// Radial distances from the meridian to the wall; negative if a node is beyond it.
    FilmThickness<Scalar> film_thickness(const Configuration<Scalar>& configuration) const {
        using std::sqrt;
        FilmThickness<Scalar> film;
        if constexpr (confined) {
            const Meridian<Scalar>& shape = configuration.shape;
            const Scalar wide = shape.r.maxCoeff() * Scalar(0.9);
            const auto gap = [&](Index i) { return wall_radius(shape.z[i] + configuration.position) - shape.r[i]; };
            Scalar covered = 0;
            Scalar sum = 0;
            for (Index i = 0; i < shape.elements(); ++i) {
                film.min = std::min(film.min, gap(i + 1));
                // The part [a, b] of the element, of length 1, that is wide enough.
                const Scalar first = shape.r[i] - wide;
                const Scalar last = shape.r[i + 1] - wide;
                if (first < Scalar(0) && last < Scalar(0)) {
                    continue;
                }
                const Scalar a = first < Scalar(0) ? Scalar(first / (first - last)) : Scalar(0);
                const Scalar b = last < Scalar(0) ? Scalar(first / (first - last)) : Scalar(1);
                const Scalar dr = shape.r[i + 1] - shape.r[i];
                const Scalar dz = shape.z[i + 1] - shape.z[i];
                const Scalar arc = (b - a) * sqrt(dr * dr + dz * dz);
                covered += arc;
                sum += arc * (gap(i) + (gap(i + 1) - gap(i)) * (a + b) / 2);
            }
            film.mean = sum / covered;
        }
        return film;
    }

  private:
    static Scalar shear_rate(const Meridian<Scalar>& shape, const Vector<Scalar>& background) {
        using std::sqrt;
        Scalar largest = 0;
        if constexpr (Flow::has_flow) {
            const Index n = shape.nodes();
            for (Index i = 0; i + 1 < n; ++i) {
                const auto square = [](const Scalar& a, const Scalar& b) { return (a - b) * (a - b); };
                const Scalar du =
                    square(background[i + 1], background[i]) + square(background[n + i + 1], background[n + i]);
                const Scalar dx = square(shape.r[i + 1], shape.r[i]) + square(shape.z[i + 1], shape.z[i]);
                largest = std::max<Scalar>(largest, sqrt(du / dx));
            }
        }
        return largest;
    }

    Kernel kernel_;
    Discretization discretization_;
    Membrane membrane_;
    Flow flow_;
    Solver solver_;
    Wall wall_;
};

}  // namespace axistokes
