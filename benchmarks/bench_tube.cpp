// SPDX-License-Identifier: MIT
// The tube kernel: one pair, and the single layer of a long vesicle against that in free space.
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/geometry/tube_shapes.hpp>
#include <axistokes/kernel/tube_filon.hpp>

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace axistokes;

/// The red-blood-cell case of the paper's Fig. 15: 1/lambda = 0.55, excess area 4.8, as a cylinder with hemispherical
/// ends at `film` from the wall.
Meridian<double> capsule(double tube_radius, double film, Index elements) {
    const double pi = std::acos(-1.0);
    const double a = tube_radius - film;
    const double cylinder = (4.0 / 3 - 4.0 / 3 * a * a * a) / (a * a);
    const double cap = pi * a / 2;
    Meridian<double> m{Vector<double>(elements + 1), Vector<double>(elements + 1)};
    for (Index i = 0; i <= elements; ++i) {
        const double s = (2 * cap + cylinder) * static_cast<double>(i) / static_cast<double>(elements);
        const double top = s - cap - cylinder;
        m.r[i] = s < cap ? a * std::sin(s / a) : top < 0 ? a : a * std::cos(top / a);
        m.z[i] = s < cap   ? -cylinder / 2 - a * std::cos(s / a)
                 : top < 0 ? s - cap - cylinder / 2
                           : cylinder / 2 + a * std::sin(top / a);
    }
    m.r[0] = m.r[elements] = 0;
    return m;
}

LinearElements<double> elements_with(double tolerance) {
    LinearElements<double>::Params params;
    params.tolerance = tolerance;
    return LinearElements<double>(params);
}

constexpr double kTubeRadius = 0.55;
constexpr double kTolerance = 1e-8;

TubeKernel<double> tube() {
    TubeKernel<double>::Params params;
    params.tolerance = kTolerance;
    return TubeKernel<double>(kTubeRadius, params);
}

void single_layer_free(benchmark::State& state) {
    const Meridian<double> shape = capsule(kTubeRadius, 1e-3 * static_cast<double>(state.range(0)), state.range(1));
    const LinearElements<double> elements = elements_with(kTolerance);
    const FreeSpaceKernel<double> kernel;
    for ([[maybe_unused]] auto step : state) {
        benchmark::DoNotOptimize(elements.single_layer(shape, kernel));
    }
}

void single_layer_tube(benchmark::State& state) {
    const Meridian<double> shape = capsule(kTubeRadius, 1e-3 * static_cast<double>(state.range(0)), state.range(1));
    const LinearElements<double> elements = elements_with(kTolerance);
    const TubeKernel<double> kernel = tube();
    for ([[maybe_unused]] auto step : state) {
        benchmark::DoNotOptimize(elements.single_layer(shape, kernel));
    }
}

void tube_pair(benchmark::State& state) {
    const TubeKernel<double> kernel = tube();
    for ([[maybe_unused]] auto step : state) {
        benchmark::DoNotOptimize(kernel.correction({0.5, 0}, {0.52, 0.3}));
    }
}

/// The same pair, and at the same tolerance, by the paper's quadrature. An assembly takes one for each target and each
/// quadrature point, some 131 x 900 for N = 130.
void filon_pair(benchmark::State& state) {
    TubeFilonKernel<double>::Params params;
    params.tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
    const TubeFilonKernel<double> kernel(kTubeRadius, params);
    for ([[maybe_unused]] auto step : state) {
        benchmark::DoNotOptimize(kernel.correction({0.5, 0}, {0.52, 0.3}));
    }
}

}  // namespace

// Film in thousandths of R0, elements.
BENCHMARK(single_layer_free)->ArgsProduct({{200, 30, 10, 3}, {130, 260}})->Unit(benchmark::kMillisecond);
BENCHMARK(single_layer_tube)->ArgsProduct({{200, 30, 10, 3}, {130, 260}})->Unit(benchmark::kMillisecond);
BENCHMARK(tube_pair)->Unit(benchmark::kMicrosecond);
BENCHMARK(filon_pair)->DenseRange(4, 8, 2)->Unit(benchmark::kMicrosecond);
