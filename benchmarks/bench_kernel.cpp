// SPDX-License-Identifier: MIT
// Time per value of K and E, and per source-target pair of the free-space kernel. items_per_second is values or pairs
// per second: its inverse is the time of one.
#include <axistokes/kernel/free_space.hpp>

#include <benchmark/benchmark.h>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using axistokes::FreeSpaceKernel;
using axistokes::Index;
using axistokes::KernelArrays;

template <class S>
std::vector<S> random_values(std::size_t n, double low, double high) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> draw(low, high);
    std::vector<S> values(n);
    for (S& value : values) {
        value = static_cast<S>(draw(random));
    }
    return values;
}

template <class S>
void elliptic_array(benchmark::State& state) {
    const std::vector<S> m1 = random_values<S>(256, 1e-6, 1.0);
    std::vector<S> k(m1.size());
    std::vector<S> e(m1.size());
    for ([[maybe_unused]] auto step : state) {
        axistokes::elliptic_ke(m1.data(), static_cast<Index>(m1.size()), k.data(), e.data());
        benchmark::DoNotOptimize(k.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(m1.size()));
}
BENCHMARK_TEMPLATE(elliptic_array, double);
BENCHMARK_TEMPLATE(elliptic_array, float);

template <class Function>
void elliptic_one_by_one(benchmark::State& state, Function function) {
    const std::vector<double> m1 = random_values<double>(256, 1e-6, 1.0);
    for ([[maybe_unused]] auto step : state) {
        for (const double x : m1) {
            benchmark::DoNotOptimize(function(x));
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(m1.size()));
}

void elliptic_scalar(benchmark::State& state) {
    elliptic_one_by_one(state, [](double x) {
        const auto value = axistokes::elliptic_ke(x);
        return value.k + value.e;
    });
}
BENCHMARK(elliptic_scalar);

void elliptic_boost(benchmark::State& state) {
    elliptic_one_by_one(state, [](double x) {
        const double modulus = std::sqrt(1.0 - x);
        return boost::math::ellint_1(modulus) + boost::math::ellint_2(modulus);
    });
}
BENCHMARK(elliptic_boost);

/// n sources and the arrays that receive one or two sets of entries.
template <class S>
struct Batch {
    explicit Batch(std::size_t n) : r(random_values<S>(n, 0.1, 2.0)), z(random_values<S>(n, 0.05, 2.0)), out(8 * n) {}

    KernelArrays<S> arrays(std::size_t set) {
        S* first = out.data() + 4 * set * r.size();
        return {first, first + r.size(), first + 2 * r.size(), first + 3 * r.size()};
    }

    std::vector<S> r;
    std::vector<S> z;
    std::vector<S> out;
};

template <class S>
void kernel_batch(benchmark::State& state) {
    Batch<S> batch(static_cast<std::size_t>(state.range(0)));
    const FreeSpaceKernel<S> kernel;
    for ([[maybe_unused]] auto step : state) {
        kernel.singular({S(0.7), S(-0.1)}, batch.r.data(), batch.z.data(), state.range(0), batch.arrays(0));
        benchmark::DoNotOptimize(batch.out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_TEMPLATE(kernel_batch, double)->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_TEMPLATE(kernel_batch, float)->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_TEMPLATE(kernel_batch, long double)->Arg(16);

void kernel_split(benchmark::State& state) {
    Batch<double> batch(static_cast<std::size_t>(state.range(0)));
    const FreeSpaceKernel<double> kernel;
    for ([[maybe_unused]] auto step : state) {
        kernel.singular_split({0.7, -0.1}, batch.r.data(), batch.z.data(), state.range(0), batch.arrays(0),
                              batch.arrays(1));
        benchmark::DoNotOptimize(batch.out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(kernel_split)->Arg(16)->Arg(256);

}  // namespace

BENCHMARK_MAIN();
