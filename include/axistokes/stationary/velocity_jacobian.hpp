// SPDX-License-Identifier: MIT
// Derivative of the velocities against the unknowns of a stationary state, whatever the laws of the bodies
// (docs/stationary.md).
#pragma once

#include "../operators.hpp"
#include "mobility_change.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// d(velocity)/d(unknowns) of u = u_inf + G f at a point; f = F + load + T gamma with D u = 0 of an inextensible body,
/// F + load of one without constraint, and the traction that makes a rigid one move as such. The derivatives of F, T,
/// D, of the load, of u_inf and of the normals are differences without assemblies, one-sided or, `accurately`, central
/// ones: of the bending force, eps N^4 large, only these keep some digits. That of G is MobilityChange's.
template <class SceneType>
class VelocityJacobian {
    using S = typename SceneType::Scalar;
    using Surface = typename SceneType::Surface;
    using Point = StationaryPoint<SceneType>;

  public:
    VelocityJacobian(SceneType& scene, const Point& point, bool accurately = false)
        : scene_(scene),
          point_(point),
          accurately_(accurately),
          layout_(scene, point.bodies),
          change_(MobilityChange<SceneType>(scene, point)()),
          flow_change_(Matrix<S>::Zero(layout_.all_velocities(), layout_.all())),
          force_change_(Matrix<S>::Zero(layout_.all_velocities(), layout_.all())),
          local_(Matrix<S>::Zero(layout_.all(), layout_.all())),
          first_speed_(Vector<S>::Zero(layout_.all())),
          stretch_(point.bodies.size()) {}

    Matrix<S> operator()() {
        for (std::size_t b = 0; b < point_.bodies.size(); ++b) {
            if (scene_.deforms(b)) {
                differentiate(b);
            } else {
                translate(b);
            }
        }
        change_ += flow_change_;
        change_ += point_.frozen.mobility * force_change_;
        constrain();
        return local_ + velocities();
    }

  private:
    Index rows(std::size_t b) const { return 2 * layout_.nodes[b]; }
    Index nodes(std::size_t b) const { return point_.bodies[b].shape.nodes(); }
    bool inextensible(std::size_t b) const { return point_.instants[b].solution.tension.size() > 0; }

    /// What of the velocity depends on one body's shape alone, the velocities and tensions fixed.
    struct Local {
        Vector<S> force;    // density, with the load
        Vector<S> flow;     // undisturbed
        Vector<S> stretch;  // rate, of an inextensible body
        S speed;            // of the centroid
        Vector<S> normal;   // velocities; of the first body relative to its centroid

        Vector<S> stacked() const {
            Vector<S> all(force.size() + flow.size() + stretch.size() + normal.size() + 1);
            all << force, flow, stretch, normal, speed;
            return all;
        }
    };

    /// `pressure`: the uniform part of the force, as in MobilityChange.
    Local local(std::size_t b, const Configuration<S>& body, const Surface& surface, const Vector<S>& motion,
                const S& pressure) const {
        Local at;
        at.force = elastic_force<S>(scene_.law(b), surface);
        at.force += scene_.normal_load(body, surface);
        at.force -= pressure * surface.normals();
        if (inextensible(b)) {
            at.force += applied(surface.tension_force, point_.instants[b].solution.tension);
            at.stretch = applied(surface.divergence, motion);
        }
        at.flow = undisturbed(scene_, b, body, surface);
        std::tie(at.speed, at.normal) = relative_normal_velocity<S>(surface, body.shape.z, motion);
        if (b > 0) {
            at.normal += at.speed * surface.normal_z;
        }
        return at;
    }

    void differentiate(std::size_t b) {
        using std::cbrt;
        using std::sqrt;
        const Configuration<S>& body = point_.bodies[b];
        const Surface& surface = point_.surface(b);
        const Index n = nodes(b);
        // Relative to the first centroid: 0 in the stationary state.
        Vector<S> motion = point_.instants[b].solution.velocity;
        motion.tail(n).array() -= point_.instants.front().velocity;
        const S eps = std::numeric_limits<S>::epsilon();
        const S step = accurately_ ? S(cbrt(eps)) : S(sqrt(eps));
        const S pressure = mean_normal_part<S>(surface, point_.instants[b].solution.force);
        const auto moved = [&](Index j, const S& distance) {
            Configuration<S> there = body;
            displace<S>(there.shape, surface, distance * Vector<S>::Unit(n, j));
            return local(b, there, scene_.discretization().surface(there.shape, SurfaceParts::all), motion, pressure)
                .stacked();
        };
        const Local here = local(b, body, surface, motion, pressure);
        const Vector<S> all = here.stacked();
        stretch_[b] = Matrix<S>::Zero(here.stretch.size(), layout_.all());
        for (Index j = 0; j < n; ++j) {
            const Index column = layout_.unknowns[b] + j;
            const Vector<S> change = accurately_ ? Vector<S>((moved(j, step) - moved(j, -step)) / (2 * step))
                                                 : Vector<S>((moved(j, step) - all) / step);
            force_change_.col(column).segment(rows(b), 2 * n) = change.head(2 * n);
            flow_change_.col(column).segment(rows(b), 2 * n) = change.segment(2 * n, 2 * n);
            stretch_[b].col(column) = change.segment(4 * n, here.stretch.size());
            local_.col(column).segment(layout_.unknowns[b], n) = change.segment(change.size() - 1 - n, n);
            if (b == 0) {
                first_speed_[column] = change[change.size() - 1];
            }
        }
        translate(b);
    }

    /// Of a translation nothing changes but the undisturbed flow at the nodes.
    void translate(std::size_t b) {
        using std::cbrt;
        const Translation<S> along = translation(scene_, point_, b);
        if (!along.exists()) {
            return;
        }
        Configuration<S> moved = point_.bodies[b];
        const S step = cbrt(std::numeric_limits<S>::epsilon());
        moved.position += step;
        Configuration<S> back = point_.bodies[b];
        back.position -= step;
        const Surface& surface = point_.surface(b);
        const Index begin = layout_.unknowns[b];
        const Index n = along.part.size();
        along.set(flow_change_.middleCols(begin, n).middleRows(rows(b), 2 * nodes(b)),
                  (undisturbed(scene_, b, moved, surface) - undisturbed(scene_, b, back, surface)) / (2 * step));
        if (scene_.deforms(b)) {
            along.set(force_change_.middleCols(begin, n), Vector<S>::Zero(force_change_.rows()));
            along.set(local_.middleCols(begin, n), Vector<S>::Zero(local_.rows()));
        }
        if (inextensible(b)) {
            along.set(stretch_[b].middleCols(begin, n), Vector<S>::Zero(stretch_[b].rows()));
        }
    }

    /// Adds what the changes of tensions, and of rigid bodies' tractions, do to the velocities.
    void constrain() {
        struct Part {
            Index begin, tension, speed;
        };
        std::vector<Part> parts;
        Index count = 0;
        for (std::size_t b = 0; b < point_.bodies.size(); ++b) {
            Part part{count, -1, -1};
            if (inextensible(b)) {
                part.tension = count;
                count += point_.surface(b).divergence.rows();
            } else if (!scene_.deforms(b)) {
                count += 2 * nodes(b);
                if (moves_freely(b)) {
                    part.speed = count++;
                }
            }
            parts.push_back(part);
        }
        if (count == 0) {
            return;
        }
        const Matrix<S>& g = point_.frozen.mobility;
        Matrix<S> response = Matrix<S>::Zero(g.rows(), count);
        for (std::size_t b = 0; b < parts.size(); ++b) {
            const Matrix<S> columns = block_of(g, 0, rows(b), g.rows(), 2 * nodes(b));
            if (inextensible(b)) {
                set_columns(response, parts[b].tension, columns, point_.surface(b).tension_force);
            } else if (!scene_.deforms(b)) {
                set_block(response, 0, parts[b].begin, columns);
            }
        }
        Matrix<S> matrix = Matrix<S>::Zero(count, count);
        Matrix<S> rhs = Matrix<S>::Zero(count, layout_.all());
        for (std::size_t b = 0; b < parts.size(); ++b) {
            const Surface& surface = point_.surface(b);
            const Index n = nodes(b);
            const Matrix<S> own = block_of(response, rows(b), 0, 2 * n, count);
            const Matrix<S> given = block_of(change_, rows(b), 0, 2 * n, layout_.all());
            if (inextensible(b)) {
                set_block(matrix, parts[b].tension, 0, applied(surface.divergence, own));
                set_block(rhs, parts[b].tension, 0, Matrix<S>(-applied(surface.divergence, given) - stretch_[b]));
            } else if (!scene_.deforms(b)) {
                const Index begin = parts[b].begin;
                set_block(matrix, begin, 0, own);
                set_block(rhs, begin, 0, Matrix<S>(-given));
                if (const Index speed = parts[b].speed; speed >= 0) {
                    matrix.col(speed).segment(begin + n, n).setConstant(S(-1));
                    matrix.row(speed).segment(begin + n, n) = surface.weight.transpose();
                }
                // As in the equations of motion.
                for (const Index pole : {begin, begin + n - 1}) {
                    matrix.row(pole).setZero();
                    matrix(pole, pole) = S(1);
                    rhs.row(pole).setZero();
                }
            }
        }
        change_ += response * matrix.partialPivLu().solve(rhs);
    }

    bool moves_freely(std::size_t b) const {
        return LawKinds<std::decay_t<decltype(scene_.law())>>::visit(scene_.law(b), [](const auto& kind) {
            if constexpr (std::decay_t<decltype(kind)>::constraint == Constraint::rigid) {
                return !kind.velocity;
            } else {
                return true;
            }
        });
    }

    /// Of the centroids and normals, relative to the first centroid.
    Matrix<S> velocities() const {
        Matrix<S> result = Matrix<S>::Zero(layout_.all(), layout_.all());
        Vector<S> first;
        for (std::size_t b = 0; b < point_.bodies.size(); ++b) {
            const Surface& surface = point_.surface(b);
            const Index n = nodes(b);
            Matrix<S> normal = surface.normal_r.asDiagonal() * change_.middleRows(rows(b), n);
            normal += surface.normal_z.asDiagonal() * change_.middleRows(rows(b) + n, n);
            const Vector<S> moment = surface.weight.cwiseProduct(point_.bodies[b].shape.z);
            const Vector<S> speed = (moment.transpose() * normal / moment.dot(surface.normal_z)).transpose();
            if (b == 0) {
                first = speed;  // that by the shape is in the local part
            } else if (b == 1) {
                first += first_speed_;
            }
            if (scene_.deforms(b)) {
                result.middleRows(layout_.unknowns[b], n) = normal - surface.normal_z * first.transpose();
            } else {
                result.row(layout_.unknowns[b]) = (speed - first).transpose();
            }
        }
        return result;
    }

    const SceneType& scene_;
    const Point& point_;
    bool accurately_;
    StationaryLayout layout_;
    Matrix<S> change_;        // of the velocities at all nodes
    Matrix<S> flow_change_;   // of the undisturbed ones, likewise
    Matrix<S> force_change_;  // likewise
    Matrix<S> local_;         // of normal velocities, the velocities themselves fixed
    Vector<S> first_speed_;   // likewise of the first centroid
    std::vector<Matrix<S>> stretch_;
};

}  // namespace axistokes::detail
