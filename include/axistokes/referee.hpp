// SPDX-License-Identifier: MIT
// Whether what was computed on a state can be true: bounds that physics sets, and what two ways of computing the same
// must agree on (docs/referee.md).
#pragma once

#include "accuracy/resolution.hpp"
#include "geometry/necks.hpp"
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace axistokes {

/// What a referee finds on a state.
template <class S>
struct Verdict {
    /// Power of the bodies' forces minus those of weight and of the energy that the membranes release, which are all
    /// there is, over the sum of those two, the energy times the rate at which the shape changes (at least 1: smaller
    /// ones are not known better) and, in a flow, the dissipation of the disturbance.
    S power_mismatch{};
    /// Largest share of the last modes, of a discretisation that tells.
    S unresolved{};
    /// Why the numbers cannot be true; empty if nothing speaks against them.
    std::string fault{};
};

/// Judges states of a scene: their velocities and forces, not how they came about.
template <class SceneType>
class Referee {
  public:
    using S = typename SceneType::Scalar;
    using State = typename SceneType::State;
    using Instants = typename SceneType::Instants;

    /// The most that powers may differ by, relative to Verdict's scale, and that the last modes may have; by how much
    /// the bound on velocities may be missed; and the fraction of an element that a neck may be thin.
    static constexpr double largest_mismatch = 0.1;
    static constexpr double largest_unresolved = 0.3;
    static constexpr double slack = 0.05;
    static constexpr double thinnest = 0.1;

    explicit Referee(const SceneType& scene) : scene_(scene) {}

    /// `starts`: initial shapes may be too coarse for a few steps, until their finest details are gone; velocities have
    /// their bounds even then.
    Verdict<S> judge(const State& state, const Instants& instants, bool starts = false) const {
        using std::abs;
        Verdict<S> verdict;
        const Balance balance = balance_of(state, instants);
        verdict.power_mismatch = abs(balance.mismatch()) / balance.scale;
        if constexpr (JudgesItself<std::decay_t<decltype(scene_.discretization())>>) {
            for (std::size_t b = 0; b < state.size() && judges_itself(scene_.discretization()); ++b) {
                if (scene_.deforms(b)) {
                    verdict.unresolved =
                        std::max<S>(verdict.unresolved, scene_.discretization().unresolved(state[b].shape));
                }
            }
        }
        verdict.fault = fault(state, instants, balance, resolved(verdict) || starts, verdict);
        return verdict;
    }

    /// Whether the elements carry the shape.
    static bool resolved(const Verdict<S>& verdict) {
        return verdict.power_mismatch <= S(largest_mismatch) && verdict.unresolved <= S(largest_unresolved);
    }

  private:
    /// Of all bodies.
    struct Balance {
        S power{};     // of all forces
        S released{};  // elastic energy in unit time
        S scale = std::numeric_limits<S>::min();
        S weight{};                                       // sum of |F|
        S weight_power{};                                 // sum of F U
        S smallest = std::numeric_limits<S>::infinity();  // radius of the sphere of a body's volume
        S undisturbed_speed{};
        bool given_velocity = false;

        /// What moves bodies of given velocities has a power of its own.
        S mismatch() const { return given_velocity ? S(0) : S(power - weight_power - released); }
    };

    Balance balance_of(const State& state, const Instants& instants) const {
        using std::abs;
        using std::cbrt;
        Balance balance;
        for (std::size_t b = 0; b < state.size(); ++b) {
            const auto& instant = instants[b];
            const auto& surface = instant.surface;
            const Index n = surface.size();
            balance.given_velocity = balance.given_velocity || detail::given_velocity(scene_.law(b)).has_value();
            balance.undisturbed_speed = std::max(balance.undisturbed_speed, undisturbed_speed(state[b], instant));
            balance.power += detail::power<S>(surface, instant.solution.force, instant.solution.velocity);
            balance.scale += instant.undisturbed_speed > S(0) ? S(abs(instant.power)) : S(0);
            Vector<S> places(2 * n);
            places << state[b].shape.r, state[b].shape.z;
            const S volume = surface.volume_gradient.dot(places) / 3;
            balance.smallest = std::min(balance.smallest, S(cbrt(3 * volume / (4 * detail::pi_value<S>()))));
            const S weight = surface.weight.dot(Vector<S>(scene_.normal_load(state[b], surface).tail(n)));
            balance.weight += abs(weight);
            balance.weight_power += weight * instant.velocity;
            if constexpr (SceneType::deformable) {
                if (scene_.deforms(b)) {
                    const auto [released, pace] = energy_released(state[b], instant, b);
                    balance.released += released;
                    balance.scale += pace;
                }
            }
        }
        balance.scale += abs(balance.weight_power) + abs(balance.released);
        return balance;
    }

    /// Largest velocity of the undisturbed flow on the body, and on the axis inside it.
    template <class Instant>
    S undisturbed_speed(const Configuration<S>& body, const Instant& instant) const {
        using std::abs;
        S speed = instant.undisturbed_speed;
        for (Index i = 0; i < body.shape.nodes(); ++i) {
            const S along = scene_.centreline_velocity(S(body.position + body.shape.z[i]));
            speed = std::max(speed, S(abs(along)));
        }
        return speed;
    }

    /// The rate at which a body's energy falls, or, if its law does not tell, the power of its forces; and the energy
    /// times the rate at which the shape changes by R0, or at which bending would change it.
    template <class Instant>
    std::pair<S, S> energy_released(const Configuration<S>& body, const Instant& instant, std::size_t b) const {
        using std::abs;
        using std::pow;
        const S speed = instant.node_velocity.cwiseAbs().maxCoeff();
        // The curvature's rounding over this distance, and the distance over the smallest radii, are both small.
        const S step = speed > S(0) ? S(pow(std::numeric_limits<S>::epsilon(), S(0.3)) / speed) : S(0);
        const auto energy_after = [&](const S& time) {
            const Index n = body.shape.nodes();
            Meridian<S> shape = body.shape;
            shape.r += time * instant.node_velocity.head(n);
            shape.z += time * instant.node_velocity.tail(n);
            return detail::energy_of(scene_.law(b), scene_.discretization(), shape);
        };
        const auto before = energy_after(-step);
        if (!before) {
            const S elastic = detail::power<S>(instant.surface, instant.solution.elastic, instant.solution.velocity);
            return {elastic, abs(elastic)};
        }
        const S after = *energy_after(step);
        // An energy of second derivatives is known to eps n^2.
        const S n = S(body.shape.elements());
        const S blur = 20 * n * n * pow(std::numeric_limits<S>::epsilon(), S(0.7));
        return {speed > S(0) ? S((*before - after) / (2 * step)) : S(0), S((1 + blur) * after * std::max(speed, S(1)))};
    }

    std::string fault(const State& state, const Instants& instants, const Balance& balance, bool resolved,
                      const Verdict<S>& verdict) const {
        std::ostringstream cause;
        if (!resolved) {
            cause << "the elements do not carry the shape: the power of the forces is " << balance.power
                  << ", that of weight and elastic energy " << balance.weight_power + balance.released
                  << ", the share of the last modes " << verdict.unresolved;
        } else if (!balance.given_velocity) {
            speed_fault(state, instants, balance, cause);
        }
        if (cause.str().empty()) {
            thickness_fault(state, cause);
        }
        return cause.str();
    }

    /// With D the dissipation, W the sum of F U, P the energy released and R the radius of the smallest body's volume,
    /// in any domain: D = W + P >= 0, and U^2 <= 3 D/(10 pi R), for 3/(10 pi R) is the mean velocity of a ball of fluid
    /// under a force 1 if the Stokeslet were 1/(4 pi r), which is more than it is (Riesz). For one body in an unbounded
    /// fluid D >= F^2/(6 pi R), R the radius of a sphere around it.
    void speed_fault(const State& state, const Instants& instants, const Balance& balance,
                     std::ostringstream& cause) const {
        using std::abs;
        using std::sqrt;
        const S mobility = 3 / (10 * detail::pi_value<S>() * balance.smallest);
        const S released = std::max(S(0), balance.released) + S(largest_mismatch) * balance.scale;
        const S most = balance.undisturbed_speed + mobility * balance.weight + sqrt(mobility * released);
        for (const auto& instant : instants) {
            const S speed = abs(instant.velocity);
            if (!(speed <= (1 + S(slack)) * most + rounding(balance))) {
                cause << "a velocity of " << instant.velocity << " exceeds " << most
                      << ", the most that flow, weight and elastic energy can cause";
                return;
            }
        }
        if (balance.undisturbed_speed > S(0)) {
            return;
        }
        const S dissipation = balance.weight_power + balance.released;
        S least = 0;
        if (state.size() == 1 && unbounded(state.front())) {
            least = balance.weight * balance.weight / (6 * detail::pi_value<S>() * radius_around(state.front().shape));
        }
        if (!(dissipation >= least - S(largest_mismatch) * balance.scale)) {
            cause << "weight and elastic energy have a power of " << dissipation << ", less than " << least
                  << ", the least that moving through the fluid takes";
        }
    }

    /// A velocity that is rounding.
    S rounding(const Balance& balance) const {
        using std::sqrt;
        return sqrt(std::numeric_limits<S>::epsilon()) * (1 + balance.weight);
    }

    bool unbounded(const Configuration<S>& body) const {
        using std::isfinite;
        return !SceneType::confined || !isfinite(scene_.gap({S(0), body.position}));
    }

    /// Of a sphere around the body, about the middle of its axis.
    static S radius_around(const Meridian<S>& shape) {
        using std::sqrt;
        const S middle = (shape.z[0] + shape.z[shape.elements()]) / 2;
        return sqrt(S((shape.r.array().square() + (shape.z.array() - middle).square()).maxCoeff()));
    }

    /// Of bodies that could still become thinner.
    void thickness_fault(const State& state, std::ostringstream& cause) const {
        for (std::size_t b = 0; b < state.size(); ++b) {
            if (!scene_.deforms(b)) {
                continue;
            }
            const Meridian<S>& shape = state[b].shape;
            const auto neck = thinnest_neck(shape);
            const auto contact = unresolved_contact(shape);
            if (neck && neck->radius < S(thinnest) * neck->element) {
                cause << "the membrane pinches off at z = " << neck->z + state[b].position
                      << ": the radius of its neck, " << neck->radius << ", is less than a tenth of an element, "
                      << neck->element;
                return;
            }
            if (contact) {
                cause << "the membrane touches itself at r = " << contact->point.r
                      << ", z = " << contact->point.z + state[b].position << ": the distance of two parts, "
                      << contact->distance << ", is less than half of an element, " << contact->element;
                return;
            }
        }
    }

    const SceneType& scene_;
};

}  // namespace axistokes
