// SPDX-License-Identifier: MIT
// A rigid sphere on the axis of a tube, to as many digits as the type carries: multipoles at the sphere's centre, each
// with the wall's correction as a Fourier integral, fitted to the velocity on the sphere (docs/sphere_in_tube.md).
// Shares no code with the library: Legendre and Bessel functions, modes and quadrature are its own or Boost's.
//
// Lengths in sphere radii, viscosity 1, velocities in the sphere's or in that of the flow on the axis. Angles theta are
// counted from the pole on the side of positive z.
#pragma once

#include <axistokes/core.hpp>

#include <Eigen/QR>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace axistokes::test {

template <class S>
class SphereInTube {
  public:
    using Rows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
    using Column = Eigen::Matrix<S, Eigen::Dynamic, 1>;

    /// A motion of sphere and fluid: amplitudes of the multipoles and of the modes that correct them at the wall,
    /// velocity of the sphere, and the undisturbed velocity on the axis.
    struct Motion {
        Column multipoles;
        Column modes;
        S velocity;
        S flow;

        Motion operator+(const Motion& b) const {
            return {multipoles + b.multipoles, modes + b.modes, velocity + b.velocity, flow + b.flow};
        }
        Motion operator*(const S& factor) const {
            return {factor * multipoles, factor * modes, factor * velocity, factor * flow};
        }
    };

    /// `pairs`: multipoles of either kind; 0: as many as matter to the type. Confinements that take Bessel functions
    /// beyond the type's range are refused: above 0.971 in double, 0.9978 in long double of 64 bits.
    explicit SphereInTube(S confinement, Index pairs = 0) : confinement_(confinement) {
        using std::log;
        detail::require(confinement > S(0) && confinement < S(1), "confinement", confinement, "in (0, 1)");
        detail::require(last_wave() < log(std::numeric_limits<S>::max()), "confinement", confinement,
                        "such that exp(log(1/eps)/(2 (1 - confinement))) is within the type's range");
        pairs_ = pairs > 0 ? pairs : sufficient_pairs(confinement);
        make_spectrum();
        // Equal angles, twice as many equations as unknowns; by symmetry half of the sphere does.
        const Index points = 2 * pairs_;
        Rows fit(2 * points, 2 * pairs_);
        Rows modes(2 * points, amplitudes_.rows());
        Rows wanted(2 * points, 2);
        for (Index i = 0; i < points; ++i) {
            const S theta = pi() / 2 * (S(i) + S(0.5)) / S(points);
            fit.middleRows(2 * i, 2) = multipole_rows(theta).topRows(2);
            modes.middleRows(2 * i, 2) = mode_rows(theta).topRows(2);
            wanted.row(2 * i).setZero();
            wanted.row(2 * i + 1) << S(1), -poiseuille(theta);
        }
        fit += modes * amplitudes_;
        const Rows solution = Eigen::ColPivHouseholderQR<Rows>(fit).solve(wanted);
        dragged_ = {solution.col(0), amplitudes_ * solution.col(0), 1, 0};
        fixed_ = {solution.col(1), amplitudes_ * solution.col(1), 0, 1};
    }

    const S& confinement() const { return confinement_; }
    Index pairs() const { return pairs_; }

    /// Moving with velocity 1 through fluid at rest; at rest in Poiseuille flow; floating freely in it.
    const Motion& dragged() const { return dragged_; }
    const Motion& fixed() const { return fixed_; }
    Motion floating() const { return fixed_ + dragged_ * velocity_ratio(); }

    /// Force on the sphere along z: that of the Stokeslet.
    S force(const Motion& motion) const { return 8 * pi() * motion.multipoles[0]; }
    /// Drag of the moving and of the fixed sphere over 6 pi.
    S drag_factor() const { return -force(dragged_) / (6 * pi()); }
    S fixed_drag_factor() const { return force(fixed_) / (6 * pi()); }
    S velocity_ratio() const { return fixed_drag_factor() / drag_factor(); }

    /// Added by the sphere, upstream minus downstream: only Stokeslet and source dipole leave one.
    S pressure_drop(const Motion& motion) const {
        const S squared = confinement_ * confinement_;
        return squared * (16 * motion.multipoles[0] + 32 * squared * motion.multipoles[pairs_]);
    }

    /// Force of the sphere on the fluid per area; its normal part averages to zero, as the pressure is odd in z.
    Point<S> traction(const Motion& motion, const S& theta) const {
        using std::cos;
        using std::sin;
        const S s = sin(theta);
        const S x = cos(theta);
        const Column f = field(motion, theta);
        const S squared = confinement_ * confinement_;
        const S pressure = f[4] - 4 * squared * x * motion.flow;
        // Without slip the velocity's gradient is n du/dn, and n.du/dn = 0: sigma.n = -p n + du/dn.
        return {pressure * s - f[2], pressure * x - (f[3] - 2 * squared * s * s * motion.flow)};
    }

    /// Largest velocity on the sphere that should not be there, at the points of the fit's grid and between them.
    S residual(const Motion& motion) const {
        using std::max;
        using std::sqrt;
        S worst = 0;
        for (Index i = 0; i <= 4 * pairs_; ++i) {
            const S theta = pi() / 2 * S(i) / S(4 * pairs_);
            const Column f = field(motion, theta);
            const S along = f[1] + motion.flow * poiseuille(theta) - motion.velocity;
            worst = max(worst, S(sqrt(f[0] * f[0] + along * along)));
        }
        return worst;
    }

    /// Of the drag factor of `motion`, for lack of fit on the sphere. A velocity du on the sphere changes the drag by
    /// Int f.du dA, f the traction of the dragged sphere (reciprocal theorem): at most by residual times Int |f| dA.
    S error_bound(const Motion& motion) const {
        using std::sqrt;
        const S total = integral([this](const S& theta) {
            const Point<S> f = traction(dragged_, theta);
            return S(sqrt(f.r * f.r + f.z * f.z));
        });
        return residual(motion) * total / (6 * pi());
    }

    /// Int g(theta) dA for a g that is even in z.
    template <class Function>
    static S integral(const Function& g) {
        using std::sin;
        constexpr int panels = 8;
        S sum = 0;
        for (int i = 0; i < panels; ++i) {
            sum += Gauss::integrate([&](const S& theta) { return S(g(theta) * sin(theta)); }, pi() / 2 * i / panels,
                                    pi() / 2 * (i + 1) / panels);
        }
        return 4 * pi() * sum;
    }

  private:
    using Gauss = boost::math::quadrature::gauss<S, 20>;

    static S pi() { return boost::math::constants::pi<S>(); }

    /// The multipoles decay like the powers of the distance of the image point of a sphere and a plane wall.
    static Index sufficient_pairs(const S& confinement) {
        using std::log;
        using std::sqrt;
        const S wall = 1 / confinement;
        const S rate = wall - sqrt(wall * wall - 1);
        return 6 + static_cast<Index>(log(std::numeric_limits<S>::epsilon()) / log(rate) / 2);
    }

    /// What is left of the correction on the sphere decays like exp(-2 W (1 - confinement)).
    S last_wave() const {
        using std::log;
        return (5 - log(std::numeric_limits<S>::epsilon())) / (2 * (1 - confinement_));
    }

    /// Gauss nodes in W = zeta Rc and the correction's amplitudes there, for all multipoles.
    void make_spectrum() {
        const S last = last_wave();
        // Graded towards the logarithm at 0; short where the low multipoles vary.
        S left = 0;
        S right = std::numeric_limits<S>::epsilon();
        while (left < last) {
            add_panel(left, right);
            left = right;
            right = left < S(0.5) ? 4 * left : left + (left < S(32) ? 2 : 6);
        }
        amplitudes_.resize(2 * static_cast<Index>(nodes_.size()), 2 * pairs_);
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            set_amplitudes(static_cast<Index>(k), nodes_[k]);
        }
    }

    struct Node {
        S w;
        S weight;
    };

    void add_panel(const S& left, const S& right) {
        const auto& x = Gauss::abscissa();
        const S half = (right - left) / 2;
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (const S sign : {S(-1), S(1)}) {
                nodes_.push_back({left + half * (1 + sign * x[i]), half * Gauss::weights()[i]});
            }
        }
    }

    struct Bessel {
        S i0, i1, i2;
    };

    /// e^(-W) I(t).
    static Bessel bessel(const S& t, const S& w) {
        using std::exp;
        const S scale = exp(-w);
        const S i0 = boost::math::cyl_bessel_i(0, t);
        const S i1 = boost::math::cyl_bessel_i(1, t);
        const S i2 = t < S(1) ? small_i2(t) : S(i0 - 2 * i1 / t);
        return {scale * i0, scale * i1, scale * i2};
    }

    static S small_i2(const S& t) {
        const S q = t * t / 4;
        S term = q / 2;
        S sum = 0;
        for (int k = 1; term > sum * std::numeric_limits<S>::epsilon() / 4; ++k) {
            sum += term;
            term *= q / S(k * (k + 2));
        }
        return sum;
    }

    /// Amplitudes of the modes A: (u_r, u_z) = (I1 sin, I0 cos), B: (t I2 sin, t I1 cos) that cancel a multipole whose
    /// coefficients at the wall are u_r, u_z; times e^W.
    void set_amplitudes(Index k, const Node& node) {
        const S& w = node.w;
        const S zeta = confinement_ * w;
        const Bessel i = bessel(w, w);
        const S k0 = boost::math::cyl_bessel_k(0, w);
        const S k1 = boost::math::cyl_bessel_k(1, w);
        const S determinant = w * (i.i0 * i.i2 - i.i1 * i.i1);
        const auto cancel = [&](const S& u_r, const S& u_z) {
            return Point<S>{w * (u_r * i.i1 - u_z * i.i2) / determinant, (u_z * i.i1 - u_r * i.i0) / determinant};
        };
        const Point<S> stokeslet = cancel(-w * k0, w * k1 - 2 * k0);
        const Point<S> dipole = cancel(-zeta * k1, zeta * k0);
        S factor = 2 / pi() * node.weight * confinement_;  // (-1)^(n/2) zeta^n/n!
        for (Index j = 0; j < pairs_; ++j) {
            const S next = factor * zeta / S(2 * j + 1);
            amplitudes_(2 * k, j) = factor * stokeslet.r;
            amplitudes_(2 * k + 1, j) = factor * stokeslet.z;
            amplitudes_(2 * k, pairs_ + j) = next * dipole.r;
            amplitudes_(2 * k + 1, pairs_ + j) = next * dipole.z;
            factor = -next * zeta / S(2 * j + 2);
        }
    }

    S poiseuille(const S& theta) const {
        using std::sin;
        const S x = confinement_ * sin(theta);
        return 1 - x * x;
    }

    /// Disturbance on the sphere: u_r, u_z, their derivatives along the normal, pressure.
    Column field(const Motion& motion, const S& theta) const {
        return multipole_rows(theta) * motion.multipoles + mode_rows(theta) * motion.modes;
    }

    /// With phi_n = P_n/R^(n+1) and p = 2 dB/dz, u = z grad B - B e_z + grad chi is a Stokes flow for harmonic B, chi.
    /// S_n: B = phi_n, chi = -phi_(n-1), n even, the derivatives of the Stokeslet; D_m: chi = phi_m, m odd. Both are
    /// homogeneous in R, of degree -(n+1) and -(m+2); grad phi_n = (-s P'_(n+1), -(n+1) P_(n+1)) on the sphere.
    Rows multipole_rows(const S& theta) const {
        using std::cos;
        using std::sin;
        const S s = sin(theta);
        const S x = cos(theta);
        Rows rows(5, 2 * pairs_);
        S p = 1;  // P_n
        S p_next = x;
        S d = 0;  // its derivative
        S d_next = 1;
        for (Index n = 0; n < 2 * pairs_; ++n) {
            const bool even = n % 2 == 0;
            const S degree = even ? -S(n + 1) : -S(n + 2);
            const S u_r = even ? S(s * (d - x * d_next)) : S(-s * d_next);
            const S u_z = even ? S(S(n - 1) * p - S(n + 1) * x * p_next) : S(-S(n + 1) * p_next);
            const S pressure = even ? S(-2 * S(n + 1) * p_next) : S(0);
            rows.col(even ? n / 2 : pairs_ + n / 2) << u_r, u_z, degree * u_r, degree * u_z, pressure;
            const S p_after = (S(2 * n + 3) * x * p_next - S(n + 1) * p) / S(n + 2);
            const S d_after = d + S(2 * n + 3) * p_next;
            p = p_next;
            p_next = p_after;
            d = d_next;
            d_next = d_after;
        }
        return rows;
    }

    /// Modes A and B of every node: the derivative along the normal is r d/dr + z d/dz.
    Rows mode_rows(const S& theta) const {
        using std::cos;
        using std::sin;
        Rows rows(5, 2 * static_cast<Index>(nodes_.size()));
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const S zeta = confinement_ * nodes_[k].w;
            const S t = zeta * sin(theta);
            const S phase = zeta * cos(theta);
            const S c = cos(phase);
            const S d = sin(phase);
            const Bessel i = bessel(t, nodes_[k].w);
            const S ti1 = t * i.i1;
            const S ti2 = t * i.i2;
            const auto column = 2 * static_cast<Index>(k);
            rows.col(column) << i.i1 * d, i.i0 * c, (t * i.i0 - i.i1) * d + phase * i.i1 * c,
                ti1 * c - phase * i.i0 * d, S(0);
            rows.col(column + 1) << ti2 * d, ti1 * c, (t * ti1 - ti2) * d + phase * ti2 * c,
                t * t * i.i0 * c - phase * ti1 * d, 2 * zeta * i.i0 * d;
        }
        return rows;
    }

    S confinement_;
    Index pairs_ = 0;
    std::vector<Node> nodes_;
    Rows amplitudes_;  // of the modes A, B of every node, for a unit of each multipole: first all S_n, then all D_m
    Motion dragged_;
    Motion fixed_;
};

}  // namespace axistokes::test
