// SPDX-License-Identifier: MIT
// A membrane tube under tension against the linear theory of its pearling (Boedec, Jaeger, Leonetti, J. Fluid Mech. 743
// (2014) 262): the rate at which a small disturbance grows, its threshold and the fastest mode.
#include "catch.hpp"
#include <axistokes/axistokes.hpp>

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace {

using namespace axistokes;
using Vec = Vector<double>;
const double pi = detail::pi_value<double>();

/// Pulls at the two ends of a tube, whose middle it leaves alone.
class Pull {
  public:
    using Scalar = double;
    static constexpr bool has_flow = false;
    static constexpr bool has_load = true;

    Pull(double pressure, double from, double width) : pressure_(pressure), from_(from), width_(width) {}
    Point<double> velocity(const Point<double>&) const { return {}; }
    double normal_load(const Point<double>& x) const {
        return pressure_ * (1 + std::tanh((std::abs(x.z) - from_) / width_)) / 2;
    }
    double velocity_scale() const { return 1; }

  private:
    double pressure_, from_, width_;
};

/// r = 1 + e cos(kz) between hemispheres: the tube's radius is the unit of length. The disturbance ends before the
/// caps.
Meridian<double> tube(double half_length, double k, double e, Index n) {
    Meridian<double> m{Vec(n + 1), Vec(n + 1)};
    const double total = pi + 2 * half_length;
    for (Index i = 0; i <= n; ++i) {
        const double s = total * double(i) / double(n) - total / 2;  // from the middle
        const double over = std::abs(s) - half_length;
        if (over > 0) {
            m.r[i] = std::cos(over);
            m.z[i] = std::copysign(half_length + std::sin(over), s);
        } else {
            m.r[i] = 1;
            m.z[i] = s;
        }
        // A sharp end would be heard in the middle: flows along the tube reach far.
        const double fade = 3 / k;
        const double window = (1 - std::tanh((std::abs(m.z[i]) - half_length + 4 + 3 * fade) / fade)) / 2;
        m.r[i] *= 1 + e * std::cos(k * m.z[i]) * window;
    }
    m.r[0] = m.r[n] = 0;
    return m;
}

struct Mode {
    double tension;
    double rate;
};

/// From the velocities in the middle of two tubes with opposite disturbances.
Mode simulated(double pressure, double k) {
    const double half_length = 6 * pi / k + 10 + 9 / k;
    AdaptiveMeridian<double>::Params params;
    params.tolerance = 1e-9;
    const AdaptiveMeridian<double> d(params);
    const auto n = 2 * static_cast<Index>(2.5 * half_length);
    const double e = 1e-4;
    Scene scene(FreeSpaceKernel<double>(), d, Vesicle<double>(), Pull(pressure, half_length, 1.0), DenseLU<double>());
    std::vector<Vec> radial;
    Mode mode{};
    const Index middle = n / 2;
    for (const double sign : {1.0, -1.0}) {
        const Configuration<double> body{tube(half_length, k, sign * e, n), 0.0, {}};
        const auto instant = scene.evaluate(body, 0.0);
        radial.push_back(instant.solution.velocity.head(n + 1));
        mode.tension += instant.surface.at_nodes(instant.solution.tension)[middle] / 2;
    }
    // Normal velocities there are radial ones.
    mode.rate = (radial[0][middle] - radial[1][middle]) / (2 * e);
    return mode;
}

/// Of r = 1 + e cos(kz) on an infinite tube under a tension, the same fluid inside and outside. The force density that
/// the disturbance causes is, in kappa and along the normal,
///   -k^4 + k^2/2 - 3/2 + (1 - k^2) tension - g,   and k g along the tube,
/// g cos(kz) the tension that keeps the membrane from stretching, k u_z + u_r = 0. Velocities follow from the forces by
/// the Fourier transform of rings of Stokeslets.
double theory(double tension, double k) {
    using boost::math::cyl_bessel_i;
    using boost::math::cyl_bessel_k;
    const double i0 = cyl_bessel_i(0, k);
    const double i1 = cyl_bessel_i(1, k);
    const double k0 = cyl_bessel_k(0, k);
    const double k1 = cyl_bessel_k(1, k);
    const double zz = (2 * i0 * k0 - k * i0 * k1 + k * i1 * k0) / 2;
    const double rr = (2 * i1 * k1 + k * i1 * k0 - k * i0 * k1) / 2;
    const double rz = k * (i1 * k1 - i0 * k0) / 2;
    const double f = -k * k * k * k + k * k / 2 - 1.5 + (1 - k * k) * tension;
    // u_r = rr (f - g) - rz k g, u_z = rz (f - g) - zz k g.
    const double g = f * (k * rz + rr) / (k * rz + rr + k * (k * zz + rz));
    return rr * (f - g) - rz * k * g;
}

}  // namespace

TEST_CASE("pearling: disturbances of a tube grow as the linear theory says") {
    double fastest = 0;
    double fastest_in_theory = 0;
    double best = 0;
    double best_in_theory = 0;
    for (const double k : {0.3, 0.45, 0.6, 0.75, 0.9, 1.2}) {
        const Mode mode = simulated(40, k);
        INFO("k = " << k << ", tension " << mode.tension);
        const double expected = theory(mode.tension, k);
        CHECK(mode.rate == Approx(expected).epsilon(1e-3));
        if (mode.rate > best) {
            best = mode.rate;
            fastest = k;
        }
        if (expected > best_in_theory) {
            best_in_theory = expected;
            fastest_in_theory = k;
        }
    }
    CHECK(fastest == fastest_in_theory);
    CHECK(fastest == 0.6);
}

TEST_CASE("pearling: long disturbances grow above a tension of 3/2 kappa/r^2") {
    CHECK(theory(1.5, 1e-3) == Approx(0).margin(1e-6));
    bool grows = false;
    bool decays = false;
    for (const double pressure : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        const Mode mode = simulated(pressure, 0.3);
        INFO("tension " << mode.tension);
        CHECK(mode.rate == Approx(theory(mode.tension, 0.3)).epsilon(1e-3).margin(1e-4));
        const double neutral = (1.5 - 0.045 + 0.0081) / 0.91;
        if (std::abs(mode.tension / neutral - 1) > 0.02) {
            CHECK((mode.rate > 0) == (mode.tension > neutral));
            grows = grows || mode.rate > 0;
            decays = decays || mode.rate < 0;
        }
    }
    CHECK(grows);
    CHECK(decays);
}
