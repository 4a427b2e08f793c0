// SPDX-License-Identifier: MIT
// What fuzz targets share: values out of a fuzzer's bytes, and the property that they test.
#pragma once

#include <axistokes/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <string>

namespace axistokes::fuzz {

/// Values read from the front of the bytes; zeros where there are none left.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::size_t left() const { return size_; }

    std::uint8_t byte() {
        if (size_ == 0) {
            return 0;
        }
        --size_;
        return *data_++;
    }

    bool flag() { return byte() % 2 == 1; }

    /// One of 0 ... count - 1.
    int choice(int count) { return byte() % count; }

    /// Between low and high, one of at most 256 values.
    double between(double low, double high) { return low + (high - low) * byte() / 255; }

    /// Any double: of ordinary size, far from it, one of those that are easily forgotten, or 8 bytes.
    double number() {
        static constexpr std::array<double, 16> special{0.0,
                                                        -0.0,
                                                        1.0,
                                                        -1.0,
                                                        std::numeric_limits<double>::infinity(),
                                                        -std::numeric_limits<double>::infinity(),
                                                        std::numeric_limits<double>::quiet_NaN(),
                                                        std::numeric_limits<double>::max(),
                                                        std::numeric_limits<double>::min(),
                                                        std::numeric_limits<double>::denorm_min(),
                                                        std::numeric_limits<double>::epsilon(),
                                                        1e-154,
                                                        1e154,
                                                        100.0,
                                                        1e-8,
                                                        0.999999999999};
        switch (choice(5)) {
            case 0:
                return special[byte() % special.size()];
            case 1:
                return between(-3, 3);
            case 2:
                return std::pow(10.0, between(-4, 4));
            case 3:
                return std::pow(10.0, between(-308, 308));
            default:
                break;
        }
        std::array<std::uint8_t, sizeof(double)> raw{};
        for (auto& b : raw) {
            b = byte();
        }
        double value = 0;
        std::memcpy(&value, raw.data(), sizeof value);
        return value;
    }

    /// Mostly a small number, sometimes one that does not fit into memory.
    Index count(int ordinary) {
        switch (choice(8)) {
            case 0:
                return std::numeric_limits<Index>::max();
            case 1:
                return -1;
            default:
                return choice(ordinary);
        }
    }

  private:
    const std::uint8_t* data_;
    std::size_t size_;
};

/// Ends the program unless the value is finite.
inline void require_finite(const char* what, double value) {
    if (!std::isfinite(value)) {
        std::cerr << what << " is " << value << '\n';
        std::abort();
    }
}

/// Calls `action`, which may refuse its input or fail with a cause; whatever else it throws ends the program.
template <class Action>
void attempt(const Action& action) {
    const auto named = [](const std::exception& error) {
        if (std::string(error.what()).empty()) {
            std::abort();
        }
    };
    try {
        action();
    } catch (const InvalidArgument& error) {
        named(error);
    } catch (const SimulationFailure& error) {
        named(error);
    }
}

}  // namespace axistokes::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
