// SPDX-License-Identifier: MIT
// Fuzz target: the tables that examples read, with any content.
#include "../../examples/support/cases.hpp"
#include "../../examples/support/csv_input.hpp"
#include "bytes.hpp"

#include <filesystem>
#include <fstream>

namespace {

using axistokes::fuzz::attempt;
using axistokes::fuzz::require_finite;

/// A directory of the process, in memory if there is one.
std::filesystem::path directory() {
    std::string name =
        (std::filesystem::exists("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path().string());
    name += "/axistokes_fuzz_XXXXXX";
    static const std::filesystem::path made = mkdtemp(name.data());
    static const struct Removal {
        ~Removal() { std::filesystem::remove_all(made); }
    } removal;
    return made;
}

void require(bool holds, const char* what) {
    if (!holds) {
        std::cerr << what << '\n';
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path path = directory() / "input.csv";
    const auto write = [&](const std::string& before) {
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file << before;
        file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    };
    write("");
    attempt([&] {
        constexpr std::array<std::string_view, 4> names{"r0", "z0", "r", "z"};
        examples::read_columns(path, names, [&](const auto& values, const auto&, const examples::Place&) {
            for (const double value : values) {
                require_finite("a value that was read", value);
            }
        });
    });
    for (const char* header : {"", "confinement,reduced_volume,capillary_number\n"}) {
        write(header);
        attempt([&] {
            for (const examples::Case& c : examples::read_cases(path)) {
                examples::check(c);
            }
        });
    }
    const std::string header = "confinement,reduced_volume,capillary_number,states";
    for (const std::string& before : {std::string(), header + '\n'}) {
        write(before);
        attempt([&] {
            // What has been taken over is taken over again.
            const examples::CaseTable table(path, header);
            const auto length = std::filesystem::file_size(path);
            const examples::CaseTable again(path, header);
            require(std::filesystem::file_size(path) == length, "a table lost rows that it kept before");
        });
    }
    return 0;
}
