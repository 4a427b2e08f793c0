// SPDX-License-Identifier: MIT
// Tables of cases: read from a file or made as a grid, and the rows already computed.
#pragma once

#include "command_line.hpp"
#include "csv_input.hpp"
#include <axistokes/core.hpp>
#include <axistokes/io/atomic_file.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace examples {

/// A vesicle in a tube.
struct Case {
    double confinement = 0;
    double reduced_volume = 0;
    double capillary_number = 0;
};

/// The first three columns of its rows, and what they are known by.
inline std::string key(const Case& c) {
    std::ostringstream out;
    out.precision(12);
    out << c.confinement << ',' << c.reduced_volume << ',' << c.capillary_number;
    return out.str();
}

/// A field of a CSV file that may contain commas.
inline std::string quoted(std::string text) {
    std::replace(text.begin(), text.end(), '"', '\'');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? text : '"' + text + '"';
}

inline void check(const Case& c) {
    using axistokes::detail::require;
    require(c.confinement > 0 && c.confinement < 3, "confinement", c.confinement, "in (0, 3)");
    require(c.reduced_volume > 0.2 && c.reduced_volume < 1, "reduced volume", c.reduced_volume, "in (0.2, 1)");
    require(std::isfinite(c.capillary_number), "capillary number", c.capillary_number, "finite");
}

/// lo:hi:n, or a single value.
class Range {
  public:
    Range(double lowest, double highest, long number) : low_(lowest), high_(highest), count_(number) {}

    Option add_to(CommandLine& app, const std::string& name, const std::string& description) {
        const auto parse = [this, name](const std::string& text) {
            const auto number = [&](std::string_view part, auto& value) {
                const auto result = std::from_chars(part.data(), part.data() + part.size(), value);
                axistokes::detail::require(result.ec == std::errc() && result.ptr == part.data() + part.size(),
                                           name.c_str(), text, "a number, or lowest:highest:count");
            };
            const auto first = text.find(':');
            const auto second = first == std::string::npos ? first : text.find(':', first + 1);
            number(std::string_view(text).substr(0, first), low_);
            high_ = low_;
            count_ = 1;
            if (first != std::string::npos) {
                axistokes::detail::require(second != std::string::npos, name.c_str(), text,
                                           "a number, or lowest:highest:count");
                number(std::string_view(text).substr(first + 1, second - first - 1), high_);
                number(std::string_view(text).substr(second + 1), count_);
            }
            axistokes::detail::require(count_ >= 1 && count_ <= 10000 && high_ >= low_, name.c_str(), text,
                                       "lowest <= highest and a count in [1, 10000]");
        };
        text_ = std::to_string(low_) + ':' + std::to_string(high_) + ':' + std::to_string(count_);
        return app.text(name, text_, description + ": lowest:highest:count, or one value", parse);
    }

    std::vector<double> values() const {
        std::vector<double> values;
        for (long i = 0; i < count_; ++i) {
            const double value =
                count_ == 1 ? low_ : low_ + (high_ - low_) * static_cast<double>(i) / static_cast<double>(count_ - 1);
            values.push_back(std::round(value * 1e9) / 1e9);
        }
        return values;
    }

  private:
    double low_;
    double high_;
    long count_;
    std::string text_;
};

inline std::vector<Case> grid(const std::vector<double>& confinements, const std::vector<double>& reduced_volumes,
                              double capillary_number) {
    std::vector<Case> cases;
    for (const double v : reduced_volumes) {
        for (const double l : confinements) {
            cases.push_back({l, v, capillary_number});
            check(cases.back());
        }
    }
    return cases;
}

/// Throws InvalidArgument with file and line.
inline std::vector<Case> read_cases(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 3> names{"confinement", "reduced_volume", "capillary_number"};
    std::vector<Case> cases;
    read_columns(file, names, [&](const auto& values, const auto&, const Place& place) {
        cases.push_back({values[0], values[1], values[2]});
        try {
            check(cases.back());
        } catch (const axistokes::InvalidArgument& error) {
            place.fail(error.what());
        }
    });
    return cases;
}

/// On the disk when this returns. Throws OutputError.
inline void append(const std::filesystem::path& path, const std::string& lines) {
    std::ofstream out(path, std::ios::app);
    out << lines << std::flush;
    if (!out) {
        throw axistokes::OutputError(path, std::make_error_code(std::errc::io_error));
    }
}

/// A CSV file that grows by whole cases. What an interrupted run left of its last case is dropped.
class CaseTable {
  public:
    CaseTable(std::filesystem::path path, const std::string& header) : path_(std::move(path)) {
        if (path_.has_parent_path()) {
            std::filesystem::create_directories(path_.parent_path());
        }
        std::map<std::string, std::vector<std::string>> rows;
        std::vector<std::string> order;
        if (std::ifstream input(path_); input) {
            std::string line;
            std::getline(input, line);
            if (line != header) {
                throw axistokes::InvalidArgument(path_.string() + ": exists and has other columns");
            }
            while (std::getline(input, line)) {
                if (input.eof()) {
                    break;  // without its end
                }
                const std::string known = line.substr(0, third_comma(line));
                if (rows[known].empty()) {
                    order.push_back(known);
                }
                rows[known].push_back(line);
            }
        }
        std::ostringstream kept;
        kept << header << '\n';
        for (const std::string& known : order) {
            const auto& lines = rows[known];
            const std::size_t states = std::max<std::size_t>(1, states_of(lines.front()));
            if (lines.size() == states) {
                done_.push_back(known);
                for (const std::string& line : lines) {
                    kept << line << '\n';
                }
            }
        }
        axistokes::write_atomically(path_, [&](std::ostream& out) { out << kept.str(); });
    }

    bool has(const Case& c) const { return std::find(done_.begin(), done_.end(), key(c)) != done_.end(); }

    /// Whole lines; on the disk when this returns.
    void append(const std::string& lines) { examples::append(path_, lines); }

  private:
    static std::size_t third_comma(const std::string& line) {
        std::size_t at = 0;
        for (int k = 0; k < 3 && at != std::string::npos; ++k) {
            at = line.find(',', k == 0 ? 0 : at + 1);
        }
        return at;
    }
    /// The fourth column.
    static std::size_t states_of(const std::string& line) {
        const std::size_t comma = third_comma(line);
        std::size_t states = 0;
        if (comma != std::string::npos) {
            std::from_chars(line.data() + comma + 1, line.data() + line.size(), states);
        }
        return states;
    }

    std::filesystem::path path_;
    std::vector<std::string> done_;
};

}  // namespace examples
