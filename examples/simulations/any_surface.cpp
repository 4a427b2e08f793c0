// SPDX-License-Identifier: MIT
#include "../support/any_discretization.hpp"

#include <stdexcept>

namespace examples {

AnyOperator::Index AnyOperator::rows() const {
    return std::visit([](const auto& a) { return Index(a.rows()); }, matrix_);
}

AnyOperator::Index AnyOperator::cols() const {
    return std::visit([](const auto& a) { return Index(a.cols()); }, matrix_);
}

AnyOperator::operator Dense() const {
    return std::visit([](const auto& a) { return Dense(a); }, matrix_);
}

AnyOperator& AnyOperator::operator+=(const AnyOperator& other) {
    std::visit([&](auto& a) { a += other.as<std::decay_t<decltype(a)>>(); }, matrix_);
    return *this;
}

AnyOperator AnyOperator::after(const AnyOperator& other) const {
    return std::visit(
        [&](const auto& a) {
            using Kind = std::decay_t<decltype(a)>;
            return AnyOperator(Kind(a * other.as<Kind>()));
        },
        matrix_);
}

void AnyOperator::scale(double factor) {
    std::visit([&](auto& a) { a *= factor; }, matrix_);
}

void AnyOperator::scale_rows(const Vector& factors) {
    std::visit([&](auto& a) { a = factors.asDiagonal() * a; }, matrix_);
}

AnyOperator::Vector AnyOperator::apply(const Vector& x) const {
    return std::visit([&](const auto& a) { return Vector(a * x); }, matrix_);
}

AnyOperator::Dense AnyOperator::apply(const Dense& x) const {
    return std::visit([&](const auto& a) { return Dense(a * x); }, matrix_);
}

AnyOperator::Dense AnyOperator::apply_to_rows(const Dense& x) const {
    return std::visit([&](const auto& a) { return Dense(x * a); }, matrix_);
}

namespace {

template <class Surface>
axistokes::CurveSamples<double> curve_of(const Surface& surface) {
    if constexpr (axistokes::DifferentiableSurface<Surface>) {
        return surface.curve;
    } else {
        return {};
    }
}

/// use(surface) of one that is differentiable.
template <class Surfaces, class Use>
auto of_differentiable(const Surfaces& surfaces, const Use& use) {
    return std::visit(
        [&](const auto& surface) -> decltype(use(*std::get<1>(surfaces))) {
            if constexpr (axistokes::DifferentiableSurface<std::decay_t<decltype(*surface)>>) {
                return use(*surface);
            } else {
                throw std::logic_error("elements have no derivatives");
            }
        },
        surfaces);
}

}  // namespace

template <class Surface>
AnySurface::AnySurface(Surface surface)
    : nodes(surface.nodes),
      arc_length(surface.arc_length),
      weight(surface.weight),
      volume_gradient(surface.volume_gradient),
      normal_r(surface.normal_r),
      normal_z(surface.normal_z),
      mean_curvature(surface.mean_curvature),
      gauss_curvature(surface.gauss_curvature),
      element_area(surface.element_area),
      laplacian(std::move(surface.laplacian)),
      mean_curvature_of(std::move(surface.mean_curvature_of)),
      divergence(std::move(surface.divergence)),
      tension_force(std::move(surface.tension_force)),
      curve(curve_of(surface)),
      surface_(std::make_shared<const Surface>(std::move(surface))) {}

template AnySurface::AnySurface(axistokes::LinearSurface<double>);
template AnySurface::AnySurface(axistokes::SpectralSurface<double>);
template AnySurface::AnySurface(axistokes::AdaptiveSurface<double>);

AnyOperator AnySurface::change(const axistokes::NodalChange<double>& c) const {
    return of_differentiable(surface_, [&](const auto& s) { return AnyOperator(s.change(c)); });
}

AnyOperator AnySurface::changes(const axistokes::NodalChange<double>& upper,
                                const axistokes::NodalChange<double>& lower) const {
    return of_differentiable(surface_, [&](const auto& s) { return AnyOperator(s.changes(upper, lower)); });
}

AnySurface::Vector AnySurface::slopes(const Vector& values) const {
    return of_differentiable(surface_, [&](const auto& s) { return s.slopes(values); });
}

AnySurface::Vector AnySurface::second_slopes(const Vector& values) const {
    return of_differentiable(surface_, [&](const auto& s) { return s.second_slopes(values); });
}

AnySurface::Vector AnySurface::tension_slopes(const Vector& tension) const {
    return of_differentiable(surface_, [&](const auto& s) { return s.tension_slopes(tension); });
}

AnySurface::Vector AnySurface::normals() const {
    Vector n(2 * size());
    n << normal_r, normal_z;
    return n;
}

AnyOperator AnySurface::along_normal(const Operator& scalar) const {
    return std::visit(
        [&](const auto& surface) {
            using Kind = typename std::decay_t<decltype(*surface)>::Operator;
            return AnyOperator(surface->along_normal(scalar.as<Kind>()));
        },
        surface_);
}

double AnySurface::flux(const Vector& field) const {
    return volume_gradient.dot(field);
}

double AnySurface::area() const {
    return weight.sum();
}

AnySurface::Vector AnySurface::at_nodes(const Vector& tension) const {
    return std::visit([&](const auto& surface) { return surface->at_nodes(tension); }, surface_);
}

AnySurface::Vector AnySurface::surface_gradient(const Vector& values) const {
    return std::visit([&](const auto& surface) { return surface->surface_gradient(values); }, surface_);
}

AnySurface::Vector AnySurface::surface_divergence(const Vector& field) const {
    return at_nodes(divergence * field);
}

}  // namespace examples
