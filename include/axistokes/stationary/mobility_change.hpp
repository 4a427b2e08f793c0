// SPDX-License-Identifier: MIT
// Derivative of what force densities and walls make of the flow, against the unknowns of a stationary state
// (docs/stationary.md, section 2).
#pragma once

#include "../equation/flux.hpp"
#include "../geometry/meridian.hpp"
#include "stationary_point.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// A body's undisturbed velocity as the equations have it, but for what a meshed wall adds.
template <class SceneType>
Vector<typename SceneType::Scalar> undisturbed(const SceneType& scene, std::size_t body,
                                               const Configuration<typename SceneType::Scalar>& configuration,
                                               const typename SceneType::Surface& surface) {
    using S = typename SceneType::Scalar;
    const Vector<S> flow = scene.background_velocity(configuration);
    return scene.deforms(body) ? without_flux<S>(surface, flow) : flow;
}

/// The derivative of G f + (what walls add to the flow) at all nodes, r and z stacked for each body, by the unknowns,
/// the force densities f at the nodes fixed. Of the normal displacement phi of a curve C, with layers at a distance h
/// from it that have the same densities at their nodes,
///
///   d(G_C f)(x0) = d/dh [G_(C - h n)(-phi f)](x0) + d/dh [G_C f](x0 + h n) phi(x0),                            (1)
///
/// since a displacement of the layer and one of the targets add up, and on one side of the layer both derivatives
/// exist: a few assemblies instead of one for each node (docs/stationary.md, section 2). The uniform pressure in f,
/// without effect on any closed curve, is left out.
template <class SceneType>
class MobilityChange {
    using S = typename SceneType::Scalar;
    using Point = StationaryPoint<SceneType>;

  public:
    MobilityChange(SceneType& scene, const Point& point)
        : scene_(scene), point_(point), layout_(scene, point.bodies), force_(layout_.all_velocities()) {
        const S origin = point.bodies.front().position;
        for (std::size_t b = 0; b < point.bodies.size(); ++b) {
            curves_.push_back(shifted(point.bodies[b].shape, S(point.bodies[b].position - origin)));
            const Vector<S>& all = point.instants[b].solution.force;
            force_.segment(rows(b), all.size()) = scene.deforms(b) ? without_flux<S>(point.surface(b), all) : all;
        }
        origin_ = origin;
    }

    Matrix<S> operator()() {
        change_ = Matrix<S>::Zero(layout_.all_velocities(), layout_.all());
        const Films<S> films = scene_.films(point_.bodies);
        for (std::size_t b = 0; b < point_.bodies.size(); ++b) {
            if (scene_.deforms(b)) {
                displace_normally(b, films.bodies[b]);
            }
            if (point_.bodies.size() > 1) {
                translate(b, films.bodies[b].to_neighbour);
            }
        }
        return std::move(change_);
    }

  private:
    /// Distance of the layers over that on which the flow next to the curve changes. Differences of the second order.
    static S offset() { return S(3e-3); }

    Index rows(std::size_t b) const { return 2 * layout_.nodes[b]; }
    Index count(std::size_t b) const { return 2 * curves_[b].nodes(); }

    /// Eq. (1).
    void displace_normally(std::size_t b, const FilmThickness<S>& film) {
        const auto& surface = point_.surface(b);
        const S bend = 2 * surface.mean_curvature.cwiseAbs().maxCoeff();
        const S step = offset() * std::min({S(1), S(S(1) / bend), film.min, film.to_neighbour});
        std::vector<Meridian<S>> curves = curves_;
        for (const int times : {-1, -2, 1, 2}) {
            curves.push_back(curves_[b]);
            displace<S>(curves.back(), surface, Vector<S>::Constant(curves_[b].nodes(), times * step));
        }
        const Index n = count(b);
        const Index bodies = layout_.all_velocities();
        Matrix<S> g = Matrix<S>::Zero(bodies + 4 * n, bodies + 4 * n);
        const auto& discretization = scene_.discretization();
        const auto& kernel = scene_.kernel();
        for (std::size_t other = 0; other < curves_.size(); ++other) {
            const auto put = [&](Index target, const Meridian<S>& at, Index source, const Meridian<S>& of) {
                g.block(target, source, 2 * at.nodes(), 2 * of.nodes()) =
                    &at == &of ? discretization.single_layer(of, kernel)
                               : discretization.single_layer_at(at, of, kernel);
            };
            for (Index k = 0; k < 2; ++k) {
                const auto layer = curves_.size() + static_cast<std::size_t>(k);
                put(rows(other), curves[other], bodies + k * n, curves[layer]);
                put(bodies + (2 + k) * n, curves[layer + 2], rows(other), curves[other]);
            }
            put(rows(other), curves[other], rows(b), curves[b]);
            if (other != b) {
                put(rows(b), curves[b], rows(other), curves[other]);
            }
        }
        Vector<S> flow = Vector<S>::Zero(bodies + 4 * n);
        if constexpr (std::decay_t<decltype(scene_.wall())>::present) {
            std::vector<Meridian<S>> places;
            for (const Meridian<S>& curve : curves) {
                places.push_back(shifted(curve, origin_));
            }
            scene_.confine(places, g, flow);
        }
        const Matrix<S> sources = (3 * g.block(0, rows(b), bodies, n) - 4 * g.block(0, bodies, bodies, n) +
                                   g.block(0, bodies + n, bodies, n)) /
                                  (2 * step);
        const auto velocity = [&](Index row) {
            return Vector<S>(g.block(row, 0, n, bodies) * force_ + flow.segment(row, n));
        };
        const Vector<S> targets =
            (4 * velocity(bodies + 2 * n) - 3 * velocity(rows(b)) - velocity(bodies + 3 * n)) / (2 * step);
        const Index nodes = n / 2;
        for (Index j = 0; j < nodes; ++j) {
            auto column = change_.col(layout_.unknowns[b] + j);
            column = sources.col(j) * force_[rows(b) + j] + sources.col(nodes + j) * force_[rows(b) + nodes + j];
            column[rows(b) + j] += targets[j];
            column[rows(b) + nodes + j] += targets[nodes + j];
        }
    }

    /// How bodies push each other along may be a small part of all that: it is differentiated by itself.
    void translate(std::size_t b, const S& gap) {
        const Translation<S> along = translation(scene_, point_, b);
        if (!along.exists()) {
            return;
        }
        const S step = S(0.01) * std::min(S(1), gap);
        auto moved = point_.bodies;
        moved[b].position += step;
        const Vector<S> ahead = velocity(moved);
        moved[b].position -= 2 * step;
        const Index begin = layout_.unknowns[b];
        along.set(change_.middleCols(begin, layout_.unknowns[b + 1] - begin), (ahead - velocity(moved)) / (2 * step));
    }

    Vector<S> velocity(const typename SceneType::State& at) {
        const auto frozen = scene_.freeze(at);
        Vector<S> u = frozen.mobility * force_;
        if constexpr (std::decay_t<decltype(scene_.wall())>::present) {
            u += frozen.background;
            for (std::size_t b = 0; b < at.size(); ++b) {
                u.segment(rows(b), count(b)) -= undisturbed(scene_, b, at[b], frozen.bodies[b].surface);
            }
        }
        return u;
    }

    SceneType& scene_;
    const Point& point_;
    StationaryLayout layout_;
    std::vector<Meridian<S>> curves_;  // relative to the first body
    S origin_{};
    Vector<S> force_;
    Matrix<S> change_;
};

}  // namespace axistokes::detail
