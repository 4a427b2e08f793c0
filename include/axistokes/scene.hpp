// SPDX-License-Identifier: MIT
// The quasi-static part of a simulation: given the shapes of the bodies, the velocities and forces on them.
#pragma once

#include "concepts.hpp"
#include "equation/motion.hpp"
#include "geometry/distance.hpp"
#include "wall/no_wall.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace axistokes {

/// Where a body is and the tension it had last; the meridian is relative to the centroid.
template <class S>
struct Configuration {
    Meridian<S> shape;
    S position{};       // axial coordinate of the centroid in the laboratory frame
    Vector<S> tension;  // empty before the first step
    /// Where the nodes' material was at the start, of a law that carries its reference; else empty.
    Meridian<S> reference{};
};

/// Everything known about one body at one instant. Velocities are in the laboratory frame.
template <class S, class Surface>
struct Instant {
    Surface surface;
    MobilitySolution<S> solution;
    Vector<S> node_velocity;  // relative to the centroid, stacked: that of the fluid, or, for a law without a
                              // constraint, its normal part
    S velocity{};             // of the centroid, along z
    /// Largest normal velocity relative to the centroid's: 0 in a stationary state.
    S deformation_rate{};
    /// Added by the body to the pressure drop along the tube or channel, in kappa/R0^3; 0 without one.
    S pressure_drop{};
    /// Largest difference of the undisturbed flow along an element over its length.
    S shear_rate{};
    /// Largest velocity of the undisturbed flow at a node.
    S undisturbed_speed{};
    /// Power of the body's forces in the flow that all bodies add to the undisturbed one: summed over the bodies it is
    /// the viscous dissipation of that flow, in kappa^2/(eta R0^3).
    S power{};
};

/// How close a body comes to the wall, and to other bodies, in R0; infinite where there are none.
template <class S>
struct FilmThickness {
    S min = std::numeric_limits<S>::infinity();
    /// Axial position of the thinnest place, in the laboratory frame.
    S where = std::numeric_limits<S>::quiet_NaN();
    /// Over the part of the meridian within 10 % of the largest radius, by arc length.
    S mean = std::numeric_limits<S>::infinity();
    S to_neighbour = std::numeric_limits<S>::infinity();
    /// Least pi l/spacing along the curve, l = sqrt(2h/h'') and h the film at the wall: how many nodes its forces vary
    /// over; and h/l there.
    S wall_nodes = std::numeric_limits<S>::infinity();
    S wall_slenderness = std::numeric_limits<S>::infinity();
};

/// The gap between two bodies at its narrowest, in R0.
template <class S>
struct Gap {
    S width = std::numeric_limits<S>::infinity();
    /// h/l, where l = sqrt(2h/h'') is the length over which the gap doubles.
    S slenderness{};
    /// pi l/spacing, of the nodes of the lower and of the upper body.
    S lower_nodes = std::numeric_limits<S>::infinity();
    S upper_nodes = std::numeric_limits<S>::infinity();
};

/// All of a state.
template <class S>
struct Films {
    std::vector<FilmThickness<S>> bodies;
    std::vector<Gap<S>> gaps;  // each body's to the next one
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

/// Int f.u dA of fields at the nodes, stacked.
template <class S, class Surface>
S power(const Surface& surface, const Vector<S>& force, const Vector<S>& velocity) {
    const Index n = surface.size();
    return surface.weight.dot(force.head(n).cwiseProduct(velocity.head(n)) +
                              force.tail(n).cwiseProduct(velocity.tail(n)));
}

template <class S>
Meridian<S> shifted(Meridian<S> shape, const S& along) {
    shape.z.array() += along;
    return shape;
}

/// Whether a body's chords meet those of the one that should lie above it.
template <class S>
bool meet(const Configuration<S>& below, const Configuration<S>& above) {
    const Meridian<S> a = shifted(below.shape, below.position);
    const Meridian<S> b = shifted(above.shape, above.position);
    for (Index i = 0; i < a.elements(); ++i) {
        for (Index j = 0; j < b.elements(); ++j) {
            if (segments_cross(Point<S>{a.r[i], a.z[i]}, {a.r[i + 1], a.z[i + 1]}, {b.r[j], b.z[j]},
                               {b.r[j + 1], b.z[j + 1]})) {
                return true;
            }
        }
    }
    return a.z[a.elements()] >= b.z[0];
}

}  // namespace detail

/// Policies of a scene, and the laws of its bodies: one for all, or one for each. Every policy comes by value and is
/// const afterwards, but for the solver and the wall, which may keep factors between solves.
template <GreenKernel Kernel, DiscretizationFor<Kernel> Discretization, class Law, Background Flow, LinearSolver Solver,
          WallFor<Kernel, Discretization> Wall = NoWall>
requires UsesScalarOf<Law, Kernel> && UsesScalarOf<Flow, Kernel> && UsesScalarOf<Solver, Kernel> &&
    LawsFor<Law, typename Discretization::Surface> && CarriesAlong<Discretization, Law>
class Scene {
  public:
    using Scalar = typename Kernel::Scalar;
    using Surface = typename Discretization::Surface;
    using InstantType = Instant<Scalar, Surface>;
    /// The bodies, in the order in which they lie along the axis.
    using State = std::vector<Configuration<Scalar>>;
    using Instants = std::vector<InstantType>;
    /// Whether there is a body whose shape can change.
    static constexpr bool deformable = detail::LawKinds<Law>::any_deformable;
    static constexpr bool confined = Kernel::has_images || Wall::present;
    static constexpr bool carries_reference = detail::LawKinds<Law>::any_carries_reference;

    /// One law for all bodies.
    Scene(Kernel kernel, Discretization discretization, Law law, Flow flow, Solver solver, Wall wall = {})
        : Scene(std::move(kernel), std::move(discretization), std::vector<Law>{std::move(law)}, std::move(flow),
                std::move(solver), std::move(wall)) {}

    /// A law for each body. Throws InvalidArgument if there is none, if the undisturbed flow does not vanish on the
    /// wall (then it is that of another one), or is so fast that its power overflows.
    template <std::same_as<std::vector<Law>> Laws>
    Scene(Kernel kernel, Discretization discretization, Laws laws, Flow flow, Solver solver, Wall wall = {})
        : kernel_(std::move(kernel)),
          discretization_(std::move(discretization)),
          laws_(std::move(laws)),
          flow_(std::move(flow)),
          solver_(solver),
          explicit_solver_(std::move(solver)),
          wall_(std::move(wall)) {
        detail::require(!laws_.empty(), "number of laws", laws_.size(), "at least 1");
        require_finite_power();
        require_rest_at_the_wall();
    }

    const Kernel& kernel() const { return kernel_; }
    const Discretization& discretization() const { return discretization_; }
    const Law& law(std::size_t body = 0) const { return laws_.size() == 1 ? laws_[0] : laws_.at(body); }
    const std::vector<Law>& laws() const { return laws_; }
    const Flow& flow() const { return flow_; }
    const Solver& solver() const { return solver_; }
    const Wall& wall() const { return wall_; }

    bool deforms(std::size_t body) const { return !detail::is_rigid(law(body)); }

    /// Asked before every evaluation, if there is one: false ends it, and whatever it is part of, with
    /// SimulationStopped.
    void proceed_while(std::function<bool()> proceed) { proceed_ = std::move(proceed); }
    const std::function<bool()>& proceed() const { return proceed_; }

    /// A body's share of what an evaluation needs.
    struct FrozenBody {
        Surface surface;
        Surface reference;  // of a law that carries one
        Vector<Scalar> load;
        Scalar shear_rate{};
        Scalar undisturbed_speed{};
    };
    /// What an evaluation needs of a state however implicit it is: the costly part. Matrix and vectors are those of all
    /// nodes, body after body.
    struct Frozen {
        std::vector<FrozenBody> bodies;
        Matrix<Scalar> mobility;
        Vector<Scalar> background;
        Vector<Scalar> unit_flow;  // undisturbed, of flow rate 1; empty outside channels
    };
    /// A state with all that is known about it.
    struct Moment {
        State bodies;
        Frozen frozen;
        Instants instants;
    };

    /// Throws SimulationFailure when nothing can be computed on the state, and SimulationStopped.
    Frozen freeze(const State& state) {
        if (proceed_ && !proceed_()) {
            throw SimulationStopped("stopped");
        }
        try {
            return frozen(state);
        } catch (const InvalidArgument& error) {
            // Of a kernel or a rule: the input was good, what the motion made of it is not.
            throw SimulationFailure(error.what());
        }
    }

    /// Velocities with the forces of the laws taken at x + implicit_time * u (0: at x).
    /// Throws SimulationFailure when the system cannot be solved.
    Instants evaluate(const State& state, const Scalar& implicit_time) {
        return evaluate(freeze(state), state, implicit_time);
    }
    /// Of a body that is alone.
    InstantType evaluate(const Configuration<Scalar>& configuration, const Scalar& implicit_time) {
        return std::move(evaluate(State{configuration}, implicit_time).front());
    }

    /// The same, for a state that is frozen already.
    Instants evaluate(const Frozen& frozen, const State& state, const Scalar& implicit_time) {
        std::vector<detail::EquationBody<Scalar, Surface, Law>> bodies;
        for (std::size_t b = 0; b < state.size(); ++b) {
            const FrozenBody& body = frozen.bodies[b];
            bodies.push_back({law(b), body.surface, body.load, state[b].tension, {}, &body.reference});
        }
        if constexpr (deformable) {
            add_slip(frozen, state, implicit_time, bodies);
        }
        detail::MotionEquation<Scalar, Surface, Law> equation(bodies, frozen.mobility, frozen.background,
                                                              implicit_time);
        // Two solvers: one that keeps factors finds a matrix like the last one.
        auto solutions = equation.solve(implicit_time == Scalar(0) ? explicit_solver_ : solver_);
        Instants instants(state.size());
        Index begin = 0;
        for (std::size_t b = 0; b < state.size(); ++b) {
            InstantType& instant = instants[b];
            instant.surface = frozen.bodies[b].surface;
            instant.shear_rate = frozen.bodies[b].shear_rate;
            instant.solution = std::move(solutions[b]);
            const auto [velocity, deformation] =
                detail::relative_normal_velocity<Scalar>(instant.surface, state[b].shape.z, instant.solution.velocity);
            instant.velocity = velocity;
            instant.node_velocity = node_velocity(b, instant, bodies[b].slip, deformation);
            instant.deformation_rate = deforms(b) ? deformation.cwiseAbs().maxCoeff() : Scalar(0);
            const Index n = state[b].shape.nodes();
            instant.undisturbed_speed = frozen.bodies[b].undisturbed_speed;
            instant.power = detail::power<Scalar>(instant.surface, instant.solution.force,
                                                  instant.solution.velocity - frozen.background.segment(begin, 2 * n));
            if (frozen.unit_flow.size() > 0) {
                // By the reciprocal theorem with the flow of unit flow rate.
                for (Index i = 0; i < n; ++i) {
                    instant.pressure_drop -=
                        instant.surface.weight[i] * (instant.solution.force[i] * frozen.unit_flow[begin + i] +
                                                     instant.solution.force[n + i] * frozen.unit_flow[begin + n + i]);
                }
            }
            begin += 2 * n;
        }
        return instants;
    }

    Moment moment(State state) {
        Moment moment;
        moment.frozen = freeze(state);
        moment.instants = evaluate(moment.frozen, state, Scalar(0));
        moment.bodies = std::move(state);
        return moment;
    }

    /// `elements` elements on the same curve, with the material that the law carries.
    Configuration<Scalar> redistributed(Configuration<Scalar> configuration, Index elements) const {
        if constexpr (carries_reference) {
            configuration.shape = discretization_.redistributed(configuration.shape, elements, configuration.reference);
        } else {
            configuration.shape = discretization_.redistributed(configuration.shape, elements);
        }
        configuration.tension.resize(0);
        return configuration;
    }
    /// The same number of elements, if their spacing has become too uneven; true if they were moved.
    bool redistribute(Configuration<Scalar>& configuration) const {
        if constexpr (carries_reference) {
            return discretization_.redistribute(configuration.shape, configuration.reference);
        } else {
            return discretization_.redistribute(configuration.shape);
        }
    }

    /// What the wall keeps between evaluations; empty if that is nothing.
    Vector<Scalar> memory() const {
        if constexpr (RemembersEvaluations<Wall>) {
            return wall_.memory();
        } else {
            return {};
        }
    }
    /// Goes on with what a scene like this one kept.
    void recall(const Vector<Scalar>& memory) {
        if constexpr (RemembersEvaluations<Wall>) {
            wall_.recall(memory);
        }
    }

    /// A typical velocity of what drives the scene.
    Scalar velocity_scale() const { return std::max<Scalar>(flow_.velocity_scale(), Scalar(wall_.velocity_scale())); }

    /// Undisturbed velocity at the nodes of one body, stacked, without a meshed wall's own flow.
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

    /// As WallFor::confine: `curves` at their places, layers on all of them.
    Vector<Scalar> confine(const std::vector<Meridian<Scalar>>& curves, Matrix<Scalar>& mobility,
                           Vector<Scalar>& background) {
        return wall_.confine(discretization_, kernel_, curves, mobility, background);
    }

    /// Undisturbed velocity on the axis.
    Scalar centreline_velocity(const Scalar& position) const {
        Scalar velocity = wall_.centreline_velocity(position);
        if constexpr (Flow::has_flow) {
            velocity += flow_.velocity({Scalar(0), position}).z;
        }
        return velocity;
    }

    /// Distance of a point of the laboratory frame from the wall, negative beyond it; infinite without one.
    Scalar gap(const Point<Scalar>& point) const {
        Scalar gap = wall_.gap(point);
        if constexpr (Kernel::has_images) {
            gap = std::min<Scalar>(gap, kernel_.gap(point));
        }
        return gap;
    }

    /// Distances from the curves of one body, or of all, to the wall; and of all to each other.
    FilmThickness<Scalar> film_thickness(const Configuration<Scalar>& configuration) const {
        FilmThickness<Scalar> film;
        if constexpr (confined) {
            const Meridian<Scalar> curve = discretization_.sampled(configuration.shape);
            film = film_along(curve, configuration.position);
            film.wall_nodes /= points_per_node(curve, configuration.shape);
        }
        return film;
    }
    Films<Scalar> films(const State& state) const {
        Films<Scalar> films;
        for (const Configuration<Scalar>& configuration : state) {
            films.bodies.push_back(film_thickness(configuration));
        }
        for (std::size_t b = 0; b + 1 < state.size(); ++b) {
            const Gap<Scalar> gap = gap_above(state, b);
            films.gaps.push_back(gap);
            films.bodies[b].to_neighbour = std::min(films.bodies[b].to_neighbour, gap.width);
            films.bodies[b + 1].to_neighbour = gap.width;
        }
        return films;
    }

    /// Between a body and the next one, of their curves.
    Gap<Scalar> gap_above(const State& state, std::size_t lower) const {
        const Configuration<Scalar>& a = state[lower];
        const Configuration<Scalar>& b = state[lower + 1];
        const Meridian<Scalar> below = discretization_.sampled(a.shape);
        const Meridian<Scalar> above =
            detail::shifted(discretization_.sampled(b.shape), Scalar(b.position - a.position));
        const ClosestApproach<Scalar> closest = closest_approach(below, above);
        const Scalar scale = detail::pi_value<Scalar>() * closest.length;
        return {closest.distance, closest.distance / closest.length,
                scale / (closest.first_spacing * points_per_node(below, a.shape)),
                scale / (closest.second_spacing * points_per_node(above, b.shape))};
    }

    /// Why nothing can be computed on a body; empty if something can. The curve between the nodes is checked too.
    std::string fault(const Configuration<Scalar>& configuration) const {
        const Meridian<Scalar>& shape = configuration.shape;
        std::string cause = detail::fault(shape);
        if (!cause.empty()) {
            return cause;
        }
        const Meridian<Scalar> curve = discretization_.sampled(shape);
        if (!(curve.r.segment(1, curve.nodes() - 2).minCoeff() > Scalar(0))) {
            return "the curve crosses the axis between two nodes";
        }
        if constexpr (confined) {
            const FilmThickness<Scalar> film = film_along(curve, configuration.position);
            if (!(film.min > Scalar(0))) {
                return "the curve crosses the wall at z = " + detail::text(film.where);
            }
        }
        return "";
    }

  private:
    void require_finite_power() const {
        using std::sqrt;
        const Scalar most = sqrt(std::numeric_limits<Scalar>::max()) / 10000;
        detail::require(velocity_scale() < most, "velocity scale of flow and wall", velocity_scale(),
                        ("less than " + detail::text(most)).c_str());
    }

    /// On the wall of a tube or channel, about the middle of the axis.
    void require_rest_at_the_wall() const {
        using std::abs;
        using std::isfinite;
        constexpr bool channel = Wall::present || requires(Point<Scalar> x) {
            kernel_.unit_flow(x);
        };
        if constexpr (channel && Flow::has_flow) {
            const Scalar radius = gap({Scalar(0), Scalar(0)});
            if (!(radius > Scalar(0)) || !isfinite(radius)) {
                return;
            }
            const Point<Scalar> u = flow_.velocity({radius, Scalar(0)});
            const Scalar speed = std::max<Scalar>(abs(u.r), abs(u.z));
            const Scalar rounding = 1000 * std::numeric_limits<Scalar>::epsilon() * flow_.velocity_scale();
            detail::require(speed <= rounding, "undisturbed velocity on the wall", speed, "0");
        }
    }

    /// For an implicit step of interfaces that flow along themselves: how, from the velocities at its start. In a
    /// stationary state of, say, a drop in a flow that part never stops.
    void add_slip(const Frozen& frozen, const State& state, const Scalar& implicit_time,
                  std::vector<detail::EquationBody<Scalar, Surface, Law>>& bodies) {
        bool slips = false;
        for (std::size_t b = 0; b < state.size(); ++b) {
            slips = slips || !detail::nodes_follow(law(b));
        }
        if (!slips || implicit_time == Scalar(0)) {
            return;
        }
        const Instants now = evaluate(frozen, state, Scalar(0));
        for (std::size_t b = 0; b < state.size(); ++b) {
            if (!detail::nodes_follow(law(b))) {
                bodies[b].slip = now[b].solution.velocity - now[b].node_velocity;
                bodies[b].slip.tail(state[b].shape.nodes()).array() -= now[b].velocity;
            }
        }
    }

    Vector<Scalar> node_velocity(std::size_t body, const InstantType& instant, const Vector<Scalar>& slip,
                                 const Vector<Scalar>& normal) const {
        const Index n = instant.surface.size();
        Vector<Scalar> v = instant.solution.velocity;
        v.tail(n).array() -= instant.velocity;
        if (slip.size() > 0) {
            return v - slip;
        }
        if (!detail::nodes_follow(law(body))) {
            v << instant.surface.normal_r.cwiseProduct(normal), instant.surface.normal_z.cwiseProduct(normal);
        }
        return v;
    }

    /// Coordinates of the nodes in the frame of the evaluation: the body's own if it is alone and the kernel does not
    /// mind.
    Scalar origin(const State& state) const { return Kernel::laboratory_frame ? Scalar(0) : state.front().position; }

    Frozen frozen(const State& state) {
        using std::sqrt;
        Frozen frozen;
        std::vector<Meridian<Scalar>> local;
        std::vector<Meridian<Scalar>> places;
        Index size = 0;
        const Scalar zero = origin(state);
        for (std::size_t b = 0; b < state.size(); ++b) {
            const Configuration<Scalar>& configuration = state[b];
            local.push_back(detail::shifted(configuration.shape, Scalar(configuration.position - zero)));
            places.push_back(detail::shifted(configuration.shape, configuration.position));
            FrozenBody body;
            body.surface =
                discretization_.surface(configuration.shape, deforms(b) ? SurfaceParts::all : SurfaceParts::metric);
            body.load = normal_load(configuration, body.surface);
            if constexpr (carries_reference) {
                if (detail::is_carrying(law(b))) {
                    body.reference = discretization_.surface(configuration.reference, SurfaceParts::metric);
                }
            }
            frozen.bodies.push_back(std::move(body));
            size += 2 * configuration.shape.nodes();
        }
        frozen.mobility = mobility(local, size);
        frozen.background.resize(size);
        Index begin = 0;
        for (const Configuration<Scalar>& configuration : state) {
            const Vector<Scalar> velocity = background_velocity(configuration);
            frozen.background.segment(begin, velocity.size()) = velocity;
            begin += velocity.size();
        }
        frozen.unit_flow = confine(places, frozen.mobility, frozen.background);
        if constexpr (requires(Point<Scalar> x) { kernel_.unit_flow(x); }) {
            add_unit_flow(places, size, frozen.unit_flow);
        }
        std::vector<detail::EquationBody<Scalar, Surface, Law>> bodies;
        begin = 0;
        for (std::size_t b = 0; b < state.size(); ++b) {
            FrozenBody& body = frozen.bodies[b];
            body.shear_rate = shear_rate(state[b].shape, frozen.background, begin);
            const Index n = state[b].shape.nodes();
            body.undisturbed_speed = sqrt(
                (frozen.background.segment(begin, n).cwiseAbs2() + frozen.background.segment(begin + n, n).cwiseAbs2())
                    .maxCoeff());
            bodies.push_back({law(b), body.surface, body.load, state[b].tension, {}});
            begin += 2 * n;
        }
        detail::complete_rank<Scalar>(bodies, frozen.mobility, frozen.background);
        return frozen;
    }

    Matrix<Scalar> mobility(const std::vector<Meridian<Scalar>>& bodies, Index size) const {
        if (bodies.size() == 1) {
            return discretization_.single_layer(bodies.front(), kernel_);
        }
        Matrix<Scalar> mobility(size, size);
        Index source = 0;
        for (const Meridian<Scalar>& body : bodies) {
            const Index columns = 2 * body.nodes();
            Index target = 0;
            for (const Meridian<Scalar>& other : bodies) {
                const Index rows = 2 * other.nodes();
                mobility.block(target, source, rows, columns) =
                    &body == &other ? discretization_.single_layer(body, kernel_)
                                    : discretization_.single_layer_at(other, body, kernel_);
                target += rows;
            }
            source += columns;
        }
        return mobility;
    }

    /// That of the kernel's tube, if it is one.
    void add_unit_flow(const std::vector<Meridian<Scalar>>& places, Index size, Vector<Scalar>& flow) const {
        using std::isfinite;
        if (!isfinite(kernel_.gap({Scalar(0), Scalar(0)}))) {
            return;
        }
        flow.resize(size);
        Index begin = 0;
        for (const Meridian<Scalar>& body : places) {
            const Index n = body.nodes();
            for (Index i = 0; i < n; ++i) {
                const Point<Scalar> u = kernel_.unit_flow({body.r[i], body.z[i]});
                flow[begin + i] = u.r;
                flow[begin + n + i] = u.z;
            }
            begin += 2 * n;
        }
    }

    static Scalar shear_rate(const Meridian<Scalar>& shape, const Vector<Scalar>& background, Index begin) {
        using std::sqrt;
        Scalar largest = 0;
        if constexpr (Flow::has_flow) {
            const Index n = shape.nodes();
            for (Index i = 0; i + 1 < n; ++i) {
                const Scalar dur = background[begin + i + 1] - background[begin + i];
                const Scalar duz = background[begin + n + i + 1] - background[begin + n + i];
                const Scalar dr = shape.r[i + 1] - shape.r[i];
                const Scalar dz = shape.z[i + 1] - shape.z[i];
                largest = std::max<Scalar>(largest, sqrt((dur * dur + duz * duz) / (dr * dr + dz * dz)));
            }
        }
        return largest;
    }

    static Scalar points_per_node(const Meridian<Scalar>& curve, const Meridian<Scalar>& shape) {
        return Scalar(curve.elements()) / Scalar(shape.elements());
    }

    /// Of the points of `curve`.
    FilmThickness<Scalar> film_along(const Meridian<Scalar>& curve, const Scalar& position) const {
        using std::sqrt;
        FilmThickness<Scalar> film;
        const Index n = curve.nodes();
        Vector<Scalar> gaps(n);
        for (Index i = 0; i < n; ++i) {
            gaps[i] = gap({curve.r[i], curve.z[i] + position});
            if (gaps[i] < film.min) {
                film.min = gaps[i];
                film.where = curve.z[i] + position;
            }
        }
        if (!(film.min < std::numeric_limits<Scalar>::infinity())) {
            return film;
        }
        const Scalar pi = detail::pi_value<Scalar>();
        Scalar least = std::numeric_limits<Scalar>::infinity();
        const Scalar wide = curve.r.maxCoeff() * Scalar(0.9);
        Scalar covered = 0;
        Scalar sum = 0;
        for (Index i = 0; i + 1 < n; ++i) {
            // Least of the parabola through three points, between them.
            if (i > 0) {
                const Scalar bend = gaps[i - 1] - 2 * gaps[i] + gaps[i + 1];
                const Scalar slope = (gaps[i + 1] - gaps[i - 1]) / 2;
                if (bend > Scalar(0) && gaps[i] <= gaps[i - 1] && gaps[i] <= gaps[i + 1]) {
                    film.min = std::min(film.min, Scalar(gaps[i] - slope * slope / (2 * bend)));
                }
                if (bend > Scalar(0) && gaps[i] > Scalar(0) && 2 * gaps[i] < bend * least * least) {
                    least = sqrt(2 * gaps[i] / bend);
                    film.wall_nodes = pi * least;
                    const Scalar dr = curve.r[i + 1] - curve.r[i - 1];
                    const Scalar dz = curve.z[i + 1] - curve.z[i - 1];
                    film.wall_slenderness = 2 * gaps[i] / (least * sqrt(dr * dr + dz * dz));
                }
            }
            // The part [a, b] of the chord, of length 1, that is wide enough.
            const Scalar first = curve.r[i] - wide;
            const Scalar last = curve.r[i + 1] - wide;
            if (first < Scalar(0) && last < Scalar(0)) {
                continue;
            }
            const Scalar a = first < Scalar(0) ? Scalar(first / (first - last)) : Scalar(0);
            const Scalar b = last < Scalar(0) ? Scalar(first / (first - last)) : Scalar(1);
            const Scalar dr = curve.r[i + 1] - curve.r[i];
            const Scalar dz = curve.z[i + 1] - curve.z[i];
            const Scalar arc = (b - a) * sqrt(dr * dr + dz * dz);
            covered += arc;
            sum += arc * (gaps[i] * (Scalar(1) - (a + b) / 2) + gaps[i + 1] * (a + b) / 2);
        }
        film.mean = sum / covered;
        return film;
    }

    Kernel kernel_;
    Discretization discretization_;
    std::vector<Law> laws_;
    Flow flow_;
    Solver solver_;
    Solver explicit_solver_;
    Wall wall_;
    std::function<bool()> proceed_;
};

template <class Kernel, class Discretization, class Law, class Flow, class Solver, class Wall = NoWall>
Scene(Kernel, Discretization, std::vector<Law>, Flow, Solver, Wall = {})
    -> Scene<Kernel, Discretization, Law, Flow, Solver, Wall>;

}  // namespace axistokes
