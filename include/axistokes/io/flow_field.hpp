// SPDX-License-Identifier: MIT
// The velocity of the fluid around (and in) a membrane, on a grid of the meridian half-plane.
#pragma once

#include "../equation/flux.hpp"
#include "../scene.hpp"

#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

namespace axistokes {

/// Grid of columns x rows nodes on 0 <= r <= radius, |z - centroid| <= half_length (in R0).
template <class S>
struct FlowGrid {
    S radius = S(3);
    S half_length = S(4);
    Index columns = 61;
    Index rows = 161;
};

/// Nodes in rows of equal z (index row * columns + column); z relative to the centroid, velocities in the laboratory
/// frame.
template <class S>
struct FlowField {
    FlowGrid<S> grid;
    Meridian<S> points;
    Vector<S> velocity_r;
    Vector<S> velocity_z;
    std::vector<bool> inside;  // the membrane
};

namespace detail {

template <class S>
FlowGrid<S> checked(FlowGrid<S> grid) {
    using std::isfinite;
    require(grid.radius > S(0) && isfinite(grid.radius), "radius of the flow grid", grid.radius, "> 0 and finite");
    require(grid.half_length > S(0) && isfinite(grid.half_length), "half length of the flow grid", grid.half_length,
            "> 0 and finite");
    require(grid.columns >= 2 && grid.columns <= 10000, "columns of the flow grid", grid.columns, "in [2, 10000]");
    require(grid.rows >= 2 && grid.rows <= 10000, "rows of the flow grid", grid.rows, "in [2, 10000]");
    return grid;
}

/// Whether a point is enclosed by the elements of a meridian and the axis: counts the crossings of the ray r ->
/// infinity.
template <class S>
bool encloses(const Meridian<S>& meridian, const Point<S>& x) {
    bool inside = false;
    for (Index e = 0; e < meridian.elements(); ++e) {
        const S z1 = meridian.z[e];
        const S z2 = meridian.z[e + 1];
        if ((z1 > x.z) != (z2 > x.z)) {
            const S t = (x.z - z1) / (z2 - z1);
            inside ^= meridian.r[e] + t * (meridian.r[e + 1] - meridian.r[e]) > x.r;
        }
    }
    return inside;
}

/// The node of a meridian at a point, where the kernel is singular, or -1.
template <class S>
Index node_at(const Meridian<S>& meridian, const Point<S>& x) {
    using std::abs;
    for (Index i = 0; i < meridian.nodes(); ++i) {
        if (abs(meridian.r[i] - x.r) + abs(meridian.z[i] - x.z) < S(1e-6)) {
            return i;
        }
    }
    return -1;
}

}  // namespace detail

/// The velocity u = u_inf + G f of the fluid around the one body of a scene, with the flow of a meshed wall, as a
/// function of points off the body, z relative to the centroid: stacked, in the laboratory frame. `reach`: the largest
/// |z| of a point.
template <class SceneType, class S, class Surface>
auto fluid_velocity(const SceneType& scene, const Configuration<S>& configuration, const Instant<S, Surface>& instant,
                    const S& reach) {
    // The uniform pressure in f moves nothing: without it, neither does its discretisation error.
    const Vector<S> force = detail::without_flux<S>(instant.surface, instant.solution.force);
    constexpr bool walled = std::remove_cvref_t<decltype(scene.wall())>::present;
    const auto disturbance = [&] {
        if constexpr (walled) {
            // The scene's mesh need not reach as far. It is kept alive with the field that refers to it.
            auto wall = std::make_shared<std::remove_cvref_t<decltype(scene.wall())>>(scene.wall().reaching(reach));
            return [wall,
                    channel = wall->field(scene.discretization(), scene.kernel(),
                                          detail::shifted(configuration.shape, configuration.position), force),
                    z = configuration.position](const Meridian<S>& points) {
                return channel.velocity(detail::shifted(points, z));
            };
        } else {
            const S z = std::remove_cvref_t<decltype(scene.kernel())>::laboratory_frame ? configuration.position : S(0);
            return [&scene, shape = detail::shifted(configuration.shape, z), force, z](const Meridian<S>& points) {
                return Vector<S>(
                    scene.discretization().single_layer_at(detail::shifted(points, z), shape, scene.kernel()) * force);
            };
        }
    }();
    if constexpr (std::remove_cvref_t<decltype(scene.flow())>::has_flow) {
        return [disturbance, &scene, position = configuration.position](const Meridian<S>& points) {
            Vector<S> velocity = disturbance(points);
            const Index n = points.nodes();
            for (Index i = 0; i < n; ++i) {
                const Point<S> background = scene.flow().velocity({points.r[i], points.z[i] + position});
                velocity[i] += background.r;
                velocity[n + i] += background.z;
            }
            return velocity;
        };
    } else {
        return disturbance;
    }
}

/// The velocity at the grid's nodes; 0 beyond the wall. In a tube the grid ends there. Throws InvalidArgument when the
/// grid is not positive, finite and of at least 2 x 2 nodes.
template <class SceneType, class S, class Surface>
FlowField<S> flow_field(const SceneType& scene, const Configuration<S>& configuration,
                        const Instant<S, Surface>& instant, FlowGrid<S> grid = {}) {
    const auto& kernel = scene.kernel();
    if constexpr (requires(Point<S> x) { kernel.unit_flow(x); }) {
        using std::isfinite;
        const S radius = kernel.gap({S(0), configuration.position});
        if (isfinite(radius)) {
            grid.radius = radius;
        }
    }
    FlowField<S> field{detail::checked(grid), {}, {}, {}, {}};
    const Index count = grid.columns * grid.rows;
    field.points = {Vector<S>(count), Vector<S>(count)};
    field.velocity_r.resize(count);
    field.velocity_z.resize(count);
    field.inside.resize(static_cast<std::size_t>(count));
    const auto fluid = fluid_velocity(scene, configuration, instant, grid.half_length);

    // A row at a time: the matrix for all points would be large.
    const Index n = grid.columns;
    Meridian<S> row{Vector<S>::LinSpaced(n, S(0), grid.radius), Vector<S>(n)};
    for (Index k = 0; k < grid.rows; ++k) {
        row.z.setConstant(grid.half_length * (S(2 * k) / S(grid.rows - 1) - S(1)));
        const Vector<S> velocity = fluid(row);
        for (Index i = 0; i < n; ++i) {
            const Index node = k * n + i;
            const Point<S> x{row.r[i], row.z[i]};
            field.points.r[node] = x.r;
            field.points.z[node] = x.z;
            field.inside[static_cast<std::size_t>(node)] = detail::encloses(configuration.shape, x);
            if (!(scene.gap({x.r, x.z + configuration.position}) > S(0))) {
                field.velocity_r[node] = field.velocity_z[node] = S(0);
                continue;
            }
            const Index on_membrane = detail::node_at(configuration.shape, x);
            if (on_membrane >= 0) {
                field.velocity_r[node] = instant.solution.velocity[on_membrane];
                field.velocity_z[node] = instant.solution.velocity[configuration.shape.nodes() + on_membrane];
                continue;
            }
            field.velocity_r[node] = velocity[i];
            field.velocity_z[node] = velocity[n + i];
        }
    }
    return field;
}

}  // namespace axistokes
