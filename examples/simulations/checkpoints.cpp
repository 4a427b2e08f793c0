// SPDX-License-Identifier: MIT
#include "../support/checkpoints.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>

namespace examples {

namespace {

void require_space(const std::filesystem::path& directory) {
    constexpr std::uintmax_t least = 4 << 20;
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(directory, error);
    if (!error && space.available < least) {
        error = std::make_error_code(std::errc::no_space_on_device);
    }
    if (error) {
        throw axistokes::OutputError(directory, error);
    }
    // What a quota leaves shows only when something is written.
    const std::filesystem::path probe = directory / "run.probe";
    axistokes::write_atomically(probe, [](std::ostream& out) { out << std::string(least / 4, ' '); });
    std::filesystem::remove(probe, error);
}

}  // namespace

std::shared_ptr<Journal> Checkpoints::journal(const std::string& directory) const {
    if (directory.empty()) {
        return nullptr;
    }
    axistokes::create_output_directory(directory);
    require_space(directory);
    const std::filesystem::path path = std::filesystem::path(directory) / file;
    return resumed ? Journal::resume(path, every) : Journal::create(path, command, every);
}

}  // namespace examples
