// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "exit_code.hpp"
#include <axistokes/io/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <exception>
#include <iostream>
#include <type_traits>
#include <utility>

namespace examples {

namespace {

/// Throws InvalidArgument unless all of the text is a number.
template <class Number>
Number parsed(const std::string& name, const std::string& text) {
    Number number{};
    const bool sign = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const auto result = std::from_chars(text.data() + (sign ? 1 : 0), text.data() + text.size(), number);
    axistokes::detail::require(result.ec == std::errc() && result.ptr == text.data() + text.size(), name.c_str(), text,
                               std::is_integral_v<Number> ? "a whole number" : "a number within double's range");
    return number;
}

template <class Number>
CLI::Validator number_check(const std::string& name) {
    const auto parse = [name](const std::string& text) {
        parsed<Number>(name, text);
        return std::string();
    };
    return CLI::Validator(parse, "");
}

}  // namespace

bool Option::given() const {
    return option_->count() > 0;
}

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::without_default() {
    option_->default_str("");
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option& Option::excludes(const std::string& other) {
    option_->excludes(other);
    return *this;
}

Option& Option::needs(const std::string& other) {
    option_->needs(other);
    return *this;
}

CommandLine::CommandLine(std::string program, const std::string& description)
    : program_(std::move(program)), app_(std::make_unique<CLI::App>(description)) {}

CommandLine::~CommandLine() = default;

Option CommandLine::number(const std::string& name, double& value, const std::string& description) {
    return Option(app_->add_option(name, value, description)->check(number_check<double>(name))->capture_default_str());
}

Option CommandLine::number(const std::string& name, std::optional<double>& value, const std::string& description) {
    return Option(app_->add_option(name, value, description)->check(number_check<double>(name)));
}

Option CommandLine::number(const std::string& name, Index& value, const std::string& description) {
    return Option(app_->add_option(name, value, description)->check(number_check<Index>(name))->capture_default_str());
}

Option CommandLine::number(const std::string& name, std::optional<Index>& value, const std::string& description) {
    return Option(app_->add_option(name, value, description)->check(number_check<Index>(name)));
}

Option CommandLine::numbers(const std::string& name, std::vector<double>& values, const std::string& description) {
    // The parser's own lists leave out what is empty.
    const auto read = [name, &values](const std::string& text) {
        values.clear();
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = std::min(text.find(',', begin), text.size());
            values.push_back(parsed<double>(name, text.substr(begin, end - begin)));
            begin = end + 1;
        }
    };
    return Option(app_->add_option_function<std::string>(name, read, description));
}

Option CommandLine::text(const std::string& name, std::string& value, const std::string& description) {
    CLI::Option* option = app_->add_option(name, value, description);
    return Option(value.empty() ? option : option->capture_default_str());
}

Option CommandLine::text(const std::string& name, std::optional<std::string>& value, const std::string& description) {
    return Option(app_->add_option(name, value, description));
}

Option CommandLine::text(const std::string& name, std::string& value, const std::string& description,
                         const std::function<void(const std::string&)>& read) {
    const auto check = [read](const std::string& text) {
        read(text);
        return std::string();
    };
    return Option(app_->add_option(name, value, description)->check(CLI::Validator(check, "")));
}

Option CommandLine::flag(const std::string& name, bool& value, const std::string& description) {
    return Option(app_->add_flag(name, value, description));
}

bool CommandLine::given(const std::string& name) const {
    return app_->count(name) > 0;
}

int CommandLine::run(int argc, char** argv, const std::function<int()>& run) {
    const auto complain = [&](const std::exception& error, ExitCode code) {
        std::cerr << program_ << ": " << error.what() << '\n';
        return code;
    };
    try {
        app_->parse(argc, argv);
        return run();
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app_->exit(error) : complain(error, bad_input);
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
