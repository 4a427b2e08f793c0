// SPDX-License-Identifier: MIT
// Median processor times of two pieces of work, measured in turn so that other load on the machine meets both alike.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <utility>
#include <vector>

namespace examples {

template <class First, class Second>
std::pair<double, double> median_seconds(int repetitions, const First& first, const Second& second) {
    const auto seconds = [](const auto& work) {
        const std::clock_t begin = std::clock();
        work();
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    std::vector<double> of_first;
    std::vector<double> of_second;
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
