// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "checkpoints.hpp"
#include "exit_code.hpp"
#include <axistokes/io/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

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

void CommandLine::resumable(std::string& directory, Checkpoints& checkpoints) {
    directory_ = &directory;
    checkpoints_ = &checkpoints;
    app_->add_option("--resume",
                     "go on with the run with --out DIR that was killed or interrupted; takes all other options "
                     "from there")
        ->type_name("DIR");
    number("--checkpoint-every", checkpoints.every,
           "steps after which DIR/run.journal of --out DIR, from which the run can be gone on with, is brought up to "
           "date");
}

/// Replaces the options by those of the run with results in that directory.
void CommandLine::take_up(std::string resumed) {
    using axistokes::detail::require;
    for (const CLI::Option* option : app_->get_options()) {
        const std::string name = option->get_name();
        require(option->count() == 0 || name == "--resume" || name == "--checkpoint-every", name.c_str(), "given",
                "absent with --resume, which takes it from the run");
    }
    const std::filesystem::path path = std::filesystem::path(resumed) / Checkpoints::file;
    if (!std::filesystem::exists(path)) {
        const bool ended = std::filesystem::exists(path.parent_path() / "summary.json");
        require(false, "--resume", resumed,
                ended ? "the directory of a run that has not ended; this one has, with the results that are there"
                      : "the directory of a run that was killed or interrupted; there is no run.journal");
    }
    std::istringstream words(Journal::resume(path)->text());
    std::string program;
    std::getline(words, program, '\0');
    require(program == program_, "--resume", resumed, ("the directory of a run of " + program_).c_str());
    std::vector<std::string> arguments;
    for (std::string word; std::getline(words, word, '\0');) {
        arguments.insert(arguments.begin(), word);  // the parser wants the last one first
    }
    const bool other_interval = given("--checkpoint-every");
    const Index every = checkpoints_->every;
    app_->parse(std::move(arguments));
    if (other_interval) {
        checkpoints_->every = every;
    }
    checkpoints_->resumed = true;
    *directory_ = std::move(resumed);
}

int CommandLine::run(int argc, char** argv, const std::function<int()>& run) {
    const auto complain = [&](const std::exception& error, ExitCode code) {
        std::cerr << program_ << ": " << error.what() << '\n';
        return code;
    };
    try {
        app_->parse(argc, argv);
        if (checkpoints_ && given("--resume")) {
            take_up(app_->get_option("--resume")->as<std::string>());
        } else if (checkpoints_) {
            axistokes::detail::require(!given("--checkpoint-every") || !directory_->empty(), "--checkpoint-every",
                                       checkpoints_->every, "absent without --out");
            checkpoints_->command = program_ + '\0';
            for (int i = 1; i < argc; ++i) {
                checkpoints_->command += std::string(argv[i]) + '\0';
            }
        }
        return run();
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app_->exit(error) : complain(error, bad_input);
    } catch (const axistokes::InvalidArgument& error) {
        return complain(error, bad_input);
    } catch (const axistokes::OutputError& error) {
        return complain(error, bad_input);
    } catch (const axistokes::SimulationFailure& error) {
        return complain(error, simulation_failure);
    } catch (const std::bad_alloc&) {
        return complain(axistokes::SimulationFailure("not enough memory: so many elements or panels are too many"),
                        simulation_failure);
    } catch (const std::exception& error) {
        return complain(error, internal_error);
    }
}

}  // namespace examples
