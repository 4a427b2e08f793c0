// SPDX-License-Identifier: MIT
// What every example's main() does: parse the command line, run, and turn exceptions into one line and an exit code.
#pragma once

#include "exit_code.hpp"
#include <axistokes/core.hpp>
#include <axistokes/io/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <charconv>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <type_traits>

namespace examples {

template <class Number>
CLI::Validator number_check(const std::string& name) {
    const auto parse = [name](const std::string& text) {
        Number parsed{};
        const bool sign = text.size() > 1 && text[0] == '+' && text[1] != '-';
        const auto result = std::from_chars(text.data() + (sign ? 1 : 0), text.data() + text.size(), parsed);
        const bool number = result.ec == std::errc() && result.ptr == text.data() + text.size();
        axistokes::detail::require(number, name.c_str(), text,
                                   std::is_integral_v<Number> ? "a whole number" : "a number within double's range");
        return std::string();
    };
    return CLI::Validator(parse, "");
}

/// An option for a number. Text that is not a number is reported as `--name = text: must be ...`; the range is left to
/// whoever uses the number.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& value, const std::string& description) {
    return app.add_option(name, value, description)->check(number_check<Number>(name))->capture_default_str();
}
/// The same without a default value.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<Number>& value,
                        const std::string& description) {
    return app.add_option(name, value, description)->check(number_check<Number>(name));
}

/// Exit code of the example called `name`, whose `run()` returns one and is called once the options have their values.
template <class Run>
int run_program(const std::string& name, CLI::App& app, int argc, char** argv, const Run& run) {
    const auto complain = [&](const std::exception& error, ExitCode code) {
        std::cerr << name << ": " << error.what() << '\n';
        return code;
    };
    try {
        app.parse(argc, argv);
        return run();
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : complain(error, bad_input);
    } catch (const axistokes::InvalidArgument& error) {
        return complain(error, bad_input);
    } catch (const axistokes::OutputError& error) {
        return complain(error, bad_input);
    } catch (const axistokes::SimulationFailure& error) {
        return complain(error, simulation_failure);
    } catch (const std::exception& error) {
        return complain(error, internal_error);
    }
}

}  // namespace examples
