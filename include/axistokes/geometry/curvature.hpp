// SPDX-License-Identifier: MIT
// Fourth-order curvatures and bending energy of a meridian, for reporting: differences in the node index, in which a
// smoothly spaced meridian is a smooth curve, continued across the poles by symmetry (r odd, z even).
#pragma once

#include "meridian.hpp"

#include <cmath>

namespace axistokes {

/// Principal curvatures at the nodes, positive on a sphere, in 1/R0, and the length of a unit of the node index.
template <class S>
struct PrincipalCurvatures {
    Vector<S> meridional;
    Vector<S> azimuthal;
    Vector<S> speed;

    Vector<S> mean() const { return (meridional + azimuthal) / 2; }
};

namespace detail {

/// Values at -2, ..., n + 1 of a function of the node index, reflected at both ends with the given sign.
template <class S>
Vector<S> reflected(const Vector<S>& values, int sign) {
    const Index n = values.size();
    Vector<S> all(n + 4);
    all.segment(2, n) = values;
    for (const Index k : {1, 2}) {
        all[2 - k] = S(sign) * values[k];
        all[n + 1 + k] = S(sign) * values[n - 1 - k];
    }
    return all;
}

}  // namespace detail

template <class S>
PrincipalCurvatures<S> principal_curvatures(const Meridian<S>& meridian) {
    using std::sqrt;
    const Index n = meridian.nodes();
    const Vector<S> r = detail::reflected(meridian.r, -1);
    const Vector<S> z = detail::reflected(meridian.z, 1);
    const auto first = [](const Vector<S>& f, Index i) {
        return S((f[i - 2] - f[i + 2] + 8 * (f[i + 1] - f[i - 1])) / 12);
    };
    const auto second = [](const Vector<S>& f, Index i) {
        return S((16 * (f[i - 1] + f[i + 1]) - f[i - 2] - f[i + 2] - 30 * f[i]) / 12);
    };
    PrincipalCurvatures<S> k{Vector<S>(n), Vector<S>(n), Vector<S>(n)};
    for (Index i = 0; i < n; ++i) {
        const S dr = first(r, i + 2);
        const S dz = first(z, i + 2);
        const S speed = sqrt(dr * dr + dz * dz);
        k.speed[i] = speed;
        k.meridional[i] = (dr * second(z, i + 2) - dz * second(r, i + 2)) / (speed * speed * speed);
        const bool pole = i == 0 || i + 1 == n;
        k.azimuthal[i] = pole ? k.meridional[i] : S(dz / (speed * meridian.r[i]));
    }
    return k;
}

/// 2 Int H^2 dA in kappa (8 pi for a sphere), by the trapezoidal rule with its first end correction.
template <class S>
S bending_energy(const Meridian<S>& meridian) {
    const PrincipalCurvatures<S> k = principal_curvatures(meridian);
    const Vector<S> h2 = k.mean().cwiseAbs2();
    const Index last = meridian.nodes() - 1;
    // The integrand 4 pi H^2 r |x'| vanishes at the poles, with the slopes +-4 pi H^2 |x'|^2 there.
    const S ends = h2[0] * k.speed[0] * k.speed[0] + h2[last] * k.speed[last] * k.speed[last];
    return 4 * detail::pi_value<S>() * (h2.cwiseProduct(k.speed).dot(meridian.r) + ends / 12);
}

}  // namespace axistokes
