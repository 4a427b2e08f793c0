// SPDX-License-Identifier: MIT
// Error against time and against resolution, for a sphere in a tube, stationary vesicles and a transient: the paper's
// discretisation and step beside the spectral one with each integrator and Newton's method (docs/work_precision.md).
// Writes DIR/work_precision.csv, which plot_work_precision.py draws.
#include "work_precision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// Instantiated in work_precision_linear.cpp and work_precision_spectral.cpp.
namespace work_precision {

using Linear = axistokes::LinearElements<double>;
using Spectral = axistokes::SpectralMeridian<double>;
extern template Outcome drag<Linear>(double, Index);
extern template Outcome drag<Spectral>(double, Index);
extern template Outcome stationary<Linear>(Vesicle, Stepping, const Setting&);
extern template Outcome stationary<Spectral>(Vesicle, Stepping, const Setting&);
extern template Outcome transient<Linear>(Stepping, const Setting&);
extern template Outcome transient<Spectral>(Stepping, const Setting&);

namespace {

class Table {
  public:
    explicit Table(const std::filesystem::path& directory) {
        std::filesystem::create_directories(directory);
        file_.open(directory / "work_precision.csv");
        if (!file_) {
            throw std::runtime_error((directory / "work_precision.csv").string() + ": cannot be written");
        }
        file_ << "scene,line,n,steps,seconds,error\n";
        std::cout << std::left << std::setw(12) << "scene" << std::setw(22) << "line" << std::right << std::setw(5)
                  << "n" << std::setw(8) << "steps" << std::setw(12) << "seconds" << std::setw(12) << "error" << '\n';
    }

    /// Runs `run`, several times if it is quick, and adds a row with the median time. A failure is a row without error.
    template <class Run>
    void add(const std::string& scene, const std::string& line, Index n, const Outcome& exact, const Run& run) {
        std::vector<double> seconds;
        Outcome outcome;
        double total = 0;
        try {
            while (seconds.size() < 5 && (seconds.empty() || total + seconds[0] < 1.5)) {
                const auto begin = std::chrono::steady_clock::now();
                outcome = run();
                seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
                total += seconds.back();
            }
        } catch (const axistokes::SimulationFailure& failure) {
            std::cout << scene << ", " << line << ", n = " << n << ": " << failure.what() << std::endl;
            return;
        }
        std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                         seconds.end());
        const double median = seconds[seconds.size() / 2];
        const double error =
            std::max(std::abs(outcome.velocity / exact.velocity - 1), std::abs(outcome.length / exact.length - 1));
        file_ << scene << ",\"" << line << "\"," << n << ',' << outcome.steps << ',' << std::setprecision(6) << median
              << ',' << error << std::endl;
        std::cout << std::left << std::setw(12) << scene << std::setw(22) << line << std::right << std::setw(5) << n
                  << std::setw(8) << outcome.steps << std::setw(12) << std::setprecision(3) << median << std::setw(12)
                  << std::setprecision(2) << std::scientific << error << std::defaultfloat << std::endl;
    }

  private:
    std::ofstream file_;
};

void print_exact(const std::string& scene, const Outcome& exact) {
    std::cout << std::setprecision(11) << scene << ", reference: " << exact.velocity << ", " << exact.length
              << std::endl;
}

void drags(Table& table) {
    // tests/sphere_in_tube_reference.hpp
    for (const auto& [name, confinement, exact] :
         {std::tuple("drag 0.5", 0.5, 5.947374246), std::tuple("drag 0.9", 0.9, 469.2243905)}) {
        const double l = confinement;
        for (const Index n : {16, 32, 64, 130, 260, 520}) {
            table.add(name, "P1", n, {exact, 1, 0}, [&] { return drag<Linear>(l, n); });
        }
        for (const Index n : {8, 12, 16, 20, 24, 32, 40, 48}) {
            table.add(name, "spectral", n, {exact, 1, 0}, [&] { return drag<Spectral>(l, n); });
        }
    }
}

void stationary_vesicles(Table& table) {
    for (const auto& [name, scene] : {std::pair("settling", Vesicle::settling),
                                      std::pair("unbounded", Vesicle::unbounded), std::pair("tube", Vesicle::tube)}) {
        const Vesicle s = scene;
        const Outcome exact = stationary<Spectral>(s, Stepping::euler, {96, 0, 1e-4, 1e-10});
        print_exact(name, exact);
        for (const Index n : {34, 65, 130, 260}) {
            table.add(name, "P1, Euler", n, exact, [&] {
                return stationary<Linear>(s, Stepping::euler, {n, 0, 1e-4, 1e-6});
            });
        }
        for (const Index n : {34, 65, 130}) {
            table.add(name, "P1, Newton", n, exact, [&] {
                return stationary<Linear>(s, Stepping::newton, {n, 0, 1e-4, 1e-6});
            });
        }
        for (const auto& [line, stepping] :
             {std::pair("spectral, Euler", Stepping::euler), std::pair("spectral, order 2", Stepping::order2),
              std::pair("spectral, order 3", Stepping::order3), std::pair("spectral, Newton", Stepping::newton)}) {
            const Stepping how = stepping;
            for (const Index n : {12, 16, 24, 32, 40, 48, 64}) {
                table.add(name, line, n, exact, [&] { return stationary<Spectral>(s, how, {n, 0, 1e-3, 1e-9}); });
            }
        }
    }
}

void transients(Table& table) {
    const Outcome exact = transient<Spectral>(Stepping::adaptive, {64, 0, 1e-11});
    print_exact("transient", exact);
    for (const Index n : {65, 130, 260}) {
        for (const Index steps : {16, 64, 256}) {
            table.add("transient", "P1, Euler, N = " + std::to_string(n), n, exact, [&] {
                return transient<Linear>(Stepping::euler, {n, steps});
            });
        }
    }
    constexpr Index kModes = 48;
    for (const auto& [line, stepping] :
         {std::pair("spectral, Euler", Stepping::euler), std::pair("spectral, order 2", Stepping::order2),
          std::pair("spectral, order 3", Stepping::order3)}) {
        const Stepping how = stepping;
        for (const Index steps : {4, 8, 16, 32, 64, 128, 256}) {
            table.add("transient", line, kModes, exact, [&] { return transient<Spectral>(how, {kModes, steps}); });
        }
    }
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
        table.add("transient", "spectral, adaptive", kModes, exact, [&] {
            return transient<Spectral>(Stepping::adaptive, {kModes, 0, tolerance});
        });
    }
}

}  // namespace
}  // namespace work_precision

int main(int argc, char** argv) {
    const std::string directory = argc > 1 ? argv[1] : "";
    if (argc != 2 || directory.substr(0, 1) == "-") {
        std::cerr << "usage: work_precision DIR\n";
        return directory == "--help" ? EXIT_SUCCESS : 2;
    }
    try {
        work_precision::Table table(directory);
        work_precision::drags(table);
        work_precision::stationary_vesicles(table);
        work_precision::transients(table);
    } catch (const std::exception& error) {
        std::cerr << "work_precision: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
