// SPDX-License-Identifier: MIT
// A table that a study prints as it goes, and writes to a CSV file if a directory was given.
#pragma once

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>

namespace examples {

class Report {
  public:
    Report(const std::string& directory, const std::string& name, const std::string& header) {
        std::cout << '\n' << header << '\n';
        if (!directory.empty()) {
            std::filesystem::create_directories(directory);
            path_ = std::filesystem::path(directory) / name;
            file_.open(path_);
            file_ << std::setprecision(17) << header << '\n';
        }
    }
    template <class... Values>
    void row(const Values&... values) {
        write(std::cout, values...);
        if (file_.is_open()) {
            write(file_, values...);
            if (!file_) {
                throw std::runtime_error(path_.string() + ": cannot be written");
            }
        }
    }

  private:
    template <class First, class... Rest>
    static void write(std::ostream& out, const First& first, const Rest&... rest) {
        out << first;
        ((out << ',' << rest), ...);
        out << std::endl;
    }
    std::filesystem::path path_;
    std::ofstream file_;
};

}  // namespace examples
