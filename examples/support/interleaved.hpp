// SPDX-License-Identifier: MIT
// Median times of two pieces of work, measured in turn so that other load on the machine meets both alike.
#pragma once

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace examples {

template <class First, class Second>
std::pair<double, double> median_seconds(int repetitions, const First& first, const Second& second) {
    const auto seconds = [](const auto& work) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    std::vector<double> of_first, of_second;
    for (int k = 0; k < repetitions; ++k) {
        of_first.push_back(seconds(first));
        of_second.push_back(seconds(second));
    }
    const auto median = [](std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return {median(of_first), median(of_second)};
}

}  // namespace examples
