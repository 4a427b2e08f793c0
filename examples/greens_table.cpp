// SPDX-License-Identifier: MIT
// Tabulates the ring Green function M for the target-source pairs of a CSV file; inside a tube, the wall's correction C
// and the total T = M + C too.
#include "support/program.hpp"
#include <axistokes/io/atomic_file.hpp>
#include <axistokes/kernel/tube.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using axistokes::FreeSpaceKernel;
using axistokes::InvalidArgument;
using axistokes::KernelBlock;
using axistokes::Point;
using axistokes::TubeKernel;

struct Row {
    Point<double> target;
    Point<double> source;
    KernelBlock<double> m;
    KernelBlock<double> correction{};  // in a tube
};
using Tube = std::optional<TubeKernel<double>>;

constexpr std::array<std::string_view, 4> kColumns{"r0", "z0", "r", "z"};

/// A place in the input; every error message starts with it.
struct Place {
    const fs::path& file;
    std::size_t line;

    [[noreturn]] void fail(const std::string& what) const {
        throw InvalidArgument(file.string() + ":" + std::to_string(line) + ": " + what);
    }
};

std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split_line(std::string_view line) {
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

using ColumnIndices = std::array<std::size_t, kColumns.size()>;

ColumnIndices parse_header(const std::vector<std::string_view>& fields, const Place& place) {
    ColumnIndices indices{};
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
        const std::string name(kColumns[c]);
        if (std::count(fields.begin(), fields.end(), kColumns[c]) > 1) {
            place.fail("column '" + name + "' occurs twice");
        }
        const auto found = std::find(fields.begin(), fields.end(), kColumns[c]);
        if (found == fields.end()) {
            place.fail("missing column '" + name + "' (the header must name r0, z0, r and z)");
        }
        indices[c] = static_cast<std::size_t>(found - fields.begin());
    }
    return indices;
}

double parse_number(std::string_view text, std::string_view column, const Place& place) {
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

bool finite(const KernelBlock<double>& m) {
    return std::isfinite(m.rr) && std::isfinite(m.rz) && std::isfinite(m.zr) && std::isfinite(m.zz);
}

KernelBlock<double> sum(const KernelBlock<double>& a, const KernelBlock<double>& b) {
    return {a.rr + b.rr, a.rz + b.rz, a.zr + b.zr, a.zz + b.zz};
}

Row evaluate_row(const std::vector<std::string_view>& fields, const ColumnIndices& indices, const Tube& tube,
                 const Place& place) {
    std::array<double, kColumns.size()> values{};
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
        values[c] = parse_number(fields[indices[c]], kColumns[c], place);
        const bool is_radius = kColumns[c].front() == 'r';
        if (is_radius && values[c] < 0) {
            place.fail(std::string(kColumns[c]) + " = '" + std::string(fields[indices[c]]) + "': must be >= 0");
        }
        if (is_radius && tube && values[c] > tube->tube_radius()) {
            std::ostringstream radius;
            radius << tube->tube_radius();
            place.fail(std::string(kColumns[c]) + " = '" + std::string(fields[indices[c]]) +
                       "': outside the tube of radius " + radius.str());
        }
    }
    const auto [r0, z0, r, z] = values;
    if (r0 == r && z0 == z) {
        place.fail("the target lies on the source, (r, z) = (" + std::string(fields[indices[2]]) + ", " +
                   std::string(fields[indices[3]]) + "), where M is infinite");
    }
    Row row{{r0, z0}, {r, z}, FreeSpaceKernel<double>().singular({r0, z0}, {r, z})};
    if (tube) {
        try {
            row.correction = tube->correction(row.target, row.source);
        } catch (const InvalidArgument& error) {
            place.fail(error.what());
        }
    }
    if (!finite(row.m) || !finite(row.correction)) {
        place.fail("r, z = " + std::string(fields[indices[2]]) + ", " + std::string(fields[indices[3]]) +
                   ": too close to the target, or too far from the origin, for double precision");
    }
    return row;
}

std::vector<Row> read_rows(const fs::path& file, const Tube& tube) {
    std::ifstream input(file);
    if (fs::is_directory(file) || !input) {
        throw InvalidArgument(file.string() + ": cannot be read");
    }
    std::string line;
    if (!std::getline(input, line)) {
        throw InvalidArgument(file.string() + ":1: the header line is missing");
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (line.starts_with(kByteOrderMark)) {
        line.erase(0, kByteOrderMark.size());
    }
    const std::vector<std::string_view> header = split_line(line);
    const std::size_t width = header.size();
    const ColumnIndices indices = parse_header(header, {file, 1});
    std::vector<Row> rows;
    for (std::size_t number = 2; std::getline(input, line); ++number) {
        if (trim(line).empty()) {
            continue;
        }
        const Place place{file, number};
        const std::vector<std::string_view> fields = split_line(line);
        if (fields.size() != width) {
            place.fail(std::to_string(fields.size()) + " fields, but the header has " + std::to_string(width));
        }
        rows.push_back(evaluate_row(fields, indices, tube, place));
    }
    if (input.bad()) {
        throw InvalidArgument(file.string() + ": reading failed");
    }
    return rows;
}

void write_block(std::ostream& out, const KernelBlock<double>& m) {
    out << ',' << m.rr << ',' << m.rz << ',' << m.zr << ',' << m.zz;
}

void write_rows(std::ostream& out, const std::vector<Row>& rows, bool in_tube) {
    out << "r0,z0,r,z,M_rr,M_rz,M_zr,M_zz" << (in_tube ? ",C_rr,C_rz,C_zr,C_zz,T_rr,T_rz,T_zr,T_zz\n" : "\n");
    for (const Row& row : rows) {
        out << row.target.r << ',' << row.target.z << ',' << row.source.r << ',' << row.source.z;
        write_block(out, row.m);
        if (in_tube) {
            write_block(out, row.correction);
            write_block(out, sum(row.m, row.correction));
        }
        out << '\n';
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Tabulates the axisymmetric Green function M_ab(x0, x) of free space, without its factor 1/(8 pi); with\n"
        "--tube-radius also the correction C by a tube's wall and the total T = M + C"};
    std::string input;
    std::string directory;
    std::optional<double> tube_radius;
    TubeKernel<double>::Params params;
    params.tolerance = 1e-12;
    app.add_option("--input", input, "CSV file with a header line and the columns r0, z0 (target), r, z (source)")
        ->required();
    app.add_option("--out", directory, "directory that receives greens.csv; created if missing")->required();
    examples::add_number(app, "--tube-radius", tube_radius, "radius of the tube around the axis");
    examples::add_number(app, "--tolerance", params.tolerance,
                         "error allowed of C, relative to the free-space velocity");
    return examples::run_program("greens_table", app, argc, argv, [&] {
        const Tube tube = tube_radius ? Tube(TubeKernel<double>(*tube_radius, params)) : std::nullopt;
        const std::vector<Row> rows = read_rows(input, tube);
        axistokes::write_atomically(fs::path(directory) / "greens.csv",
                                    [&](std::ostream& out) { write_rows(out, rows, tube.has_value()); });
        return examples::success;
    });
}
