// SPDX-License-Identifier: MIT
// Inextensible fluid membrane with bending stiffness (a policy for the membrane model).
//
// Force density on the fluid, in kappa/R0^3 (Trozzo et al. 2015, eqs 3-5; bending energy 2 Int H^2 dA in kappa):
//   f = [2 Lap_s H + 4 H (H^2 - K)] n  -  2 gamma H n + grad_s gamma  +  load n,     div_s u = 0 fixes gamma.
#pragma once

#include "../concepts.hpp"
#include "flux.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axistokes {

template <class S = double>
class Vesicle {
  public:
    using Scalar = S;
    static constexpr bool deformable = true;

    /// Positions -> bending force density (2n x 2n), linear with the normals, metric and curvature factor of `surface`
    /// frozen: applied to the surface's own positions it is the bending force.
    template <class Surface>
    static typename Surface::Operator bending_operator(const Surface& surface) {
        using Operator = typename Surface::Operator;
        const auto& h = surface.mean_curvature;
        const Vector<S> factor = 4 * (h.cwiseAbs2() - surface.gauss_curvature);
        Operator scalar = S(2) * (surface.laplacian * surface.mean_curvature_of);
        scalar += Operator(factor.asDiagonal() * surface.mean_curvature_of);
        return surface.along_normal(scalar);
    }

    /// Bending and tension force density on `surface`, stacked.
    template <class Surface>
    static Vector<S> force(const Surface& surface, const Vector<S>& tension) {
        // As bending_operator, without products of matrices.
        const auto& h = surface.mean_curvature;
        const Vector<S> curvature = surface.mean_curvature_of * surface.positions();
        const Vector<S> scalar = S(2) * (surface.laplacian * curvature) +
                                 4 * (h.cwiseAbs2() - surface.gauss_curvature).cwiseProduct(curvature);
        Vector<S> force = surface.tension_force * tension;
        force.head(surface.size()) += surface.normal_r.cwiseProduct(scalar);
        force.tail(surface.size()) += surface.normal_z.cwiseProduct(scalar);
        return force;
    }

    /// Velocities, forces and tension of a vesicle. The unknowns are (u, gamma) of
    ///   u - t G F u - G T gamma = u_inf + G (F x + load),    D u = 0,
    /// with t = problem.implicit_time, F the bending operator and T, D the tension force and the divergence. Tension
    /// also resists the curvature created during the step, at its previous value, as far as that is positive.
    template <class Surface, class Solver>
    MobilitySolution<S> solve(const MobilityProblem<S, Surface>& problem, Solver& solver) const {
        using Operator = typename Surface::Operator;
        const Surface& surface = problem.surface;
        const Index n = 2 * surface.size();
        const Index tensions = surface.divergence.rows();
        const bool sphere = is_sphere(surface);
        const S time = problem.implicit_time;

        Matrix<S> g = problem.mobility;
        detail::complete_rank<S>(surface, g);
        const Operator bending = bending_operator(surface);
        Operator implicit = bending;
        if (problem.tension.size() == tensions) {
            const Vector<S> pull = -2 * positive_part(surface.at_nodes(problem.tension));
            implicit += surface.along_normal(Operator(pull.asDiagonal() * surface.mean_curvature_of));
        }

        const Index unknowns = n + tensions + (sphere ? 1 : 0);
        Matrix<S> system = Matrix<S>::Zero(unknowns, unknowns);
        system.topLeftCorner(n, n).setIdentity();
        if (time != S(0)) {
            system.topLeftCorner(n, n) -= time * (g * implicit);
        }
        system.block(0, n, n, tensions) = -(g * surface.tension_force);
        system.block(n, 0, tensions, n) = surface.divergence;
        if (sphere) {
            const Vector<S> rigidity = Vector<S>::Constant(surface.size(), S(-2 * saturated_resistance()));
            system.topLeftCorner(n, n) -=
                g * surface.along_normal(Operator(rigidity.asDiagonal() * surface.mean_curvature_of));
            // A uniform tension is a pressure, and dA/dt = 2 dV/dt = 0 makes one of the constraints redundant: fix the
            // mean tension and allow for the redundant constraint's O(h^2) error.
            system.block(n + tensions, n, 1, tensions) = surface.element_area.transpose() / surface.area();
            system.block(n, n + tensions, tensions, 1).setOnes();
        }
        const Vector<S> bending_now = bending * surface.positions();
        Vector<S> rhs = Vector<S>::Zero(unknowns);
        rhs.head(n) = detail::without_flux<S>(surface, problem.background_velocity) + g * (bending_now + problem.load);

        solver.factorize(system);
        const Vector<S> x = solver.solve(rhs);
        MobilitySolution<S> solution;
        solution.velocity = x.head(n);
        solution.tension = x.segment(n, tensions);
        solution.bending = bending_now + time * (bending * solution.velocity);
        solution.tension_force =
            surface.tension_force * solution.tension + time * ((implicit - bending) * solution.velocity);
        solution.force = solution.bending + solution.tension_force + problem.load;
        return solution;
    }

  private:
    /// A sphere has no area to spare: its tension grows without bound against any deformation, although div_s u = 0
    /// alone admits deformations to first order. The limit is a resistance to the rate of change of the curvature,
    /// large against the viscous one of the fluid (which is 1 in these units) and small enough for the type to resolve
    /// both.
    static S saturated_resistance() {
        using std::sqrt;
        return std::min<S>(S(1e5), S(0.1) / sqrt(std::numeric_limits<S>::epsilon()));
    }

    /// (gamma + sqrt(gamma^2 + m^2))/2 with m the mean of |gamma|: a kink would cost higher-order steps their order,
    /// and slightly negative tensions their stability.
    static Vector<S> positive_part(const Vector<S>& tension) {
        const S mean = tension.cwiseAbs().mean();
        return (tension + (tension.cwiseAbs2().array() + mean * mean).sqrt().matrix()) / 2;
    }

    /// Curvature variations of an excess area D are about sqrt(D); below 1e-6 the tension's mean is noise.
    template <class Surface>
    static bool is_sphere(const Surface& surface) {
        const auto& h = surface.mean_curvature;
        return h.maxCoeff() - h.minCoeff() < S(1e-3) * h.maxCoeff();
    }
};

}  // namespace axistokes
