// SPDX-License-Identifier: MIT
// A progress bar on a terminal, and a clean stop on Ctrl-C and its like.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>

namespace examples {

/// Fills from 0 to 1 and never goes back. Silent unless standard error is a terminal.
class ProgressBar {
  public:
    ProgressBar() : visible_(isatty(fileno(stderr)) != 0) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { hide(); }

    void hide() {
        if (drawn_) {
            std::cerr << "\r\033[K" << std::flush;
            drawn_ = false;
        }
    }

    void show(double fraction, const std::string& text) {
        fraction_ = std::clamp(fraction, fraction_, 1.0);
        const auto now = Clock::now();
        if (!visible_ || (drawn_ && now - last_ < std::chrono::milliseconds(50))) {
            return;
        }
        last_ = now;
        drawn_ = true;
        constexpr int kWidth = 32;
        const int full = static_cast<int>(std::lround(fraction_ * kWidth));
        std::cerr << "\r\033[K[" << std::string(static_cast<std::size_t>(full), '#')
                  << std::string(static_cast<std::size_t>(kWidth - full), '.') << "] " << text << std::flush;
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool visible_;
    bool drawn_ = false;
    double fraction_ = 0;
    Clock::time_point last_;
};

/// How far the residual has come, in its logarithm, from its largest value to the tolerance.
class Approach {
  public:
    explicit Approach(double tolerance) : tolerance_(tolerance) {}

    double fraction(double residual) {
        largest_ = std::max(largest_, residual);
        if (!(residual > tolerance_)) {
            return 1;
        }
        return std::log(largest_ / residual) / std::log(largest_ / tolerance_);
    }

  private:
    double tolerance_;
    double largest_ = 0;
};

/// While it lives, Ctrl-C (SIGINT), SIGTERM and SIGHUP only set a flag; a second Ctrl-C ends the program as usual.
/// What the program was started to ignore (nohup) it ignores.
class InterruptGuard {
  public:
    InterruptGuard() {
        flag() = 0;
        for (std::size_t i = 0; i < signals.size(); ++i) {
            previous_[i] = std::signal(signals[i], [](int) {
                flag() = 1;
                std::signal(SIGINT, SIG_DFL);
            });
            if (previous_[i] == SIG_IGN) {
                std::signal(signals[i], SIG_IGN);
            }
        }
    }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    ~InterruptGuard() {
        for (std::size_t i = 0; i < signals.size(); ++i) {
            std::signal(signals[i], previous_[i]);
        }
    }

    static bool interrupted() { return flag() != 0; }

  private:
    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

    static volatile std::sig_atomic_t& flag() {
        static volatile std::sig_atomic_t value = 0;
        return value;
    }
    std::array<void (*)(int), signals.size()> previous_{};
};

}  // namespace examples
