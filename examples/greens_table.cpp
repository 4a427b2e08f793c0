// SPDX-License-Identifier: MIT
// Tabulates the ring Green function M for the target-source pairs of a CSV file; inside a tube, the wall's correction C
// and the total T = M + C too.
#include "support/command_line.hpp"
#include "support/csv_input.hpp"
#include <axistokes/io/atomic_file.hpp>
#include <axistokes/kernel/tube.hpp>

#include <array>
#include <cmath>
#include <filesystem>
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

bool finite(const KernelBlock<double>& m) {
    return std::isfinite(m.rr) && std::isfinite(m.rz) && std::isfinite(m.zr) && std::isfinite(m.zz);
}

KernelBlock<double> sum(const KernelBlock<double>& a, const KernelBlock<double>& b) {
    return {a.rr + b.rr, a.rz + b.rz, a.zr + b.zr, a.zz + b.zz};
}

using Values = std::array<double, kColumns.size()>;
using Texts = std::array<std::string_view, kColumns.size()>;

Row evaluate_row(const Values& values, const Texts& texts, const Tube& tube, const examples::Place& place) {
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
        const std::string shown = std::string(kColumns[c]) + " = '" + std::string(texts[c]) + "'";
        const bool is_radius = kColumns[c].front() == 'r';
        if (is_radius && values[c] < 0) {
            place.fail(shown + ": must be >= 0");
        }
        if (is_radius && tube && values[c] > tube->tube_radius()) {
            std::ostringstream radius;
            radius << tube->tube_radius();
            place.fail(shown + ": outside the tube of radius " + radius.str());
        }
    }
    const auto [r0, z0, r, z] = values;
    if (r0 == r && z0 == z) {
        place.fail("the target lies on the source, (r, z) = (" + std::string(texts[2]) + ", " + std::string(texts[3]) +
                   "), where M is infinite");
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
        place.fail("r, z = " + std::string(texts[2]) + ", " + std::string(texts[3]) +
                   ": too close to the target, or too far from the origin, for double precision");
    }
    return row;
}

std::vector<Row> read_rows(const fs::path& file, const Tube& tube) {
    std::vector<Row> rows;
    examples::read_columns(file, kColumns, [&](const Values& values, const Texts& texts, const examples::Place& place) {
        rows.push_back(evaluate_row(values, texts, tube, place));
    });
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
    examples::CommandLine app{
        "greens_table",
        "Tabulates the axisymmetric Green function M_ab(x0, x) of free space, without its factor 1/(8 pi); with\n"
        "--tube-radius also the correction C by a tube's wall and the total T = M + C"};
    std::string input;
    std::string directory;
    std::optional<double> tube_radius;
    TubeKernel<double>::Params params;
    params.tolerance = 1e-12;
    app.text("--input", input, "CSV file with a header line and the columns r0, z0 (target), r, z (source)").required();
    app.text("--out", directory, "directory that receives greens.csv; created if missing").required();
    app.number("--tube-radius", tube_radius, "radius of the tube around the axis");
    app.number("--tolerance", params.tolerance, "error allowed of C, relative to the free-space velocity");
    return app.run(argc, argv, [&] {
        const Tube tube = tube_radius ? Tube(TubeKernel<double>(*tube_radius, params)) : std::nullopt;
        const std::vector<Row> rows = read_rows(input, tube);
        axistokes::write_atomically(fs::path(directory) / "greens.csv",
                                    [&](std::ostream& out) { write_rows(out, rows, tube.has_value()); });
        return examples::success;
    });
}
