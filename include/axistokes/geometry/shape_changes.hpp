// SPDX-License-Identifier: MIT
// What a displacement of the nodes changes to first order: curvatures, the Laplacian, directions. Of a discretisation
// whose geometry follows from the derivatives of its nodes' positions with respect to a parameter, at the nodes.
#pragma once

#include "../core.hpp"
#include "curve_samples.hpp"

#include <utility>

namespace axistokes {

/// A change by d_r dr + d_r1 dr' + d_r2 dr'' + d_z1 dz' + d_z2 dz'' at each node. Nothing depends on z itself.
template <class S>
struct NodalChange {
    Vector<S> r, r1, r2, z1, z2;

    explicit NodalChange(Index n) : r(Vector<S>::Zero(n)), r1(r), r2(r), z1(r), z2(r) {}
};

/// A surface that has all that is needed for exact linearisations: `curve` at the nodes, `change(c)`, a NodalChange as
/// an operator on positions (n x 2n), `changes(c_r, c_z)`, two of them one below the other, and derivatives with
/// respect to the parameter at the nodes of nodal values, `slopes` and `second_slopes`, and of tensions,
/// `tension_slopes`. Where a surface is chosen at run time `differentiable()` tells whether this one does.
template <class Surface>
concept DifferentiableSurface = requires(const Surface& surface, const decltype(surface.mean_curvature)& values) {
    surface.curve.speed;
    surface.slopes(values);
    surface.second_slopes(values);
    surface.tension_slopes(values);
};

template <class Surface>
bool is_differentiable(const Surface& surface) {
    if constexpr (requires { surface.differentiable(); }) {
        return surface.differentiable();
    } else {
        return DifferentiableSurface<Surface>;
    }
}

/// Of H and K.
template <class S>
std::pair<NodalChange<S>, NodalChange<S>> curvature_changes(const CurveSamples<S>& x) {
    const Index n = x.r.size();
    std::pair<NodalChange<S>, NodalChange<S>> result{NodalChange<S>(n), NodalChange<S>(n)};
    for (Index i = 0; i < n; ++i) {
        const bool pole = i == 0 || i + 1 == n;
        const S v = x.speed[i];
        const S v2 = v * v;
        const S v3 = v2 * v;
        // (r' z'' - z' r'')/v^3 along the meridian, and z'/(v r) around the axis: the same at a pole.
        const S along = (x.r1[i] * x.z2[i] - x.z1[i] * x.r2[i]) / v3;
        const S around = pole ? along : S(x.z1[i] / (v * x.r[i]));
        const auto add = [&](NodalChange<S>& to, const S& by_along, const S& by_around) {
            to.r1[i] = by_along * (x.z2[i] / v3 - 3 * along * x.r1[i] / v2);
            to.z1[i] = by_along * (-x.r2[i] / v3 - 3 * along * x.z1[i] / v2);
            to.r2[i] = -by_along * x.z1[i] / v3;
            to.z2[i] = by_along * x.r1[i] / v3;
            if (!pole) {
                to.r[i] = -by_around * around / x.r[i];
                to.r1[i] -= by_around * around * x.r1[i] / v2;
                to.z1[i] += by_around * (S(1) / (v * x.r[i]) - around * x.z1[i] / v2);
            }
        };
        add(result.first, S(pole ? 1 : 0.5), S(0.5));
        add(result.second, S(pole ? 2 * along : around), along);
    }
    return result;
}

/// Of the Laplacian of nodal values h that move along, from their derivatives.
template <class S>
NodalChange<S> laplacian_change(const CurveSamples<S>& x, const Vector<S>& h1, const Vector<S>& h2) {
    const Index n = x.r.size();
    NodalChange<S> c(n);
    for (Index i = 0; i < n; ++i) {
        const S v2 = x.speed[i] * x.speed[i];
        const S v4 = v2 * v2;
        if (i == 0 || i + 1 == n) {
            // 2 h''/v^2.
            c.r1[i] = -4 * h2[i] * x.r1[i] / v4;
            continue;
        }
        // [h'' + (r'/r - w/v^2) h']/v^2, w = r' r'' + z' z''.
        const S w = x.r1[i] * x.r2[i] + x.z1[i] * x.z2[i];
        const S by_v2 = (w * h1[i] / v2 - h2[i] - (x.r1[i] / x.r[i] - w / v2) * h1[i]) / v4;
        const S by_w = -h1[i] / v4;
        c.r[i] = -x.r1[i] * h1[i] / (x.r[i] * x.r[i] * v2);
        c.r1[i] = h1[i] / (x.r[i] * v2) + 2 * by_v2 * x.r1[i] + by_w * x.r2[i];
        c.z1[i] = 2 * by_v2 * x.z1[i] + by_w * x.z2[i];
        c.r2[i] = by_w * x.r1[i];
        c.z2[i] = by_w * x.z1[i];
    }
    return c;
}

/// Of the radial and the axial component of f n + g' x'/|x'|^2, for nodal values f and g' that move along: a normal
/// force density, and a tension's gradient.
template <class S>
std::pair<NodalChange<S>, NodalChange<S>> direction_changes(const CurveSamples<S>& x, const Vector<S>& f,
                                                            const Vector<S>& g1) {
    const Index n = x.r.size();
    std::pair<NodalChange<S>, NodalChange<S>> result{NodalChange<S>(n), NodalChange<S>(n)};
    auto& [radial, axial] = result;
    for (Index i = 1; i + 1 < n; ++i) {
        const S v = x.speed[i];
        const S v2 = v * v;
        const S rr = x.r1[i] * x.r1[i] / v2;
        const S rz = x.r1[i] * x.z1[i] / v2;
        const S zz = x.z1[i] * x.z1[i] / v2;
        // n = (z', -r')/|x'|.
        const S a = f[i] / v;
        const S b = g1[i] / v2;
        radial.r1[i] = -a * rz + b * (S(1) - 2 * rr);
        radial.z1[i] = a * (S(1) - zz) - 2 * b * rz;
        axial.r1[i] = -a * (S(1) - rr) - 2 * b * rz;
        axial.z1[i] = a * rz + b * (S(1) - 2 * zz);
    }
    return result;
}

}  // namespace axistokes
