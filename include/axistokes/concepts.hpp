// SPDX-License-Identifier: MIT
// What a policy must offer to take part in a Simulator: one concept per policy, its contract in the paragraph above it.
#pragma once

#include "core.hpp"
#include "geometry/measures.hpp"
#include "geometry/meridian.hpp"
#include "membrane/law.hpp"
#include "quadrature/regular_quadrature.hpp"

#include <concepts>
#include <type_traits>
#include <vector>

namespace axistokes {

namespace detail {

/// Stands for the quadrature that a discretisation hands to a kernel's images.
template <class S>
struct AnyQuadrature {
    RegularQuadrature<S> operator()(const S&) const;
};

/// Stands for a kernel with images where the concept asks about one: a disjunction would hide what is missing.
template <class S>
struct SomeImages {
    using Scalar = S;
    S gap(const Point<S>&) const;
    template <class Quadrature>
    void regular(const Meridian<S>&, const Quadrature&, Matrix<S>&) const;
};
template <class K>
using ImagedOrSome = std::conditional_t<K::has_images, K, SomeImages<typename K::Scalar>>;

template <class K>
concept KernelWithImages = requires(const K& kernel, const Point<typename K::Scalar>& point,
                                    const Meridian<typename K::Scalar>& targets, Matrix<typename K::Scalar>& out) {
    { kernel.gap(point) } -> std::convertible_to<typename K::Scalar>;
    { kernel.regular(targets, AnyQuadrature<typename K::Scalar>{}, out) } -> std::same_as<void>;
};

}  // namespace detail

/// GreenKernel: the velocity M_ab(x0, x) at a target due to a ring of forces, without the factor 1/(8 pi), with the
/// ring's Jacobian r. The singular part, pairwise, carries the free-space logarithm log(m1): `singular` evaluates it
/// for arrays of sources, `singular_split` as smooth + log_coefficient log(m1).
///
/// A kernel with `has_images` = true additionally has the smooth part that a wall adds (imaged.hpp composes one from
/// images of your own): `gap(point)` is a point's distance from the wall, its image lies twice as far;
/// `regular(targets, quadrature, out)` adds the smooth part for all points at once. `laboratory_frame` tells whether it
/// depends on where along the axis target and source are, not only on their distance. An optional `unit_flow(point)` is
/// the undisturbed flow of flow rate 1 through a tube: scenes then have a pressure drop.
template <class K>
concept GreenKernel = requires(const K& kernel, Point<typename K::Scalar> target, const typename K::Scalar* coordinate,
                               Index count, KernelArrays<typename K::Scalar> out) {
    { K::has_images } -> std::convertible_to<bool>;
    { K::laboratory_frame } -> std::convertible_to<bool>;
    { kernel.singular(target, coordinate, coordinate, count, out) } -> std::same_as<void>;
    { kernel.singular_split(target, coordinate, coordinate, count, out, out) } -> std::same_as<void>;
}
&&detail::KernelWithImages<detail::ImagedOrSome<K>>;

/// DiscretizationFor<Kernel>: nodes on the meridian and the operators on them. `surface(meridian, parts)` gives the
/// frozen geometry: nodal weights of Int dA, outward normals, and, if they are wanted, curvatures and the linear
/// operators (Laplacian, divergence, tension force) as matrices of whatever type multiplies vectors.
/// `single_layer(meridian, kernel)` is the matrix from nodal force densities, stacked [r; z], to nodal velocities;
/// `single_layer_at` the same for targets off the surface. The curve between the nodes is the discretisation's too:
/// `measures`, `max_radius`, `bending_energy` and `pole_curvatures` of it, points of it in `sampled(shape)`,
/// `restore(shape, area, volume)` and `restore(shape, volume)` after a step, and `redistribute(shape)` when the nodes
/// have drifted; the last three tell whether they did.
template <class D, class Kernel>
concept DiscretizationFor = GreenKernel<Kernel> && std::same_as<typename D::Scalar, typename Kernel::Scalar> &&
    requires(const D& discretization, const Meridian<typename D::Scalar>& meridian, const Kernel& kernel) {
    typename D::Surface;
    { discretization.surface(meridian, SurfaceParts::all) } -> std::same_as<typename D::Surface>;
    { discretization.single_layer(meridian, kernel) } -> std::convertible_to<Matrix<typename D::Scalar>>;
    { discretization.single_layer_at(meridian, meridian, kernel) } -> std::convertible_to<Matrix<typename D::Scalar>>;
} && requires(const D& discretization, Meridian<typename D::Scalar>& shape, typename D::Scalar value) {
    { discretization.measures(shape) } -> std::convertible_to<Measures<typename D::Scalar>>;
    { discretization.max_radius(shape) } -> std::convertible_to<typename D::Scalar>;
    { discretization.bending_energy(shape) } -> std::convertible_to<typename D::Scalar>;
    { discretization.sampled(shape) } -> std::convertible_to<Meridian<typename D::Scalar>>;
    { discretization.restore(shape, value, value) } -> std::convertible_to<bool>;
    { discretization.restore(shape, value) } -> std::convertible_to<bool>;
    { discretization.redistribute(shape) } -> std::convertible_to<bool>;
};

/// Whether a discretisation carries along what the law needs: its `redistribute(shape, carried)` and
/// `redistributed(shape, elements, carried)` give another meridian on the same nodes (or an empty one) the new nodes
/// too.
template <class D, class Law>
concept CarriesAlong = !detail::LawKinds<Law>::any_carries_reference ||
                       requires(const D& discretization, Meridian<typename D::Scalar>& shape,
                                Meridian<typename D::Scalar>& carried, Index elements) {
    { discretization.redistribute(shape, carried) } -> std::convertible_to<bool>;
    { discretization.redistributed(shape, elements, carried) } -> std::convertible_to<Meridian<typename D::Scalar>>;
};

/// Background: what drives the scene. `velocity(point)` is the undisturbed flow, `normal_load(point)` the normal force
/// density on the membrane (gravity); has_flow and has_load tell which of the two exist, and what does not exist is
/// never evaluated. `velocity_scale()` is a typical velocity, by which the stationarity residual is measured.
template <class B>
concept Background = requires(const B& background, Point<typename B::Scalar> point) {
    { B::has_flow } -> std::convertible_to<bool>;
    { B::has_load } -> std::convertible_to<bool>;
    { background.velocity(point) } -> std::same_as<Point<typename B::Scalar>>;
    { background.normal_load(point) } -> std::convertible_to<typename B::Scalar>;
    { background.velocity_scale() } -> std::convertible_to<typename B::Scalar>;
};

/// All policies of a scene compute with the kernel's scalar type.
template <class Policy, class Kernel>
concept UsesScalarOf = std::same_as<typename Policy::Scalar, typename Kernel::Scalar>;

/// LinearSolver: `factorize(A)` prepares a square dense matrix, `solve(b)` returns x with A x = b. Both throw
/// SimulationFailure when the matrix is singular or an iteration does not converge.
template <class L>
concept LinearSolver = requires(L& solver, const Matrix<typename L::Scalar>& a, const Vector<typename L::Scalar>& b) {
    { solver.factorize(a) } -> std::same_as<void>;
    { solver.solve(b) } -> std::convertible_to<Vector<typename L::Scalar>>;
};

/// WallFor<Kernel, Discretization>: a wall with unknown tractions of its own. `confine` eliminates them: it turns the
/// mobility and the background velocity at the nodes of all bodies, in the wall's absence, into those in its presence,
/// for bodies given in the laboratory frame, and returns the undisturbed flow of unit flow rate at the nodes (empty if
/// the wall is no channel). `gap(point)` is a point's radial distance from the wall, negative beyond it,
/// `velocity_scale()` a typical velocity of the flow that the wall brings with it and `centreline_velocity(z)` that
/// flow's on the axis (both 0 if the background is the only flow). NoWall is the wall that is not there.
template <class W, class Kernel, class Discretization>
concept WallFor = requires(W& wall, const Discretization& discretization, const Kernel& kernel,
                           const std::vector<Meridian<typename Kernel::Scalar>>& bodies,
                           Matrix<typename Kernel::Scalar>& mobility, Vector<typename Kernel::Scalar>& background,
                           typename Kernel::Scalar z, Point<typename Kernel::Scalar> point) {
    { W::present } -> std::convertible_to<bool>;
    {
        wall.confine(discretization, kernel, bodies, mobility, background)
        } -> std::convertible_to<Vector<typename Kernel::Scalar>>;
    { wall.gap(point) } -> std::convertible_to<typename Kernel::Scalar>;
    { wall.velocity_scale() } -> std::convertible_to<typename Kernel::Scalar>;
    { wall.centreline_velocity(z) } -> std::convertible_to<typename Kernel::Scalar>;
};

/// A wall on whose earlier evaluations later ones depend: `memory()` is all that they do, in numbers, and
/// `recall(memory)` makes an equal wall go on from there.
template <class W>
concept RemembersEvaluations = requires(W& wall, const W& constant, const Vector<typename W::Scalar>& memory) {
    { constant.memory() } -> std::convertible_to<Vector<typename W::Scalar>>;
    wall.recall(memory);
};

}  // namespace axistokes
