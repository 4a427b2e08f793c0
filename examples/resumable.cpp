// SPDX-License-Identifier: MIT
// A vesicle settles. Killed and started again, the program goes on where it was.
#include <axistokes/axistokes.hpp>

#include <filesystem>
#include <iostream>

int main() {
    using namespace axistokes;
    const Scene scene(FreeSpaceKernel<>(), LinearElements<>(), Vesicle<>(), Gravity(47.0), DenseLU<>());
    Simulator simulator(scene, SemiImplicitEuler(), spheroid_of_excess_area(0.6, SpheroidKind::prolate, 48));

    const std::filesystem::path file = "settling.journal";
    const auto journal =
        std::filesystem::exists(file) ? StepJournal<double>::resume(file) : StepJournal<double>::create(file);
    simulator.record_in(journal);  // takes the steps that are there, and records the next ones
    simulator.run();

    write_csv("settling.csv", history_columns(simulator.history()));
    journal->remove();
    std::cout << "velocity " << simulator.history().back().velocity << " after " << simulator.history().size()
              << " steps\n";
}
