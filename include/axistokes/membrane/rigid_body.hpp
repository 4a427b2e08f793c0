// SPDX-License-Identifier: MIT
// Force-driven rigid body translating along the axis (a policy for the membrane model).
#pragma once

#include "../concepts.hpp"

namespace axistokes {

template <class S = double>
class RigidBody {
  public:
    using Scalar = S;
    static constexpr bool deformable = false;

    /// Traction f and velocity U of u_inf + G f = U e_z with Int f_z dA = Int load_z dA (load: the pressure jump whose
    /// resultant is the weight). f is determined up to a multiple of n, the kernel of G; its mean normal part is set to
    /// zero by adding n (dV/dx)^T / A to G.
    template <class Surface, class Solver>
    MobilitySolution<S> solve(const MobilityProblem<S, Surface>& problem, Solver& solver) const {
        const Surface& surface = problem.surface;
        const Index nodes = surface.size();
        const Index n = 2 * nodes;
        const Vector<S> normal = surface.normals();

        Matrix<S> system = Matrix<S>::Zero(n + 1, n + 1);
        system.topLeftCorner(n, n) = problem.mobility;
        system.topLeftCorner(n, n) += normal * surface.volume_gradient.transpose() / surface.area();
        Vector<S> rhs = Vector<S>::Zero(n + 1);
        rhs.head(n) = -problem.background_velocity;
        // On the axis u_r = 0 holds by symmetry and says nothing: f_r = 0 takes its place.
        for (const Index pole : {Index(0), nodes - 1}) {
            system.row(pole).setZero();
            system(pole, pole) = 1;
            rhs[pole] = 0;
        }
        system.col(n).segment(nodes, nodes).setConstant(S(-1));
        system.row(n).segment(nodes, nodes) = surface.weight.transpose();
        rhs[n] = surface.weight.dot(problem.load.tail(nodes));

        solver.factorize(system);
        const Vector<S> x = solver.solve(rhs);
        MobilitySolution<S> solution;
        solution.velocity = Vector<S>::Zero(n);
        solution.velocity.tail(nodes).setConstant(x[n]);
        solution.force = x.head(n);
        return solution;
    }
};

}  // namespace axistokes
