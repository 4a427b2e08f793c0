// SPDX-License-Identifier: MIT
// What several tests share: the spheroid in closed form, orders of convergence, messages of exceptions.
#pragma once

#include <axistokes/core.hpp>
#include <axistokes/geometry/meridian.hpp>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <string>

namespace axistokes::test {

inline const double pi = std::acos(-1.0);

/// Order p of an error C h^p that falls from `coarse` to `fine` when h is halved.
inline double observed_order(double coarse, double fine) {
    return std::log2(coarse / fine);
}

/// The message of the InvalidArgument that `action` throws, or a text that no test expects.
template <class Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "nothing was thrown";
}

/// The message of the SimulationFailure that `action` throws, likewise.
template <class Action>
std::string failure(const Action& action) {
    try {
        action();
    } catch (const SimulationFailure& error) {
        return error.what();
    }
    return "nothing was thrown";
}

inline bool mentions(const std::string& message, const std::string& argument, const std::string& value,
                     const std::string& accepted) {
    return message.find(argument) != std::string::npos && message.find(value) != std::string::npos &&
           message.find(accepted) != std::string::npos;
}

/// r = a sin t, z = -c cos t, t from 0 at the lower pole to pi.
struct Spheroid {
    double a;
    double c;

    /// Parameter of a point of the surface.
    double parameter(double r, double z) const { return std::atan2(r / a, -z / c); }
    double speed(double t) const { return std::hypot(a * std::cos(t), c * std::sin(t)); }
    double meridional(double t) const { return a * c / std::pow(speed(t), 3); }
    double azimuthal(double t) const { return c / (a * speed(t)); }
    double mean(double t) const { return (meridional(t) + azimuthal(t)) / 2; }
    double gauss(double t) const { return meridional(t) * azimuthal(t); }
    Point<double> normal(double t) const { return {c * std::sin(t) / speed(t), -a * std::cos(t) / speed(t)}; }
    /// Relative distance from the surface, to first order: 0 on it.
    double distance(double r, double z) const { return (r * r / (a * a) + z * z / (c * c) - 1) / 2; }

    /// Int f(t) dA.
    template <class F>
    double integral(const F& f) const {
        const auto density = [&](double t) { return f(t) * 2 * pi * a * std::sin(t) * speed(t); };
        double sum = 0;
        for (int i = 0; i < 8; ++i) {
            sum += boost::math::quadrature::gauss<double, 30>::integrate(density, pi * i / 8, pi * (i + 1) / 8);
        }
        return sum;
    }
    double area() const {
        return integral([](double) { return 1.0; });
    }
    double volume() const { return 4 * pi / 3 * a * a * c; }
    double bending_energy() const {
        return integral([this](double t) { return 2 * mean(t) * mean(t); });
    }

    /// Nodes at t = pi x + stretch sin(2 pi x)/2 of equally spaced x: an uneven but smooth spacing.
    Meridian<double> meridian(Index elements, double stretch = 0) const {
        Meridian<double> m{Vector<double>(elements + 1), Vector<double>(elements + 1)};
        for (Index i = 0; i <= elements; ++i) {
            const double x = static_cast<double>(i) / static_cast<double>(elements);
            const double t = pi * x + stretch * std::sin(2 * pi * x) / 2;
            m.r[i] = i == 0 || i == elements ? 0 : a * std::sin(t);
            m.z[i] = -c * std::cos(t);
        }
        return m;
    }
};

}  // namespace axistokes::test
