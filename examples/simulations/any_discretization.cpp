// SPDX-License-Identifier: MIT
#include "../support/any_discretization.hpp"

#include "../support/layers.hpp"
#include <axistokes/accuracy/resolution.hpp>

#include <limits>
#include <type_traits>

namespace examples {

namespace {

template <class Discretization>
AnyDiscretization made(std::optional<double> tolerance) {
    typename Discretization::Params params;
    params.tolerance = tolerance.value_or(params.tolerance);
    return AnyDiscretization(Discretization(params));
}

}  // namespace

AnyDiscretization AnyDiscretization::of(DiscretizationKind kind, std::optional<double> tolerance) {
    return kind == DiscretizationKind::linear     ? made<Linear>(tolerance)
           : kind == DiscretizationKind::spectral ? made<Spectral>(tolerance)
                                                  : made<Adaptive>(tolerance);
}

double AnyDiscretization::unresolved(const Shape& shape) const {
    return std::visit(
        [&](const auto& d) {
            if constexpr (axistokes::JudgesItself<std::decay_t<decltype(d)>>) {
                return d.unresolved(shape);
            }
            return 0.0;
        },
        choice_);
}

axistokes::Index AnyDiscretization::finer(axistokes::Index elements, double now, double wanted) const {
    const auto most = std::numeric_limits<axistokes::Index>::max();
    return std::visit([&](const auto& d) { return axistokes::more_elements_of(d, elements, now, wanted, most); },
                      choice_);
}

axistokes::Index AnyDiscretization::most_elements() const {
    return std::visit([](const auto& d) { return axistokes::most_elements(d); }, choice_);
}

AnyDiscretization AnyDiscretization::loosened(double tolerance) const {
    return std::visit([&](const auto& d) { return AnyDiscretization(d.loosened(tolerance)); }, choice_);
}

AnySurface AnyDiscretization::surface(const Shape& shape, axistokes::SurfaceParts parts) const {
    return std::visit([&](const auto& d) { return AnySurface(d.surface(shape, parts)); }, choice_);
}

axistokes::Matrix<double> AnyDiscretization::single_layer(const Shape& shape, const OptionalTubeKernel& kernel) const {
    return std::visit([&](const auto& d) { return Layers<std::decay_t<decltype(d)>>{d}.on(shape, kernel); }, choice_);
}

axistokes::Matrix<double> AnyDiscretization::single_layer(const Shape& shape, const Free& kernel) const {
    return std::visit([&](const auto& d) { return Layers<std::decay_t<decltype(d)>>{d}.on(shape, kernel); }, choice_);
}

axistokes::Matrix<double> AnyDiscretization::single_layer_at(const Shape& targets, const Shape& shape,
                                                             const OptionalTubeKernel& kernel) const {
    return std::visit([&](const auto& d) { return Layers<std::decay_t<decltype(d)>>{d}.at(targets, shape, kernel); },
                      choice_);
}

axistokes::Matrix<double> AnyDiscretization::single_layer_at(const Shape& targets, const Shape& shape,
                                                             const Free& kernel) const {
    return std::visit([&](const auto& d) { return Layers<std::decay_t<decltype(d)>>{d}.at(targets, shape, kernel); },
                      choice_);
}

axistokes::Measures<double> AnyDiscretization::measures(const Shape& shape) const {
    return std::visit([&](const auto& d) { return d.measures(shape); }, choice_);
}

double AnyDiscretization::max_radius(const Shape& shape) const {
    return std::visit([&](const auto& d) { return d.max_radius(shape); }, choice_);
}

double AnyDiscretization::bending_energy(const Shape& shape) const {
    return std::visit([&](const auto& d) { return d.bending_energy(shape); }, choice_);
}

std::pair<double, double> AnyDiscretization::pole_curvatures(const Shape& shape) const {
    return std::visit([&](const auto& d) { return d.pole_curvatures(shape); }, choice_);
}

axistokes::Meridian<double> AnyDiscretization::sampled(const Shape& shape) const {
    return std::visit([&](const auto& d) { return d.sampled(shape); }, choice_);
}

bool AnyDiscretization::restore(Shape& shape, double area, double volume) const {
    return std::visit([&](const auto& d) { return d.restore(shape, area, volume); }, choice_);
}

bool AnyDiscretization::restore(Shape& shape, double volume) const {
    return std::visit([&](const auto& d) { return d.restore(shape, volume); }, choice_);
}

bool AnyDiscretization::redistribute(Shape& shape) const {
    return std::visit([&](const auto& d) { return d.redistribute(shape); }, choice_);
}

axistokes::Meridian<double> AnyDiscretization::redistributed(const Shape& shape, axistokes::Index elements) const {
    return std::visit([&](const auto& d) { return d.redistributed(shape, elements); }, choice_);
}

}  // namespace examples
