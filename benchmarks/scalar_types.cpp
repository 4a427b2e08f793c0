// SPDX-License-Identifier: MIT
// The same programs in float, double and long double: prints a table of values, differences from long double and
// seconds. Each type has quadratures of its own accuracy, which the difference contains.
#include "scalar_types.hpp"

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>

int main() {
    try {
        const auto exact = scalar_types::results<long double>();
        const auto print = [&](const char* type, const std::vector<scalar_types::Result>& results) {
            for (std::size_t i = 0; i < results.size(); ++i) {
                const scalar_types::Result& r = results[i];
                std::cout << "| " << type << " | " << r.scene << " | ";
                if (!r.failure.empty()) {
                    std::cout << r.failure << " | | |" << std::endl;
                    continue;
                }
                std::cout << std::setprecision(18) << r.value << " | " << std::setprecision(2)
                          << std::abs(r.value / exact[i].value - 1) << " | " << r.seconds << " |" << std::endl;
            }
        };
        std::cout << "| type | scene | value | relative difference | seconds |\n|---|---|---|---|---|\n";
        print("float", scalar_types::results<float>());
        print("double", scalar_types::results<double>());
        print("long double", exact);
    } catch (const std::exception& error) {
        std::cerr << "scalar_types: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
