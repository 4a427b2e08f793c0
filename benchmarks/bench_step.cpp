// SPDX-License-Identifier: MIT
// Assembly of the single layer, and one time step of a settling vesicle with each linear solver, against the number of
// elements.
#include <axistokes/axistokes.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace axistokes;

Meridian<double> pear_to_be(benchmark::State& state) {
    return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, state.range(0));
}

void single_layer(benchmark::State& state) {
    const Meridian<double> shape = pear_to_be(state);
    LinearElements<double>::Params params;
    params.tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
    const LinearElements<double> elements(params);
    const FreeSpaceKernel<double> kernel;
    for (auto _ : state) {
        benchmark::DoNotOptimize(elements.single_layer(shape, kernel));
    }
    state.SetComplexityN(state.range(0));
}

void spectral_single_layer(benchmark::State& state) {
    const Meridian<double> shape = pear_to_be(state);
    SpectralMeridian<double>::Params params;
    params.tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
    const SpectralMeridian<double> spectral(params);
    const FreeSpaceKernel<double> kernel;
    for (auto _ : state) {
        benchmark::DoNotOptimize(spectral.single_layer(shape, kernel));
    }
}

void spectral_surface_operators(benchmark::State& state) {
    const Meridian<double> shape = pear_to_be(state);
    for (auto _ : state) {
        benchmark::DoNotOptimize(spectral_surface(shape));
    }
}

void surface_operators(benchmark::State& state) {
    const Meridian<double> shape = pear_to_be(state);
    for (auto _ : state) {
        benchmark::DoNotOptimize(linear_surface(shape));
    }
}

template <class Integrator, class Solver>
void time_step(benchmark::State& state) {
    using Settling = Simulator<FreeSpaceKernel<double>, LinearElements<double>, Vesicle<double>, Gravity<double>,
                               Integrator, Solver>;
    SimulationParams<double> params;
    params.time_step = 1e-7;  // stays near the initial shape, also with the explicit integrator
    params.tolerance = 1e-12;
    Settling simulator(pear_to_be(state), Gravity<double>(47.0), params);
    for (auto _ : state) {
        benchmark::DoNotOptimize(simulator.step());
    }
}

constexpr std::initializer_list<std::int64_t> kElements{32, 64, 130, 260};

/// The second argument: with a referee, or without.
template <class Discretization>
void judged_step(benchmark::State& state) {
    const Discretization discretization;
    SimulationParams<double> params;
    params.time_step = 1e-7;
    params.tolerance = 1e-12;
    params.referee = state.range(1) != 0;
    const auto shape = [](Index elements) {
        return spheroid_of_excess_area<double>(0.6, SpheroidKind::prolate, elements);
    };
    Simulator simulator(
        Scene(FreeSpaceKernel<double>(), discretization, Vesicle<double>(), Gravity<double>(47), DenseLU<double>()),
        SemiImplicitEuler(), nodes_of(discretization, shape, state.range(0)), params);
    for (auto _ : state) {
        simulator.step();
    }
}

}  // namespace

BENCHMARK(single_layer)->ArgsProduct({kElements, {6, 8, 12}})->Unit(benchmark::kMillisecond);
BENCHMARK(spectral_single_layer)->ArgsProduct({{16, 24, 32, 48, 64, 96}, {6, 10}})->Unit(benchmark::kMillisecond);
BENCHMARK(spectral_surface_operators)->ArgsProduct({{16, 24, 32, 48, 64, 96}})->Unit(benchmark::kMillisecond);
BENCHMARK(surface_operators)->ArgsProduct({kElements})->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(time_step, SemiImplicitEuler, DenseLU<double>)
    ->ArgsProduct({kElements})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(time_step, SemiImplicitEuler, Gmres<double>)
    ->ArgsProduct({kElements})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(time_step, SemiImplicitEuler, DenseQR<double>)
    ->ArgsProduct({kElements})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(time_step, ExplicitEuler, DenseLU<double>)->ArgsProduct({kElements})->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(judged_step, LinearElements<double>)
    ->ArgsProduct({{32, 64, 128, 256}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(judged_step, SpectralMeridian<double>)
    ->ArgsProduct({{16, 32, 64, 128}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(judged_step, AdaptiveMeridian<double>)
    ->ArgsProduct({{48, 96, 192}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
