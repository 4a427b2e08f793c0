// SPDX-License-Identifier: MIT
// A discretisation chosen at run time: what the library is given as a policy at compile time, the programs here choose
// on the command line, and share what that takes to compile.
#pragma once

#include "method.hpp"
#include "optional_tube.hpp"
#include <axistokes/discretization/adaptive_meridian.hpp>
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/discretization/spectral_meridian.hpp>

#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace examples {

/// A linear operator of a surface: sparse of elements and piecewise polynomials, dense of series.
class AnyOperator {
  public:
    using Sparse = axistokes::LinearSurface<double>::Operator;
    using Dense = axistokes::Matrix<double>;
    using Vector = axistokes::Vector<double>;
    using Index = axistokes::Index;
    using Diagonal = Eigen::DiagonalWrapper<const Vector>;

    AnyOperator() = default;
    AnyOperator(Sparse matrix) : matrix_(std::move(matrix)) {}
    AnyOperator(Dense matrix) : matrix_(std::move(matrix)) {}

    Index rows() const;
    Index cols() const;
    operator Dense() const;

    template <class Kind>
    const Kind& as() const {
        return std::get<Kind>(matrix_);
    }

    AnyOperator& operator+=(const AnyOperator& other);
    friend AnyOperator operator+(AnyOperator a, const AnyOperator& b) { return a += b; }
    friend AnyOperator operator*(const AnyOperator& a, const AnyOperator& b) { return a.after(b); }
    friend AnyOperator operator*(double factor, AnyOperator a) {
        a.scale(factor);
        return a;
    }
    friend AnyOperator operator*(const Diagonal& rows, AnyOperator a) {
        a.scale_rows(rows.diagonal());
        return a;
    }
    friend Vector operator*(const AnyOperator& a, const Vector& x) { return a.apply(x); }
    friend Dense operator*(const AnyOperator& a, const Dense& x) { return a.apply(x); }
    friend Dense operator*(const Dense& x, const AnyOperator& a) { return a.apply_to_rows(x); }

  private:
    AnyOperator after(const AnyOperator& other) const;
    void scale(double factor);
    void scale_rows(const Vector& factors);
    Vector apply(const Vector& x) const;
    Dense apply(const Dense& x) const;
    Dense apply_to_rows(const Dense& x) const;

    std::variant<Sparse, Dense> matrix_;
};

/// Surface of any of them, whose names these are.
class AnySurface {
  public:
    using Operator = AnyOperator;
    using Vector = axistokes::Vector<double>;
    using Index = axistokes::Index;

    AnySurface() = default;
    template <class Surface>
    explicit AnySurface(Surface surface);

    axistokes::Meridian<double> nodes;
    Vector arc_length;
    Vector weight;
    Vector volume_gradient;
    Vector normal_r;
    Vector normal_z;
    Vector mean_curvature;
    Vector gauss_curvature;
    Vector element_area;
    Operator laplacian;
    Operator mean_curvature_of;
    Operator divergence;
    Operator tension_force;
    axistokes::CurveSamples<double> curve;  // empty of elements

    Index size() const { return nodes.nodes(); }
    bool differentiable() const { return curve.speed.size() > 0; }
    Operator change(const axistokes::NodalChange<double>& c) const;
    Operator changes(const axistokes::NodalChange<double>& upper, const axistokes::NodalChange<double>& lower) const;
    Vector slopes(const Vector& values) const;
    Vector second_slopes(const Vector& values) const;
    Vector tension_slopes(const Vector& tension) const;
    Vector normals() const;
    Operator along_normal(const Operator& scalar) const;
    double flux(const Vector& field) const;
    double area() const;
    Vector at_nodes(const Vector& tension) const;
    Vector surface_gradient(const Vector& values) const;
    Vector surface_divergence(const Vector& field) const;

  private:
    template <class Surface>
    using Shared = std::shared_ptr<const Surface>;

    std::variant<Shared<axistokes::LinearSurface<double>>, Shared<axistokes::SpectralSurface<double>>,
                 Shared<axistokes::AdaptiveSurface<double>>>
        surface_;
};

/// One of them.
class AnyDiscretization {
  public:
    using Scalar = double;
    using Surface = AnySurface;
    using Shape = axistokes::Meridian<double>;
    using Matrix = axistokes::Matrix<double>;
    using Free = axistokes::FreeSpaceKernel<double>;
    using Linear = axistokes::LinearElements<double>;
    using Spectral = axistokes::SpectralMeridian<double>;
    using Adaptive = axistokes::AdaptiveMeridian<double>;

    explicit AnyDiscretization(Linear linear) : choice_(std::move(linear)) {}
    explicit AnyDiscretization(Spectral spectral) : choice_(std::move(spectral)) {}
    explicit AnyDiscretization(Adaptive adaptive) : choice_(std::move(adaptive)) {}

    /// With integrals of that tolerance, or of its own default.
    static AnyDiscretization of(DiscretizationKind kind, std::optional<double> tolerance);

    DiscretizationKind kind() const { return static_cast<DiscretizationKind>(choice_.index()); }
    bool judges_itself() const { return kind() != DiscretizationKind::linear; }
    /// 0 of elements, which do not tell.
    double unresolved(const Shape& shape) const;
    axistokes::Index finer(axistokes::Index elements, double now, double wanted) const;
    axistokes::Index most_elements() const;

    AnyDiscretization loosened(double tolerance) const;
    Surface surface(const Shape& shape, axistokes::SurfaceParts parts = axistokes::SurfaceParts::all) const;
    Matrix single_layer(const Shape& shape, const OptionalTubeKernel& kernel) const;
    Matrix single_layer(const Shape& shape, const Free& kernel) const;
    Matrix single_layer_at(const Shape& targets, const Shape& shape, const OptionalTubeKernel& kernel) const;
    Matrix single_layer_at(const Shape& targets, const Shape& shape, const Free& kernel) const;

    axistokes::Measures<double> measures(const Shape& shape) const;
    double max_radius(const Shape& shape) const;
    double bending_energy(const Shape& shape) const;
    std::pair<double, double> pole_curvatures(const Shape& shape) const;
    Shape sampled(const Shape& shape) const;
    bool restore(Shape& shape, double area, double volume) const;
    bool restore(Shape& shape, double volume) const;
    bool redistribute(Shape& shape) const;
    Shape redistributed(const Shape& shape, axistokes::Index elements) const;

  private:
    std::variant<Linear, Spectral, Adaptive> choice_;
};

}  // namespace examples
