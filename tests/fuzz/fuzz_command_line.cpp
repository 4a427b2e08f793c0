// SPDX-License-Identifier: MIT
// Fuzz target: the command lines of the simulations, one argument a line, up to the parameters that they make.
#include "../../examples/support/cases.hpp"
#include "../../examples/support/command_line.hpp"
#include "../../examples/support/exit_code.hpp"
#include "../../examples/support/tube.hpp"
#include "../../examples/support/wall.hpp"
#include "bytes.hpp"

#include <sstream>
#include <vector>

namespace {

/// What `program` makes of the arguments; its messages are dropped.
int parse(std::vector<std::string> words) {
    examples::CommandLine app{"program", "A program"};
    examples::VesicleOptions vesicle;
    examples::RunOptions run;
    examples::TubeOptions tube;
    examples::WallOptions wall;
    examples::Range range(0.1, 0.5, 3);
    double bond = 47;
    std::optional<double> wall_tolerance;
    vesicle.add_to(app);
    examples::Option by_bond = app.number("--bond", bond, "Bond number");
    tube.add_to(app, "unbounded");
    wall.add_to(app);
    app.number("--wall-tolerance", wall_tolerance, "of the wall").needs("--method").excludes(by_bond);
    range.add_to(app, "--range", "values");
    run.add_to(app);

    std::vector<char*> arguments;
    words.insert(words.begin(), "program");
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    return app.run(static_cast<int>(arguments.size()), arguments.data(), [&] {
        using axistokes::fuzz::require_finite;
        run.method.check();
        const examples::RunOptions resolved = run.resolved();
        const auto params = resolved.params();
        const auto driver = resolved.driver_params();
        const axistokes::StepControl<double> control(params);
        axistokes::detail::validate(params);
        require_finite("the accuracy", driver.eps + driver.unresolved);
        require_finite("a time step", control.step());
        if (wall.meshed()) {
            axistokes::detail::validate(wall.params(wall_tolerance.value_or(1e-5)));
        }
        for (const double value : range.values()) {
            require_finite("a value of a range", value);
        }
        const axistokes::Index elements = std::min<axistokes::Index>(driver.elements.value_or(16), 64);
        const auto shape = tube.confinement ? tube.shape(vesicle, elements) : vesicle.shape(elements);
        require_finite("the initial shape", shape.r.sum() + shape.z.sum());
        return examples::success;
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> words;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    for (std::string line; std::getline(lines, line) && words.size() < 40;) {
        // What main() gets has no zeros within.
        words.push_back(line.substr(0, line.find('\0')));
    }
    const std::ostringstream dropped;
    std::streambuf* const errors = std::cerr.rdbuf(dropped.rdbuf());
    std::streambuf* const output = std::cout.rdbuf(dropped.rdbuf());
    const int code = parse(words);
    std::cerr.rdbuf(errors);
    std::cout.rdbuf(output);
    if (code != examples::success && code != examples::bad_input && code != examples::simulation_failure) {
        std::cerr << "exit code " << code << ": " << dropped.str() << '\n';
        std::abort();
    }
    return 0;
}
