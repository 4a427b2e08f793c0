// SPDX-License-Identifier: MIT
// The bodies of a scene, the velocities on them, and the displacements that a stationary state is looked for with
// (docs/stationary.md).
//
// Unknowns are the normal displacements of the nodes of deformable bodies, and the axial ones of rigid bodies; defects
// are the velocities against them, relative to the first body's centroid. The part of a displacement that is a
// translation moves the body, nodes and all, but for the first one, whose centroid stays.
#pragma once

#include "../geometry/conserved.hpp"
#include "../scene.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// Where each body's nodes and unknowns begin; the last entries are their numbers.
struct StationaryLayout {
    std::vector<Index> nodes{0};
    std::vector<Index> unknowns{0};

    template <class SceneType>
    StationaryLayout(const SceneType& scene, const typename SceneType::State& bodies) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const Index n = bodies[b].shape.nodes();
            nodes.push_back(nodes.back() + n);
            unknowns.push_back(unknowns.back() + (scene.deforms(b) ? n : 1));
        }
    }

    Index all() const { return unknowns.back(); }
    Index all_velocities() const { return 2 * nodes.back(); }
};

template <class SceneType>
struct StationaryPoint {
    using Scalar = typename SceneType::Scalar;

    typename SceneType::State bodies;
    typename SceneType::Frozen frozen;
    typename SceneType::Instants instants;
    Vector<Scalar> velocity;  // against the unknowns
    Scalar residual{};        // as in StepRecord, the largest of all bodies

    const Configuration<Scalar>& configuration(std::size_t body = 0) const { return bodies.at(body); }
    const typename SceneType::InstantType& instant(std::size_t body = 0) const { return instants.at(body); }
    const typename SceneType::Surface& surface(std::size_t body) const { return frozen.bodies[body].surface; }
};

/// Velocities and residual of a point's bodies.
template <class SceneType>
void evaluate(SceneType& scene, StationaryPoint<SceneType>& point) {
    using std::abs;
    using S = typename SceneType::Scalar;
    const StationaryLayout layout(scene, point.bodies);
    point.frozen = scene.freeze(point.bodies);
    point.instants = scene.evaluate(point.frozen, point.bodies, S(0));
    point.velocity.resize(layout.all());
    point.residual = 0;
    for (std::size_t b = 0; b < point.bodies.size(); ++b) {
        const auto& instant = point.instants[b];
        const S apart = instant.velocity - point.instants.front().velocity;
        if (scene.deforms(b)) {
            point.velocity.segment(layout.unknowns[b], instant.surface.size()) =
                relative_normal_velocity<S>(instant.surface, point.bodies[b].shape.z, instant.solution.velocity)
                    .second +
                apart * instant.surface.normal_z;
        } else {
            point.velocity[layout.unknowns[b]] = apart;
        }
        point.residual = std::max<S>({point.residual, instant.deformation_rate, abs(apart)});
    }
    point.residual /= std::max(S(1), scene.velocity_scale());
}

/// What each body conserves, with the areas and volumes given.
template <class SceneType, class S>
std::vector<Conserved<S>> conserved_in(const SceneType& scene, const std::vector<Measures<S>>& measures) {
    std::vector<Conserved<S>> conserved;
    for (std::size_t b = 0; b < measures.size(); ++b) {
        conserved.emplace_back(measures[b], keeps_area(scene.law(b)));
    }
    return conserved;
}

/// Moves the nodes by `displacement` along the normals of `surface`; the poles stay on the axis.
template <class S, class Surface>
void displace(Meridian<S>& shape, const Surface& surface, const Vector<S>& displacement) {
    const Index n = shape.nodes();
    shape.r += surface.normal_r.cwiseProduct(displacement);
    shape.z += surface.normal_z.cwiseProduct(displacement);
    shape.r[0] = shape.r[n - 1] = 0;
}

/// The translation in a body's displacement, by its unknowns, and the unknowns of one of length 1. Empty if it has none
/// of its own: then it is the first.
template <class S>
struct Translation {
    Vector<S> part;
    Vector<S> unknowns;

    bool exists() const { return part.size() > 0; }

    /// Corrects a derivative's columns, those of the body's unknowns, such that a translation leads to `wanted`.
    template <class Columns>
    void set(Columns&& columns, const Vector<S>& wanted) const {
        const Vector<S> missed = wanted - columns * unknowns;
        columns += missed * part.transpose();
    }
};
template <class SceneType>
Translation<typename SceneType::Scalar> translation(const SceneType& scene, const StationaryPoint<SceneType>& point,
                                                    std::size_t body) {
    using S = typename SceneType::Scalar;
    if (!scene.deforms(body)) {
        return {Vector<S>::Ones(1), Vector<S>::Ones(1)};
    }
    if (body == 0) {
        return {};
    }
    const auto& surface = point.surface(body);
    const Vector<S> moment = surface.weight.cwiseProduct(point.bodies[body].shape.z);
    return {moment / moment.dot(surface.normal_z), surface.normal_z};
}

/// The bodies of a point, displaced.
template <class SceneType>
typename SceneType::State displaced(const SceneType& scene, const StationaryPoint<SceneType>& point,
                                    const Vector<typename SceneType::Scalar>& unknowns) {
    using S = typename SceneType::Scalar;
    const StationaryLayout layout(scene, point.bodies);
    typename SceneType::State bodies = point.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Index begin = layout.unknowns[b];
        Vector<S> own = unknowns.segment(begin, layout.unknowns[b + 1] - begin);
        const Translation<S> along = translation(scene, point, b);
        if (along.exists()) {
            const S distance = along.part.dot(own);
            bodies[b].position += distance;
            own -= distance * along.unknowns;
        }
        if (scene.deforms(b)) {
            displace<S>(bodies[b].shape, point.surface(b), own);
        }
    }
    return bodies;
}

/// Restores what the bodies conserve, and puts the first one's centroid back where it was. Why nothing can be computed
/// on them; empty if something can.
template <class SceneType, class S>
std::string settle(const SceneType& scene, std::vector<Configuration<S>>& bodies,
                   const std::vector<Conserved<S>>& conserved) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        Meridian<S>& shape = bodies[b].shape;
        std::string cause = scene.fault(bodies[b]);
        if (cause.empty() && scene.deforms(b)) {
            cause = conserved[b].restore(scene.discretization(), shape)
                        ? scene.fault(bodies[b])
                        : "body " + std::to_string(b) + " cannot be given its area and volume";
        }
        if (!cause.empty()) {
            return cause;
        }
        if (!scene.deforms(b)) {
            continue;
        }
        const S centroid = scene.discretization().measures(shape).centroid;
        shape.z.array() -= centroid;
        if (b > 0) {
            bodies[b].position += centroid;
        }
    }
    for (std::size_t b = 0; b + 1 < bodies.size(); ++b) {
        if (meet(bodies[b], bodies[b + 1])) {
            return "bodies " + std::to_string(b) + " and " + std::to_string(b + 1) +
                   " meet, or are not in the order in which they lie along the axis";
        }
    }
    return "";
}

}  // namespace axistokes::detail
