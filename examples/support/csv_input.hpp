// SPDX-License-Identifier: MIT
// Reads columns of numbers from a CSV file; errors name file and line.
#pragma once

#include <axistokes/core.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace examples {

/// A place in the input; every error message starts with it.
struct Place {
    const std::filesystem::path& file;
    std::size_t line;

    [[noreturn]] void fail(const std::string& what) const {
        throw axistokes::InvalidArgument(file.string() + ":" + std::to_string(line) + ": " + what);
    }
};

inline std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

inline std::vector<std::string_view> split_line(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const auto comma = line.find(',');
        fields.push_back(trim(line.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return fields;
        }
        line.remove_prefix(comma + 1);
    }
}

inline double parse_number(std::string_view text, std::string_view column, const Place& place) {
    const std::string shown = std::string(column) + " = '" + std::string(text) + "'";
    // from_chars takes no leading plus sign, which spreadsheets may write.
    const std::string_view digits = text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
    double value = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (result.ec == std::errc::result_out_of_range) {
        place.fail(shown + ": outside the range of double");
    }
    if (result.ec != std::errc() || result.ptr != digits.data() + digits.size()) {
        place.fail(shown + ": not a number");
    }
    if (!std::isfinite(value)) {
        place.fail(shown + ": must be finite");
    }
    return value;
}

template <std::size_t N>
std::array<std::size_t, N> find_columns(const std::vector<std::string_view>& header,
                                        const std::array<std::string_view, N>& names, const Place& place) {
    std::array<std::size_t, N> columns{};
    for (std::size_t c = 0; c < N; ++c) {
        const std::string name(names[c]);
        if (std::count(header.begin(), header.end(), names[c]) > 1) {
            place.fail("column '" + name + "' occurs twice");
        }
        const auto found = std::find(header.begin(), header.end(), names[c]);
        if (found == header.end()) {
            std::string all(names[0]);
            for (std::size_t k = 1; k < N; ++k) {
                all.append(k + 1 < N ? ", " : " and ").append(names[k]);
            }
            place.fail("missing column '" + name + "' (the header must name " + all + ")");
        }
        columns[c] = static_cast<std::size_t>(found - header.begin());
    }
    return columns;
}

/// Calls row(values, texts, place) for each line after the header that is not blank, with the columns of these names.
/// Throws InvalidArgument with file and line.
template <std::size_t N, class Row>
void read_columns(const std::filesystem::path& file, const std::array<std::string_view, N>& names, const Row& row) {
    std::ifstream input(file);
    if (std::filesystem::is_directory(file) || !input) {
        throw axistokes::InvalidArgument(file.string() + ": cannot be read");
    }
    std::string line;
    if (!std::getline(input, line)) {
        throw axistokes::InvalidArgument(file.string() + ":1: the header line is missing");
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (line.starts_with(kByteOrderMark)) {
        line.erase(0, kByteOrderMark.size());
    }
    const std::vector<std::string_view> header = split_line(line);
    const std::size_t width = header.size();
    const std::array<std::size_t, N> columns = find_columns(header, names, {file, 1});
    for (std::size_t number = 2; std::getline(input, line); ++number) {
        if (trim(line).empty()) {
            continue;
        }
        const Place place{file, number};
        const std::vector<std::string_view> fields = split_line(line);
        if (fields.size() != width) {
            place.fail(std::to_string(fields.size()) + " fields, but the header has " + std::to_string(width));
        }
        std::array<double, N> values{};
        std::array<std::string_view, N> texts{};
        for (std::size_t c = 0; c < N; ++c) {
            texts[c] = fields[columns[c]];
            values[c] = parse_number(texts[c], names[c], place);
        }
        row(values, texts, place);
    }
    if (input.bad()) {
        throw axistokes::InvalidArgument(file.string() + ": reading failed");
    }
}

}  // namespace examples
