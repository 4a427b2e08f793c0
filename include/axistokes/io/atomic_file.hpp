// SPDX-License-Identifier: MIT
// Output files that are either complete or absent.
#pragma once

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>

namespace axistokes {

/// A file or directory that cannot be written; the message names it and gives the cause.
class OutputError : public std::runtime_error {
  public:
    OutputError(const std::filesystem::path& path, const std::error_code& cause)
        : std::runtime_error(path.string() + ": cannot be written: " + cause.message()) {}
};

/// Creates the directory and its parents; throws OutputError if that fails.
inline void create_output_directory(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (!error && !std::filesystem::is_directory(directory, error) && !error) {
        error = std::make_error_code(std::errc::not_a_directory);
    }
    if (error) {
        throw OutputError(directory, error);
    }
}

/// Calls write(stream), with 17 digits set, on a temporary file beside `path` and renames it: a reader never sees half
/// a file, and an existing one survives a failure. Missing directories are created. Throws OutputError.
template <class Write>
void write_atomically(const std::filesystem::path& path, const Write& write) {
    namespace fs = std::filesystem;
    if (path.has_parent_path()) {
        create_output_directory(path.parent_path());
    }
    fs::path temporary = path;
    temporary += ".tmp";
    std::error_code ignored;
    const auto fail = [&](std::error_code cause) {
        fs::remove(temporary, ignored);
        throw OutputError(path, cause ? cause : std::make_error_code(std::errc::io_error));
    };
    errno = 0;
    std::ofstream out(temporary);
    if (out) {
        out.precision(std::numeric_limits<double>::max_digits10);
        try {
            write(out);
        } catch (...) {
            out.close();
            fs::remove(temporary, ignored);
            throw;
        }
        out.close();
    }
    if (!out) {
        fail({errno, std::generic_category()});
    }
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) {
        fail(error);
    }
}

}  // namespace axistokes
