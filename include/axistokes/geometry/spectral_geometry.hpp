// SPDX-License-Identifier: MIT
// The geometric services a Simulator asks of a discretisation, on the trigonometric series through the nodes
// (docs/spectral.md, section 5).
#pragma once

#include "curve_samples.hpp"
#include "meridian.hpp"
#include "remesh.hpp"
#include "series_transfer.hpp"
#include "trigonometric.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace axistokes {

/// Where the nodes of a spectral meridian go, and when they are moved.
template <class S>
struct SpectralMeshingParams {
    NodeSpacing<S> spacing;
    /// A further factor of the node density, of the position relative to the centroid; > 0 and smooth.
    std::function<S(const Point<S>&)> density;
    /// Nodes are redistributed when an interval differs from the wanted one by more than this factor, > 1.
    S largest_distortion = S(1.2);
};

/// Base of the discretisations whose meridian is a sine and a cosine series of t.
template <class S>
class SpectralGeometry : public detail::SampledGeometry<SpectralGeometry<S>, S> {
  public:
    /// Throws InvalidArgument when a parameter is out of range.
    explicit SpectralGeometry(SpectralMeshingParams<S> meshing = {}) : meshing_(std::move(meshing)) {
        detail::require(meshing_.spacing.curvature_weight >= S(0), "curvature weight",
                        meshing_.spacing.curvature_weight, ">= 0");
        detail::require(meshing_.spacing.smoothing >= S(0), "smoothing of the node density", meshing_.spacing.smoothing,
                        ">= 0");
        detail::require(meshing_.largest_distortion > S(1), "largest distortion", meshing_.largest_distortion, "> 1");
    }

    const SpectralMeshingParams<S>& meshing() const { return meshing_; }

    /// The curve at the nodes.
    CurveSamples<S> at_nodes(const Meridian<S>& shape) const { return detail::series_curve(shape); }
    /// At the points of a rule that is exact for the volume.
    CurveSamples<S> fine(const Meridian<S>& shape) const {
        const auto& at = TrigonometricBasis<S>::of_degree(shape.elements())->fine();
        CurveSamples<S> curve{at.odd * shape.r,
                              at.even * shape.z,
                              at.odd_slope * shape.r,
                              at.even_slope * shape.z,
                              at.odd_second * shape.r,
                              at.even_second * shape.z,
                              {},
                              at.weights};
        curve.finish();
        return curve;
    }

    /// Largest distance from the axis.
    S max_radius(const Meridian<S>& shape) const {
        const auto basis = TrigonometricBasis<S>::of_degree(shape.elements());
        const Vector<S> b = basis->odd_coefficients() * shape.r;
        const Vector<S> slope = basis->odd_first() * shape.r;
        S largest = 0;
        for (Index e = 0; e < shape.elements(); ++e) {
            if (slope[e] < S(0) || slope[e + 1] > S(0)) {
                continue;
            }
            S low = basis->nodes()[e];
            S high = basis->nodes()[e + 1];
            for (int i = 0; i < std::numeric_limits<S>::digits / 2 + 8; ++i) {
                const S middle = (low + high) / 2;
                (detail::sine_series_slope<S>(b, middle) > S(0) ? low : high) = middle;
            }
            largest = std::max(largest, detail::sine_series<S>(b, low));
        }
        return largest;
    }

    /// The part of the shape's slope dx/dt that the last quarter of its modes makes up: how well it is resolved.
    S unresolved(const Meridian<S>& shape) const {
        using std::sqrt;
        const auto basis = TrigonometricBasis<S>::of_degree(shape.elements());
        const Vector<S> k = Vector<S>::LinSpaced(shape.nodes(), S(0), S(shape.elements()));
        const Vector<S> power = k.cwiseProduct(basis->odd_coefficients() * shape.r).cwiseAbs2() +
                                k.cwiseProduct(basis->even_coefficients() * shape.z).cwiseAbs2();
        return sqrt(power.tail(shape.nodes() / 4).sum() / power.sum());
    }

    /// Points of the curve, twice as many as nodes, these among them.
    Meridian<S> sampled(const Meridian<S>& shape) const { return resampled(shape, 2 * shape.elements()); }

    /// Largest ratio between the spacing of nodes and the wanted one, or its inverse; 1 is perfect.
    S distortion(const Meridian<S>& shape) const {
        const Vector<S> density = node_density(shape);
        const S mean = TrigonometricBasis<S>::of_degree(shape.elements())->even_coefficients().row(0).dot(density);
        return std::max(S(density.maxCoeff() / mean), S(mean / density.minCoeff()));
    }

    /// Moves the nodes along the curve if their spacing has become too uneven; true if it did.
    bool redistribute(Meridian<S>& shape) const {
        Meridian<S> nothing;
        return redistribute(shape, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    bool redistribute(Meridian<S>& shape, Meridian<S>& carried) const {
        if (!(distortion(shape) > meshing_.largest_distortion)) {
            return false;
        }
        shape = redistributed(shape, shape.elements(), carried);
        return true;
    }

    /// `elements` + 1 nodes on the same curve, spaced as the parameters ask for. The curve changes by the part of it
    /// that the new series cannot represent. Throws InvalidArgument for fewer than 8 elements.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements) const {
        Meridian<S> nothing;
        return redistributed(shape, elements, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements, Meridian<S>& carried) const {
        detail::require_elements(elements);
        const auto basis = TrigonometricBasis<S>::of_degree(shape.elements());
        const Vector<S> density = basis->even_coefficients() * node_density(shape);
        // The new parameter is the integral of the density, tau(t) = t + sum_k g_k/(k g_0) sin kt.
        Vector<S> series = density / density[0];
        for (Index k = 1; k < series.size(); ++k) {
            series[k] /= S(k);
        }
        const S pi = detail::pi_value<S>();
        Vector<S> places(elements - 1);
        for (Index i = 1; i < elements; ++i) {
            const S wanted = pi * S(i) / S(elements);
            S low = 0;
            S high = pi;
            for (int k = 0; k < std::numeric_limits<S>::digits + 2; ++k) {
                const S middle = (low + high) / 2;
                (middle + detail::sine_series<S>(series, middle) < wanted ? low : high) = middle;
            }
            places[i - 1] = low;
        }
        if (carried.z.size() > 0) {
            carried = at(carried, places);
        }
        return at(shape, places);
    }

    /// The same series with `elements` + 1 nodes, cut off or continued by 0: the nodes keep their relative spacing.
    Meridian<S> resampled(const Meridian<S>& shape, Index elements) const { return detail::resampled(shape, elements); }

  private:
    /// The poles of a meridian and, between them, its points at the parameters `places`.
    static Meridian<S> at(const Meridian<S>& shape, const Vector<S>& places) {
        const auto basis = TrigonometricBasis<S>::of_degree(shape.elements());
        const Vector<S> a = basis->even_coefficients() * shape.z;
        const Vector<S> b = basis->odd_coefficients() * shape.r;
        const Index elements = places.size() + 1;
        Meridian<S> result{Vector<S>::Zero(elements + 1), Vector<S>(elements + 1)};
        result.z[0] = shape.z[0];
        result.z[elements] = shape.z[shape.elements()];
        for (Index i = 1; i < elements; ++i) {
            result.r[i] = detail::sine_series<S>(b, places[i - 1]);
            result.z[i] = detail::cosine_series<S>(a, places[i - 1]);
        }
        return result;
    }

    /// The wanted number of nodes per unit of t, up to a factor: by curvature, smoothed along the arc.
    Vector<S> node_density(const Meridian<S>& shape) const {
        using std::sqrt;
        const auto basis = TrigonometricBasis<S>::of_degree(shape.elements());
        const CurveSamples<S> curve = at_nodes(shape);
        Vector<S> density =
            (S(1) + (meshing_.spacing.curvature_weight * curve.meridional_curvature()).array().square()).sqrt();
        if (meshing_.density) {
            const S centroid = this->measures(shape).centroid;
            for (Index i = 0; i < density.size(); ++i) {
                density[i] *= meshing_.density({curve.r[i], curve.z[i] - centroid});
            }
        }
        const S length = basis->even_coefficients().row(0).dot(curve.speed) * detail::pi_value<S>();
        const S width = std::max<S>(meshing_.spacing.smoothing, S(2) / S(shape.elements())) * length;
        // (1 - width^2 d^2/ds^2)^2 w = density; twice, so that no kink of the density survives.
        const Vector<S> v2 = curve.speed.cwiseAbs2();
        const Vector<S> first =
            (curve.r1.cwiseProduct(curve.r2) + curve.z1.cwiseProduct(curve.z2)).cwiseQuotient(v2.cwiseAbs2());
        Matrix<S> system = (-width * width) * (v2.cwiseInverse().asDiagonal() * basis->even_second());
        system += (width * width) * (first.asDiagonal() * basis->even_first());
        system.diagonal().array() += S(1);
        const Eigen::PartialPivLU<Matrix<S>> lu(system);
        density = lu.solve(lu.solve(density));
        return density.cwiseProduct(curve.speed);
    }

    SpectralMeshingParams<S> meshing_;
};

}  // namespace axistokes
