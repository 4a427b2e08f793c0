// SPDX-License-Identifier: MIT
// A wall of unknown tractions around the particle, on a mesh of its own (a policy for the wall; docs/wall_mesh.md).
//
// With q the force density on the boundary W of a finite piece of the channel, f that on the particle P and g the
// velocity given on W,
//   A q + B f = g  on W,      u = C q + G f  on P,
// where A, B, C, G are the single layers W -> W, P -> W, W -> P, P -> P. Eliminating q,
//   u = C A^-1 g + (G - C A^-1 B) f.
// A depends on the mesh alone and is factored once for it. A n = 0 (a uniform pressure moves nothing), and A creates no
// flux: A + n (dA n)^T / |W| has both properties the other way round and the solution whose normal part has zero mean.
#pragma once

#include "../concepts.hpp"
#include "channel_field.hpp"
#include "channel_mesh.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axistokes {

template <ChannelProfile Profile>
class WallMesh {
  public:
    using Scalar = typename Profile::Scalar;
    using Params = WallMeshParams<Scalar>;
    using Mesh = ChannelMesh<Profile>;
    static constexpr bool present = true;

    /// Throws InvalidArgument when a parameter is out of range or the profile's radius is somewhere not positive and
    /// finite.
    explicit WallMesh(Profile profile, Params params = {})
        : profile_(std::move(profile)), params_(params), narrowest_(narrowest_radius(profile_)) {
        detail::validate(params);
    }

    const Profile& profile() const { return profile_; }
    const Params& params() const { return params_; }
    Scalar radius(const Scalar& z) const { return Mesh::channel_radius(profile_, z); }
    /// Radial distance of a point from the wall, negative beyond it.
    Scalar gap(const Point<Scalar>& x) const { return radius(x.z) - x.r; }

    /// Velocity on the axis of Poiseuille flow in a tube as wide as the channel is at z.
    Scalar centreline_velocity(const Scalar& z) const { return peak_velocity(radius(z)); }
    /// That at the narrowest place.
    Scalar velocity_scale() const {
        using std::abs;
        return abs(peak_velocity(narrowest_));
    }

    /// The same channel with a mesh for evaluating the flow up to the distance `reach` beyond a particle: the default
    /// one, made longer.
    WallMesh reaching(const Scalar& reach) const {
        const Scalar widest = std::max(radius(profile_.begin()), radius(profile_.end()));
        Params params;
        params.flow_rate = params_.flow_rate;
        params.tolerance = params_.tolerance;
        params.length = reach + Mesh::default_length(widest, params.tolerance);
        return WallMesh(profile_, params);
    }

    /// The current mesh, if there is one yet.
    const std::optional<Mesh>& mesh() const { return mesh_; }
    /// How many meshes there have been: one, until the particle moves away from where the mesh is fine.
    Index meshes() const { return meshes_; }

    /// That number, and the nodes that the current mesh was made for, r and z; empty without a mesh.
    Vector<Scalar> memory() const {
        Vector<Scalar> memory;
        if (made_for_.nodes() > 0) {
            memory.resize(1 + 2 * made_for_.nodes());
            memory << Scalar(meshes_), made_for_.r, made_for_.z;
        }
        return memory;
    }
    /// The mesh of the equal wall that gave `memory`; made when it is needed.
    void recall(const Vector<Scalar>& memory) {
        const Vector<Scalar> now = this->memory();
        if (memory.size() == now.size() && memory == now) {
            return;
        }
        const Index n = memory.size() / 2;
        mesh_.reset();
        made_for_ = {memory.segment(memory.size() - 2 * n, n), memory.tail(n)};
        meshes_ = memory.size() > 0 ? static_cast<Index>(memory[0]) : 0;
    }

    /// Turns the bodies' mobility and background velocity without the wall into those in its presence. Returns the
    /// undisturbed flow of flow rate 1 at the nodes. Throws SimulationFailure when a node is not inside the wall.
    template <class Discretization, class Kernel>
    requires(!Kernel::has_images) Vector<Scalar> confine(const Discretization& discretization, const Kernel& kernel,
                                                         const std::vector<Meridian<Scalar>>& bodies,
                                                         Matrix<Scalar>& mobility, Vector<Scalar>& background) {
        const std::vector<Meridian<Scalar>> local = prepare(kernel, bodies);
        const Meridian<Scalar>& wall = mesh_->curve().nodes();
        Vector<Scalar> unit_flow(background.size());
        std::vector<Matrix<Scalar>> from_wall;
        for (const Meridian<Scalar>& body : local) {
            from_wall.push_back(mesh_->curve().single_layer_at(body, kernel));
        }
        Index source = 0;
        for (const Meridian<Scalar>& body : local) {
            const Matrix<Scalar> tractions = lu_.solve(discretization.single_layer_at(wall, body, kernel));
            Index target = 0;
            for (const Matrix<Scalar>& g : from_wall) {
                mobility.block(target, source, g.rows(), tractions.cols()) -= g * tractions;
                target += g.rows();
            }
            source += tractions.cols();
        }
        Index target = 0;
        for (const Matrix<Scalar>& g : from_wall) {
            unit_flow.segment(target, g.rows()) = g * unit_traction_;
            target += g.rows();
        }
        background += params_.flow_rate * unit_flow;
        return unit_flow;
    }

    /// The flow with a given force density on a particle, for evaluation anywhere in the channel.
    template <class Discretization, class Kernel>
    requires(!Kernel::has_images) ChannelField<Discretization, Kernel> field(const Discretization& discretization,
                                                                             const Kernel& kernel,
                                                                             const Meridian<Scalar>& particle,
                                                                             const Vector<Scalar>& force) {
        const Meridian<Scalar> local = prepare(kernel, particle);
        const Matrix<Scalar> to_wall = discretization.single_layer_at(mesh_->curve().nodes(), local, kernel);
        const Vector<Scalar> traction = params_.flow_rate * unit_traction_ - lu_.solve(to_wall * force);
        return {discretization, kernel, mesh_->curve(), traction, local, force, centre(particle)};
    }

    /// The empty channel's flow of flow rate 1, on the current mesh.
    template <class Discretization, class Kernel>
    ChannelField<Discretization, Kernel> unit_field(const Discretization& discretization, const Kernel& kernel,
                                                    const Meridian<Scalar>& particle) {
        const Meridian<Scalar> local = prepare(kernel, particle);
        return {discretization,  kernel, mesh_->curve(), unit_traction_, local, Vector<Scalar>::Zero(2 * local.nodes()),
                centre(particle)};
    }

  private:
    Scalar peak_velocity(const Scalar& radius) const {
        return 2 * params_.flow_rate / (detail::pi_value<Scalar>() * radius * radius);
    }

    /// A straight tube's mesh goes with the bodies.
    Scalar centre(const Meridian<Scalar>& particle) const {
        return profile_.uniform ? Scalar((particle.z.minCoeff() + particle.z.maxCoeff()) / 2) : Scalar(0);
    }

    static Meridian<Scalar> joined(const std::vector<Meridian<Scalar>>& bodies) {
        Meridian<Scalar> all;
        for (const Meridian<Scalar>& body : bodies) {
            const Index old = all.nodes();
            all.r.conservativeResize(old + body.nodes());
            all.z.conservativeResize(old + body.nodes());
            all.r.tail(body.nodes()) = body.r;
            all.z.tail(body.nodes()) = body.z;
        }
        return all;
    }

    /// The bodies in the mesh's coordinates, which is made for all of their nodes.
    template <class Kernel>
    std::vector<Meridian<Scalar>> prepare(const Kernel& kernel, const std::vector<Meridian<Scalar>>& bodies) {
        const Meridian<Scalar> all = joined(bodies);
        prepare(kernel, all);
        std::vector<Meridian<Scalar>> local = bodies;
        for (Meridian<Scalar>& body : local) {
            body.z.array() -= centre(all);
        }
        return local;
    }

    /// The particle in the mesh's coordinates, after making sure that there is a mesh for it.
    template <class Kernel>
    Meridian<Scalar> prepare(const Kernel& kernel, const Meridian<Scalar>& particle) {
        if (!mesh_ && made_for_.nodes() > 0) {
            make_mesh(kernel, made_for_);
        }
        Meridian<Scalar> local = particle;
        local.z.array() -= centre(particle);
        for (Index i = 0; i < local.nodes(); ++i) {
            if (!(local.r[i] < radius(local.z[i]))) {
                throw SimulationFailure("the particle crosses the wall at node " + std::to_string(i));
            }
        }
        const bool made_for_it = local.nodes() == made_for_.nodes() && local.r == made_for_.r && local.z == made_for_.z;
        if (!mesh_ || !(made_for_it || mesh_->suits(local))) {
            make_mesh(kernel, local);
            ++meshes_;
        }
        return local;
    }

    /// The mesh that is there stays if that fails.
    template <class Kernel>
    void make_mesh(const Kernel& kernel, const Meridian<Scalar>& particle) {
        Mesh mesh(profile_, params_, particle);
        const PanelCurve<Scalar>& curve = mesh.curve();
        const Vector<Scalar> normals = curve.normals();
        const Vector<Scalar> weights = curve.weights();
        Vector<Scalar> flux(2 * curve.size());
        flux << weights, weights;
        flux.array() *= normals.array() / weights.sum();
        Matrix<Scalar> system = curve.single_layer(kernel);
        system.noalias() += normals * flux.transpose();
        Eigen::PartialPivLU<Matrix<Scalar>> lu(system);
        Vector<Scalar> unit_traction = lu.solve(mesh.boundary_velocity());
        if (!unit_traction.allFinite()) {
            throw SimulationFailure("wall mesh: the matrix is singular or not finite");
        }
        mesh_.emplace(std::move(mesh));
        lu_ = std::move(lu);
        unit_traction_ = std::move(unit_traction);
        made_for_ = particle;
    }

    Profile profile_;
    Params params_;
    Scalar narrowest_;
    std::optional<Mesh> mesh_;
    Eigen::PartialPivLU<Matrix<Scalar>> lu_;
    Vector<Scalar> unit_traction_;  // of the empty channel at flow rate 1
    Index meshes_ = 0;
    Meridian<Scalar> made_for_;  // in the mesh's coordinates
};

}  // namespace axistokes
