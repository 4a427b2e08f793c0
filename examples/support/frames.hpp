// SPDX-License-Identifier: MIT
// Shapes kept on the way, in the laboratory frame.
#pragma once

#include "simulation.hpp"
#include <axistokes/io/csv.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace examples {

class Frames {
  public:
    bool empty() const { return frame_.empty(); }

    void add(double at, const axistokes::Meridian<double>& shape) {
        const double next = frame_.empty() ? 0 : frame_.back() + 1;
        for (axistokes::Index i = 0; i < shape.nodes(); ++i) {
            frame_.push_back(next);
            time_.push_back(at);
            r_.push_back(shape.r[i]);
            z_.push_back(shape.z[i]);
        }
    }

    /// One row a node.
    std::vector<axistokes::Column<double>> columns() const {
        const auto vector = [](const std::vector<double>& v) {
            using axistokes::Vector;
            return Vector<double>(Eigen::Map<const Vector<double>>(v.data(), static_cast<axistokes::Index>(v.size())));
        };
        return {{"frame", vector(frame_)}, {"time", vector(time_)}, {"r", vector(r_)}, {"z", vector(z_)}};
    }

  private:
    std::vector<double> frame_, time_, r_, z_;
};

/// A curve to draw: the nodes, or, of a series that has few of them, more points between them.
inline axistokes::Meridian<double> drawn_curve(const AnyDiscretization& discretization,
                                               const axistokes::Meridian<double>& shape) {
    return discretization.judges_itself() ? discretization.redistributed(shape, 4 * shape.elements()) : shape;
}

/// Keeps the first shape at or after each of the given times.
class FramesAt {
  public:
    explicit FramesAt(std::vector<double> times) : times_(std::move(times)) { std::sort(times_.begin(), times_.end()); }

    void visit(double time, const Simulation& simulation) {
        if (next_ == times_.size() || time < times_[next_]) {
            return;
        }
        frames_.add(time, drawn_curve(simulation.scene().discretization(), simulation.shape()));
        while (next_ < times_.size() && times_[next_] <= time) {
            ++next_;
        }
    }
    const Frames& frames() const { return frames_; }

  private:
    std::vector<double> times_;
    std::size_t next_ = 0;
    Frames frames_;
};

}  // namespace examples
