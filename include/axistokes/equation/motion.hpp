// SPDX-License-Identifier: MIT
// The one place where the equations of a scene's bodies are assembled and solved (docs/vesicle.md).
//
// With G the single layer of all nodes of all bodies, the velocities are u = u_inf + G f, and each body adds what its
// law says of f and u:
//   law          f = f(x) + load + t F (u - slip),   t the implicit time, F the law's linearisation,
//   inextensible f += T gamma,  D u = 0,         T, D the surface's tension force and divergence,
//   rigid        u = U e_z,                      U given, or Int f_z dA = Int load_z dA.
// Unknowns are u where f depends on it, gamma, and f and U of a rigid body: with y all of them, u = u_0 + V y.
//
// G maps normals to 0 and creates no flux through closed surfaces; a discrete one does so up to its error, which would
// act as an arbitrary pressure and as a leak: G is corrected for both at deformable bodies. The traction of a rigid
// body is determined up to a multiple of n: its mean normal part is set to zero by adding n (dV/dx)^T / A to G.
#pragma once

#include "../membrane/law.hpp"
#include "../operators.hpp"
#include "flux.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace axistokes {

/// Velocities and forces of one body; vectors are stacked [r; z] except the tension, which lives where the surface puts
/// it. Empty where the law has no such thing.
template <class S>
struct MobilitySolution {
    Vector<S> velocity;
    Vector<S> force;    // total force density of the body on the fluid, the background's load included
    Vector<S> elastic;  // the law's part of it: the bending force of a vesicle
    Vector<S> tension;
};

namespace detail {

/// A body in the equations: its law, its frozen surface, the background's force density on it, and the tension of the
/// step before, or an empty vector. `slip` (empty: none) is the part of the velocity that its nodes do not follow: an
/// interface that flows along itself has the shape at x + t (u - slip), not that at x + t u with frozen normals.
template <class S, class Surface, class Law>
struct EquationBody {
    const Law& law;
    const Surface& surface;
    const Vector<S>& load;
    const Vector<S>& tension;
    Vector<S> slip{};
    const Surface* reference = nullptr;  // of a law that carries one
};

/// Resistance of a sphere, which has no area to spare: its tension grows without bound against any deformation,
/// although div_s u = 0 alone admits deformations to first order. The limit is a resistance to the rate of change of
/// the curvature, large against the viscous one of the fluid (which is 1 in these units) and small enough for the type
/// to resolve both.
template <class S>
S saturated_resistance() {
    using std::sqrt;
    return std::min<S>(S(1e5), S(0.1) / sqrt(std::numeric_limits<S>::epsilon()));
}

/// Curvature variations of an excess area D are about sqrt(D); below 1e-6 the tension's mean is noise.
template <class Surface>
bool is_sphere(const Surface& surface) {
    using S = typename decltype(surface.mean_curvature)::Scalar;
    const auto& h = surface.mean_curvature;
    return h.maxCoeff() - h.minCoeff() < S(1e-3) * h.maxCoeff();
}

/// Corrections of `mobility` and of the background velocity for what the discrete single layer gets wrong.
template <class S, class Surface, class Law>
void complete_rank(const std::vector<EquationBody<S, Surface, Law>>& bodies, Matrix<S>& mobility,
                   Vector<S>& background) {
    Index begin = 0;
    for (const auto& body : bodies) {
        const Index n = 2 * body.surface.size();
        if (!is_rigid(body.law)) {
            ignore_pressure<S>(body.surface, begin, mobility);
        } else if constexpr (LawKinds<Law>::any_rigid) {
            const Vector<S> normal = body.surface.normals();
            const Vector<S> mean = body.surface.volume_gradient / body.surface.area();
            for (Index j = 0; j < n; ++j) {
                part_of_column(mobility, begin, begin + j, n) += mean[j] * normal;
            }
        }
        begin += n;
    }
    begin = 0;
    for (const auto& body : bodies) {
        const Index n = 2 * body.surface.size();
        if (!is_rigid(body.law)) {
            stop_flux<S>(body.surface, begin, mobility);
            background.segment(begin, n) = without_flux<S>(body.surface, Vector<S>(background.segment(begin, n)));
        }
        begin += n;
    }
}

/// Solves for the motion at one instant, or over an implicit step.
template <class S, class Surface, class Law>
class MotionEquation {
    using Operator = typename Surface::Operator;
    using Kinds = LawKinds<Law>;

  public:
    using Body = EquationBody<S, Surface, Law>;

    /// `mobility` and `background` are complete.
    MotionEquation(const std::vector<Body>& bodies, const Matrix<S>& mobility, const Vector<S>& background,
                   const S& implicit_time);

    template <class Solver>
    std::vector<MobilitySolution<S>> solve(Solver& solver);

  private:
    static constexpr Index none = -1;

    /// What a body adds. Indices into the unknowns, `none` where it has no such unknowns.
    struct Part {
        Index begin = 0;  // of its nodes
        Index velocity = none;
        Index tension = none;
        Index slack = none;  // of a sphere's redundant constraint
        Index force = none;
        Index speed = none;
        std::optional<S> given_speed;
        Vector<S> elastic;
        Vector<S> given_force;  // f(x) + load
        Operator of_velocity;   // t F, and a sphere's resistance
    };

    Index take(Index count) {
        unknowns_ += count;
        return unknowns_ - count;
    }

    template <class Kind>
    void part(const Kind& law, const Body& body, const S& time, Part& p) {
        const Surface& surface = body.surface;
        if constexpr (Kind::constraint == Constraint::rigid) {
            p.force = take(2 * surface.size());
            p.given_speed = law.velocity;
            if (!p.given_speed) {
                p.speed = take(1);
            }
        } else {
            p.elastic = force_of(law, surface, body.reference);
            p.given_force = p.elastic + body.load;
            constexpr bool inextensible = Kind::constraint == Constraint::inextensible;
            const bool saturated = inextensible && is_sphere(surface);
            if (time != S(0)) {
                p.of_velocity = scaled(time, linearisation_of(law, surface, body.reference, body.tension));
                if (body.slip.size() > 0) {
                    p.given_force -= applied(p.of_velocity, body.slip);
                }
            }
            if (saturated) {
                const Vector<S> resistance = Vector<S>::Constant(surface.size(), S(-2 * saturated_resistance<S>()));
                const Operator rigidity = surface.along_normal(rows_scaled(resistance, surface.mean_curvature_of));
                p.of_velocity = p.of_velocity.rows() > 0 ? Operator(sum(p.of_velocity, rigidity)) : rigidity;
            }
            if (p.of_velocity.rows() > 0) {
                p.velocity = take(2 * surface.size());
            }
            if (inextensible) {
                p.tension = take(surface.divergence.rows());
                if (saturated) {
                    p.slack = take(1);
                }
            }
        }
    }

    /// u = u_0 + V y at all nodes.
    void response() {
        velocity_given_ = background_;
        response_ = Matrix<S>::Zero(background_.size(), unknowns_);
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            const Part& p = parts_[b];
            const Surface& surface = bodies_[b].surface;
            const Index n = 2 * surface.size();
            Matrix<S> copy;
            if (bodies_.size() > 1 || p.force != none) {
                copy = block_of(mobility_, 0, p.begin, mobility_.rows(), n);
            }
            if (p.force != none) {
                set_block(response_, 0, p.force, copy);
                continue;
            }
            if constexpr (Kinds::any_deformable) {
                const Matrix<S>& g = bodies_.size() > 1 ? copy : mobility_;
                velocity_given_ += applied(g, p.given_force);
                if (p.velocity != none) {
                    set_columns(response_, p.velocity, g, p.of_velocity);
                }
                if (p.tension != none) {
                    set_columns(response_, p.tension, g, surface.tension_force);
                }
            }
        }
    }

    void system() {
        matrix_ = Matrix<S>::Zero(unknowns_, unknowns_);
        rhs_ = Vector<S>::Zero(unknowns_);
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            if constexpr (Kinds::any_rigid) {
                if (parts_[b].force != none) {
                    rigid_rows(parts_[b], bodies_[b]);
                }
            }
            if constexpr (Kinds::any_deformable) {
                if (parts_[b].force == none) {
                    deformable_rows(parts_[b], bodies_[b].surface);
                }
            }
        }
    }

    /// The response at a body's nodes.
    Matrix<S> response_of(const Part& p, Index rows) const { return block_of(response_, p.begin, 0, rows, unknowns_); }

    void rigid_rows(const Part& p, const Body& body) {
        const Index nodes = body.surface.size();
        const Index n = 2 * nodes;
        set_block(matrix_, p.force, 0, response_of(p, n));
        for (Index i = 0; i < n; ++i) {
            rhs_[p.force + i] = -velocity_given_[p.begin + i];
        }
        for (Index i = 0; i < nodes; ++i) {
            if (p.given_speed) {
                rhs_[p.force + nodes + i] += *p.given_speed;
            } else {
                matrix_(p.force + nodes + i, p.speed) = S(-1);
                matrix_(p.speed, p.force + nodes + i) = body.surface.weight[i];
                rhs_[p.speed] += body.surface.weight[i] * body.load[nodes + i];
            }
        }
        // On the axis u_r = 0 holds by symmetry and says nothing: f_r = 0 takes its place.
        for (const Index pole : {p.force, p.force + nodes - 1}) {
            for (Index j = 0; j < unknowns_; ++j) {
                matrix_(pole, j) = j == pole ? S(1) : S(0);
            }
            rhs_[pole] = 0;
        }
    }

    void deformable_rows(const Part& p, const Surface& surface) {
        const Index n = 2 * surface.size();
        if (p.velocity != none) {
            for (Index j = 0; j < unknowns_; ++j) {
                for (Index i = 0; i < n; ++i) {
                    matrix_(p.velocity + i, j) = -response_(p.begin + i, j);
                }
            }
            for (Index i = 0; i < n; ++i) {
                matrix_(p.velocity + i, p.velocity + i) += S(1);
                rhs_[p.velocity + i] = velocity_given_[p.begin + i];
            }
        }
        if (p.tension == none) {
            return;
        }
        const Index tensions = surface.divergence.rows();
        if (p.velocity != none) {
            set_block(matrix_, p.tension, p.velocity, surface.divergence);
        } else {
            set_block(matrix_, p.tension, 0, applied(surface.divergence, response_of(p, n)));
            const Vector<S> given = applied(surface.divergence, Vector<S>(velocity_given_.segment(p.begin, n)));
            for (Index i = 0; i < tensions; ++i) {
                rhs_[p.tension + i] = -given[i];
            }
        }
        if (p.slack != none) {
            // A uniform tension is a pressure, and dA/dt = 2 dV/dt = 0 makes one of the constraints redundant: fix the
            // mean tension and allow for the redundant constraint's O(h^2) error.
            const S area = surface.area();
            for (Index i = 0; i < tensions; ++i) {
                matrix_(p.slack, p.tension + i) = surface.element_area[i] / area;
                matrix_(p.tension + i, p.slack) = S(1);
            }
        }
    }

    MobilitySolution<S> solution(const Part& p, const Body& body, const Vector<S>& y, const Vector<S>& velocity) const {
        const Index n = 2 * body.surface.size();
        MobilitySolution<S> s;
        if (p.force != none) {
            s.velocity = Vector<S>::Zero(n);
            const S speed = p.given_speed ? *p.given_speed : y[p.speed];
            for (Index i = n / 2; i < n; ++i) {
                s.velocity[i] = speed;
            }
            s.force = y.segment(p.force, n);
            return s;
        }
        if constexpr (Kinds::any_deformable) {
            s.velocity = p.velocity != none ? y.segment(p.velocity, n) : velocity.segment(p.begin, n);
            s.elastic = p.elastic;
            s.force = p.given_force;
            if (p.velocity != none) {
                s.force += applied(p.of_velocity, s.velocity);
            }
            if (p.tension != none) {
                s.tension = y.segment(p.tension, body.surface.divergence.rows());
                s.force += applied(body.surface.tension_force, s.tension);
            }
        }
        return s;
    }

    const std::vector<Body>& bodies_;
    const Matrix<S>& mobility_;
    const Vector<S>& background_;
    std::vector<Part> parts_;
    Index unknowns_ = 0;
    Matrix<S> response_;
    Vector<S> velocity_given_;
    Matrix<S> matrix_;
    Vector<S> rhs_;
};

template <class S, class Surface, class Law>
MotionEquation<S, Surface, Law>::MotionEquation(const std::vector<Body>& bodies, const Matrix<S>& mobility,
                                                const Vector<S>& background, const S& implicit_time)
    : bodies_(bodies), mobility_(mobility), background_(background), parts_(bodies.size()) {
    Index begin = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        Kinds::visit(bodies_[b].law, [&](const auto& law) { part(law, bodies_[b], implicit_time, parts_[b]); });
        parts_[b].begin = begin;
        begin += 2 * bodies_[b].surface.size();
    }
}

template <class S, class Surface, class Law>
template <class Solver>
std::vector<MobilitySolution<S>> MotionEquation<S, Surface, Law>::solve(Solver& solver) {
    response();
    Vector<S> y(unknowns_);
    if (unknowns_ > 0) {
        system();
        solver.factorize(matrix_);
        y = solver.solve(rhs_);
    }
    const Vector<S> velocity = velocity_given_ + applied(response_, y);
    std::vector<MobilitySolution<S>> solutions(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        solutions[b] = solution(parts_[b], bodies_[b], y, velocity);
    }
    return solutions;
}

/// That of one body in a given mobility and background.
template <class S, class Surface, class Law, class Solver>
MobilitySolution<S> lone_motion(const Law& law, const Surface& surface, Matrix<S> mobility, Vector<S> background,
                                const Vector<S>& load, Solver& solver) {
    const Vector<S> no_tension;
    const std::vector<EquationBody<S, Surface, Law>> bodies{{law, surface, load, no_tension, {}}};
    complete_rank<S>(bodies, mobility, background);
    return std::move(MotionEquation<S, Surface, Law>(bodies, mobility, background, S(0)).solve(solver).front());
}

}  // namespace detail
}  // namespace axistokes
