// SPDX-License-Identifier: MIT
// The Green function of a tube, or of free space, chosen at run time.
#pragma once

#include <axistokes/kernel/tube.hpp>
#include <axistokes/kernel/tube_filon.hpp>

#include <limits>
#include <utility>
#include <variant>

namespace examples {

/// The images of a tube, by either evaluation, or none: a tube of infinite radius.
class OptionalTubeImages {
  public:
    using Scalar = double;
    using Tube = axistokes::TubeImages<double>;
    using FilonTube = axistokes::TubeFilonImages<double>;

    OptionalTubeImages() = default;
    explicit OptionalTubeImages(Tube tube) : tube_(std::move(tube)) {}
    explicit OptionalTubeImages(FilonTube tube) : tube_(std::move(tube)) {}

    /// The same with the error `tolerance`, or the present one if that is larger.
    OptionalTubeImages loosened(double tolerance) const {
        const auto* tube = std::get_if<Tube>(&tube_);
        return tube ? OptionalTubeImages(tube->loosened(tolerance)) : *this;
    }

    double gap(const axistokes::Point<double>& x) const {
        return visit([&](const auto& tube) { return tube.gap(x); }, std::numeric_limits<double>::infinity());
    }

    axistokes::KernelBlock<double> correction(const axistokes::Point<double>& target,
                                              const axistokes::Point<double>& source) const {
        return visit([&](const auto& tube) { return tube.correction(target, source); },
                     axistokes::KernelBlock<double>{});
    }

    template <class Quadrature>
    void regular(const axistokes::Meridian<double>& targets, const Quadrature& quadrature,
                 axistokes::Matrix<double>& out) const {
        if (const auto* tube = std::get_if<Tube>(&tube_)) {
            tube->regular(targets, quadrature, out);
        } else {
            axistokes::detail::regular_by_pairs<double>(*this, targets, quadrature(0.0), out);
        }
    }

    axistokes::Point<double> unit_flow(const axistokes::Point<double>& x) const {
        return visit([&](const auto& tube) { return tube.unit_flow(x); }, axistokes::Point<double>{});
    }

  private:
    template <class Function, class Result>
    Result visit(const Function& function, const Result& in_free_space) const {
        if (const auto* tube = std::get_if<Tube>(&tube_)) {
            return function(*tube);
        }
        if (const auto* tube = std::get_if<FilonTube>(&tube_)) {
            return function(*tube);
        }
        return in_free_space;
    }

    std::variant<std::monostate, Tube, FilonTube> tube_;
};

using OptionalTubeKernel = axistokes::ImagedKernel<double, OptionalTubeImages>;

}  // namespace examples
