// SPDX-License-Identifier: MIT
// What an interface is made of: the force density it exerts, and what constrains its motion. A law knows nothing about
// kernels, equations or solvers.
#pragma once

#include "../core.hpp"
#include "../geometry/meridian.hpp"

#include <concepts>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace axistokes {

/// What a law demands of its interface's motion: nothing; div_s u = 0, kept by a tension; or a rigid translation.
enum class Constraint { none, inextensible, rigid };

namespace detail {

template <class L>
concept NamedConstraint = requires {
    { L::constraint } -> std::convertible_to<Constraint>;
};

/// Stand for laws of the other kind where a concept asks about one kind: a disjunction would hide what is missing.
template <class S>
struct SomeRigidLaw {
    using Scalar = S;
    static constexpr Constraint constraint = Constraint::rigid;
    std::optional<S> velocity;
};
template <class S>
struct SomeDeformableLaw {
    using Scalar = S;
    static constexpr Constraint constraint = Constraint::none;
    static constexpr bool conserves_area = false;
    template <class Surface>
    Vector<S> force(const Surface&) const;
    template <class Surface>
    typename Surface::Operator linearisation(const Surface&, const Vector<S>&) const;
};
template <class S>
struct SomeCarryingLaw {
    using Scalar = S;
    template <class Surface>
    Vector<S> force(const Surface&, const Surface&) const;
    template <class Surface>
    typename Surface::Operator linearisation(const Surface&, const Surface&, const Vector<S>&) const;
};

/// Whether a law's force depends on where its material was at the start.
template <class L>
constexpr bool carries_reference = requires {
    requires bool(L::carries_reference);
};
template <class L>
using RigidOrSome = std::conditional_t<L::constraint == Constraint::rigid, L, SomeRigidLaw<typename L::Scalar>>;
template <class L>
using DeformableOrSome = std::conditional_t<L::constraint == Constraint::rigid || carries_reference<L>,
                                            SomeDeformableLaw<typename L::Scalar>, L>;
template <class L>
using CarryingOrSome = std::conditional_t<carries_reference<L>, L, SomeCarryingLaw<typename L::Scalar>>;

template <class L>
concept RigidLaw = requires(const L& law) {
    { law.velocity } -> std::convertible_to<std::optional<typename L::Scalar>>;
};

template <class L, class Surface>
concept DeformableLaw = requires(const L& law, const Surface& surface, const Vector<typename L::Scalar>& tension) {
    { L::conserves_area } -> std::convertible_to<bool>;
    { law.force(surface) } -> std::convertible_to<Vector<typename L::Scalar>>;
    { law.linearisation(surface, tension) } -> std::convertible_to<typename Surface::Operator>;
};

template <class L, class Surface>
concept CarryingLaw = requires(const L& law, const Surface& surface, const Surface& reference,
                               const Vector<typename L::Scalar>& tension) {
    { law.force(surface, reference) } -> std::convertible_to<Vector<typename L::Scalar>>;
    { law.linearisation(surface, reference, tension) } -> std::convertible_to<typename Surface::Operator>;
};

}  // namespace detail

/// LawFor<Surface>: the law of one body's interface.
///
/// `constraint` says what its motion must obey. A rigid body (Constraint::rigid) has nothing else but `velocity`, the
/// optional one it is given; without, its traction balances the background's load. Any other law has
/// - `force(surface)`, stacked [r; z]: its force density on the fluid at the nodes of `surface`, in kappa/R0^3, without
///   the background's load and without the tension that keeps an inextensible interface's area;
/// - `linearisation(surface, tension)`, an operator displacements -> change of that force, with which semi-implicit
/// steps
///   are stable; it need not be exact. `tension` is the constraint's, of the previous step, or empty;
/// - `conserves_area`: whether the interface's area is a constant of the motion. Its volume always is.
///
/// It may have `energy(discretization, shape)`, in kappa, of which the force is the derivative: the referee then holds
/// one against the other.
///
/// Elastic laws say `carries_reference = true`: their nodes follow the material, and both functions are given its
/// surface at the start, node by node, as a second argument: `force(surface, reference)`.
template <class L, class Surface>
concept LawFor = detail::NamedConstraint<L> && detail::RigidLaw<detail::RigidOrSome<L>> &&
    detail::DeformableLaw<detail::DeformableOrSome<L>, Surface> &&
    detail::CarryingLaw<detail::CarryingOrSome<L>, Surface>;

/// A body of one of several kinds, chosen at run time: a scene of OneOf<Vesicle<>, RigidBody<>> holds both.
template <class... Laws>
struct OneOf {
    using Scalar = std::common_type_t<typename Laws::Scalar...>;
    static_assert((std::is_same_v<typename Laws::Scalar, Scalar> && ...), "the laws have one scalar type");
    std::variant<Laws...> law;

    template <class L>
    OneOf(L chosen) : law(std::move(chosen)) {}
};

namespace detail {

/// The kinds a law stands for: itself, or those of OneOf.
template <class L>
struct LawKinds {
    static constexpr bool any_deformable = L::constraint != Constraint::rigid;
    static constexpr bool any_rigid = L::constraint == Constraint::rigid;
    static constexpr bool any_carries_reference = carries_reference<L>;

    template <class Use>
    static decltype(auto) visit(const L& law, const Use& use) {
        return use(law);
    }
};

template <class... Laws>
struct LawKinds<OneOf<Laws...>> {
    static constexpr bool any_deformable = (LawKinds<Laws>::any_deformable || ...);
    static constexpr bool any_rigid = (LawKinds<Laws>::any_rigid || ...);
    static constexpr bool any_carries_reference = (LawKinds<Laws>::any_carries_reference || ...);

    template <class Use>
    static decltype(auto) visit(const OneOf<Laws...>& law, const Use& use) {
        return std::visit(use, law.law);
    }
};

template <class L>
bool is_rigid(const L& law) {
    return LawKinds<L>::visit(
        law, [](const auto& kind) { return std::decay_t<decltype(kind)>::constraint == Constraint::rigid; });
}

/// Whether an interface's nodes follow it along itself. Without a constraint or a reference they need not: they move
/// along the normals.
template <class L>
bool nodes_follow(const L& law) {
    return LawKinds<L>::visit(law, [](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        return Kind::constraint != Constraint::none || carries_reference<Kind>;
    });
}

/// Whether one body's law is one of them.
template <class L>
bool is_carrying(const L& law) {
    return LawKinds<L>::visit(law, [](const auto& kind) { return carries_reference<std::decay_t<decltype(kind)>>; });
}

/// A deformable law's functions; `reference` is not null if the law carries one.
template <class Kind, class Surface>
auto force_of(const Kind& law, const Surface& surface, const Surface* reference) {
    if constexpr (carries_reference<Kind>) {
        return law.force(surface, *reference);
    } else {
        return law.force(surface);
    }
}
template <class Kind, class Surface, class S>
typename Surface::Operator linearisation_of(const Kind& law, const Surface& surface, const Surface* reference,
                                            const Vector<S>& tension) {
    if constexpr (carries_reference<Kind>) {
        return law.linearisation(surface, *reference, tension);
    } else {
        return law.linearisation(surface, tension);
    }
}

template <class L>
bool keeps_area(const L& law) {
    return LawKinds<L>::visit(law, [](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (Kind::constraint == Constraint::rigid) {
            return true;
        } else {
            return bool(Kind::conserves_area);
        }
    });
}

/// Empty if the law does not tell its energy.
template <class L, class Discretization, class S>
std::optional<S> energy_of(const L& law, const Discretization& discretization, const Meridian<S>& shape) {
    return LawKinds<L>::visit(law, [&](const auto& kind) -> std::optional<S> {
        if constexpr (requires { S(kind.energy(discretization, shape)); }) {
            return kind.energy(discretization, shape);
        } else {
            return std::nullopt;
        }
    });
}

/// The velocity that a rigid body is given; empty for others.
template <class L>
auto given_velocity(const L& law) {
    using S = typename L::Scalar;
    return LawKinds<L>::visit(law, [](const auto& kind) -> std::optional<S> {
        if constexpr (std::decay_t<decltype(kind)>::constraint == Constraint::rigid) {
            return kind.velocity;
        } else {
            return std::nullopt;
        }
    });
}

/// The force density on `surface` of a law that carries no reference; none for a rigid body.
template <class S, class L, class Surface>
Vector<S> elastic_force(const L& law, const Surface& surface) {
    return LawKinds<L>::visit(law, [&](const auto& kind) -> Vector<S> {
        if constexpr (std::decay_t<decltype(kind)>::constraint == Constraint::rigid) {
            return Vector<S>::Zero(2 * surface.size());
        } else {
            return kind.force(surface);
        }
    });
}

/// The law itself, or of OneOf several the first that does not fit.
template <class Surface, class... Laws>
struct FirstMisfit;
template <class Surface, class L>
struct FirstMisfit<Surface, L> {
    using type = L;
};
template <class Surface, class L, class... Others>
struct FirstMisfit<Surface, L, Others...>
    : std::conditional_t<LawFor<L, Surface>, FirstMisfit<Surface, Others...>, FirstMisfit<Surface, L>> {};
template <class Surface, class... Laws>
struct FirstMisfit<Surface, OneOf<Laws...>> : FirstMisfit<Surface, Laws...> {};

}  // namespace detail

/// A law that fits, or OneOf several that do.
template <class L, class Surface>
concept LawsFor = LawFor<typename detail::FirstMisfit<Surface, L>::type, Surface>;

}  // namespace axistokes
