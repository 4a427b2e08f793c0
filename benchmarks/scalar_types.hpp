// SPDX-License-Identifier: MIT
// One set of programs for any scalar type: what each loses and costs (docs/work_precision.md).
#pragma once

#include <axistokes/axistokes.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace scalar_types {

using axistokes::Index;

/// Values are converted to long double so that types can be compared; `failure` is empty if there is a value.
struct Result {
    std::string scene;
    long double value = 0;
    double seconds = 0;
    std::string failure;
};

/// Drag of a sphere in a tube and velocities of settling vesicles, by P1 elements and spectrally.
template <class S>
std::vector<Result> results();

extern template std::vector<Result> results<float>();
extern template std::vector<Result> results<double>();
extern template std::vector<Result> results<long double>();

namespace detail {

using namespace axistokes;

template <class Discretization>
long double drag(Index n) {
    using S = typename Discretization::Scalar;
    Simulator<TubeKernel<S>, Discretization, RigidBody<S>, Gravity<S>, ExplicitEuler, DenseLU<S>> simulator(
        sphere<S>(n), Gravity<S>(S(4.5)), {}, TubeKernel<S>(S(2)));
    return static_cast<long double>(-1 / simulator.step().velocity);
}

/// Position of a settling vesicle after 20 steps of 1/200; a residual would stop the types at different times.
template <class Discretization>
long double settling(Index n) {
    using S = typename Discretization::Scalar;
    SimulationParams<S> params;
    params.time_step = S(1) / 200;
    params.most_steps = 20;
    params.tolerance = std::numeric_limits<S>::min();
    Simulator<FreeSpaceKernel<S>, Discretization, Vesicle<S>, Gravity<S>, SemiImplicitEuler, DenseLU<S>> simulator(
        spheroid_of_excess_area<S>(S(0.6), SpheroidKind::prolate, n), Gravity<S>(S(47)), params);
    simulator.run();
    return static_cast<long double>(simulator.configuration().position);
}

/// The median of five runs, the first being followed by four only if it was quick.
template <class Run>
Result measure(const std::string& scene, const Run& run) {
    Result result{scene, 0, 0, ""};
    std::vector<double> seconds;
    try {
        while (seconds.size() < 5 && (seconds.empty() || seconds[0] < 1)) {
            const auto begin = std::chrono::steady_clock::now();
            result.value = run();
            seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
    } catch (const SimulationFailure& failure) {
        result.failure = failure.what();
        return result;
    }
    std::sort(seconds.begin(), seconds.end());
    result.seconds = seconds[seconds.size() / 2];
    return result;
}

}  // namespace detail

template <class S>
std::vector<Result> results() {
    using Linear = axistokes::LinearElements<S>;
    using Spectral = axistokes::SpectralMeridian<S>;
    std::vector<Result> rows;
    for (const Index n : {64, 128}) {
        const std::string text = ", N = " + std::to_string(n);
        rows.push_back(detail::measure("drag, P1" + text, [&] { return detail::drag<Linear>(n); }));
        rows.push_back(detail::measure("settling, P1" + text, [&] { return detail::settling<Linear>(n); }));
    }
    for (const Index n : {12, 24, 48}) {
        const std::string text = ", N = " + std::to_string(n);
        rows.push_back(detail::measure("drag, spectral" + text, [&] { return detail::drag<Spectral>(n); }));
        rows.push_back(detail::measure("settling, spectral" + text, [&] { return detail::settling<Spectral>(n); }));
    }
    return rows;
}

}  // namespace scalar_types
