// SPDX-License-Identifier: MIT
// A program's options and its main(): parse the command line, run, and turn exceptions into one line and an exit code.
// The parser itself (CLI11), which takes long to compile, is seen by one file alone.
#pragma once

#include "exit_code.hpp"
#include <axistokes/core.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace examples {

struct Checkpoints;

/// An option that a program has; empty text and absent numbers show no default.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    bool given() const;
    Option& required();
    /// In the help.
    Option& without_default();
    Option& excludes(const Option& other);
    Option& excludes(const std::string& other);
    Option& needs(const std::string& other);

  private:
    CLI::Option* option_;
};

class CommandLine {
  public:
    using Index = axistokes::Index;

    CommandLine(std::string program, const std::string& description);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine();

    /// Text that is not a number is reported as `--name = text: must be ...`; the range is left to whoever uses it.
    Option number(const std::string& name, double& value, const std::string& description);
    Option number(const std::string& name, std::optional<double>& value, const std::string& description);
    Option number(const std::string& name, Index& value, const std::string& description);
    Option number(const std::string& name, std::optional<Index>& value, const std::string& description);
    /// Separated by commas.
    Option numbers(const std::string& name, std::vector<double>& values, const std::string& description);
    Option text(const std::string& name, std::string& value, const std::string& description);
    Option text(const std::string& name, std::optional<std::string>& value, const std::string& description);
    /// `read` gets the text at once, and throws InvalidArgument if it is none of those it knows.
    Option text(const std::string& name, std::string& value, const std::string& description,
                const std::function<void(const std::string&)>& read);
    Option flag(const std::string& name, bool& value, const std::string& description);

    bool given(const std::string& name) const;

    /// Adds --resume DIR, with which the program takes all other options from the journal of a run whose results go to
    /// DIR, and --checkpoint-every. `directory` is the value of the option --out.
    void resumable(std::string& directory, Checkpoints& checkpoints);

    /// The program's exit code; `run` returns one and is called once the options have their values.
    int run(int argc, char** argv, const std::function<int()>& run);

  private:
    void take_up(std::string resumed);

    std::string program_;
    std::unique_ptr<CLI::App> app_;
    std::string* directory_ = nullptr;  // of a resumable program, as is the next one
    Checkpoints* checkpoints_ = nullptr;
};

}  // namespace examples
