// SPDX-License-Identifier: MIT
// The geometric services a Simulator asks of a discretisation, on piecewise polynomials in the node index
// (docs/adaptive.md, sections 1 and 4).
#pragma once

#include "curve_samples.hpp"
#include "local_polynomials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace axistokes {

/// Where the nodes of an adaptive meridian go, and how many there are.
template <class S>
struct AdaptiveMeshingParams {
    /// Half the number of nodes of a polynomial: the order is twice that. In [2, 6].
    Index half_width = 4;
    /// Nodes per unit of length, up to a factor: sqrt(base^2 + k_m^2 + (weight k_a)^2), k_m and k_a the meridional and
    /// the azimuthal curvature in 1/R0; base > 0, weight >= 0.
    S base = S(0.5);
    S azimuthal_weight = S(0.4);
    /// The logarithm of that is smoothed over this length in units of its inverse, at least 2 nodes, > 0.
    S smoothing = S(0.4);
    /// The factor: as many elements as a redistribution finds necessary. None: their number stays as it is.
    std::optional<S> resolution;
    Index least_elements = 24;
    Index most_elements = 1200;
    /// Nodes are redistributed when an interval differs from the wanted one by more than this factor, > 1.
    S largest_distortion = S(1.2);
};

/// Base of the discretisations whose meridian is a piecewise polynomial in the node index.
template <class S>
class AdaptiveGeometry : public detail::SampledGeometry<AdaptiveGeometry<S>, S> {
  public:
    /// Throws InvalidArgument when a parameter is out of range.
    explicit AdaptiveGeometry(AdaptiveMeshingParams<S> meshing = {}) : meshing_(std::move(meshing)) {
        const auto& m = meshing_;
        detail::require(m.half_width >= 2 && m.half_width <= 6, "half width of the polynomials", m.half_width,
                        "in [2, 6]");
        detail::require(m.base > S(0), "base of the node density", m.base, "> 0");
        detail::require(m.azimuthal_weight >= S(0), "weight of the azimuthal curvature", m.azimuthal_weight, ">= 0");
        detail::require(m.smoothing > S(0), "smoothing of the node density", m.smoothing, "> 0");
        detail::require(!m.resolution || *m.resolution > S(0), "resolution", m.resolution.value_or(S(1)), "> 0");
        detail::require(m.least_elements >= minimum_elements, "least number of elements", m.least_elements,
                        "at least 8");
        detail::require(m.most_elements >= m.least_elements, "largest number of elements", m.most_elements,
                        "at least the least one");
        detail::require(m.largest_distortion > S(1), "largest distortion", m.largest_distortion, "> 1");
    }

    const AdaptiveMeshingParams<S>& meshing() const { return meshing_; }

    /// The curve at the nodes.
    CurveSamples<S> at_nodes(const Meridian<S>& shape) const { return detail::local_curve(shape, half()); }

    /// At the points of a rule that is as accurate as the polynomials.
    CurveSamples<S> fine(const Meridian<S>& shape) const {
        const Index q = 2 * half();
        const auto rules = detail::computed_once<GaussLegendreTable<S>>(q);
        const GaussLegendreRule<S>& rule = (*rules)[q];
        const detail::LocalPolynomials<S> r(shape.r, -1, half());
        const detail::LocalPolynomials<S> z(shape.z, 1, half());
        const Index count = q * shape.elements();
        CurveSamples<S> curve{Vector<S>(count),
                              Vector<S>(count),
                              Vector<S>(count),
                              Vector<S>(count),
                              Vector<S>(count),
                              Vector<S>(count),
                              {},
                              Vector<S>(count)};
        Index i = 0;
        for (Index e = 0; e < shape.elements(); ++e) {
            for (Index k = 0; k < q; ++k, ++i) {
                const S& t = rule.nodes[k];
                curve.r[i] = r.value(e, t);
                curve.z[i] = z.value(e, t);
                curve.r1[i] = r.slope(e, t);
                curve.z1[i] = z.slope(e, t);
                curve.r2[i] = r.second(e, t);
                curve.z2[i] = z.second(e, t);
                curve.weights[i] = rule.weights[k];
            }
        }
        curve.finish();
        return curve;
    }

    /// Largest distance from the axis.
    S max_radius(const Meridian<S>& shape) const {
        const detail::LocalPolynomials<S> r(shape.r, -1, half());
        S largest = shape.r.maxCoeff();
        for (Index e = 0; e < shape.elements(); ++e) {
            if (r.slope(e, S(0)) < S(0) || r.slope(e, S(1)) > S(0)) {
                continue;
            }
            S low = 0;
            S high = 1;
            for (int i = 0; i < std::numeric_limits<S>::digits / 2 + 8; ++i) {
                const S middle = (low + high) / 2;
                (r.slope(e, middle) > S(0) ? low : high) = middle;
            }
            largest = std::max(largest, r.value(e, low));
        }
        return largest;
    }

    /// How well the shape is resolved: from d, the largest distance between the polynomials and the curve over that of
    /// two nodes, as far as differences of the order tell, 4 d (d/1e-3)^(1/4), or 4 d of larger ones. That is at least
    /// twice the relative error of velocities and lengths (docs/adaptive.md, section 5).
    S unresolved(const Meridian<S>& shape) const {
        using std::sqrt;
        const Index m = half();
        const Vector<S> r = detail::continued(shape.r, -1, m);
        const Vector<S> z = detail::continued(shape.z, 1, m);
        // In the middle of an element, f^(2m)/(2m)! times the product of the distances from 2m nodes; the difference is
        // f^(2m).
        Vector<S> difference(2 * m + 1);
        difference[0] = 1;
        S factor = 1;
        for (Index k = 1; k <= 2 * m; ++k) {
            difference[k] = -difference[k - 1] * S(2 * m + 1 - k) / S(k);
            factor /= S(k);
        }
        for (Index k = 0; k < m; ++k) {
            factor *= (S(2 * k + 1) / 2) * (S(2 * k + 1) / 2);
        }
        S largest = 0;
        for (Index i = 0; i < shape.nodes(); ++i) {
            const S dr = difference.dot(r.segment(i, 2 * m + 1));
            const S dz = difference.dot(z.segment(i, 2 * m + 1));
            const S tr = (r[i + m + 1] - r[i + m - 1]) / 2;
            const S tz = (z[i + m + 1] - z[i + m - 1]) / 2;
            largest = std::max<S>(largest, factor * sqrt((dr * dr + dz * dz) / (tr * tr + tz * tz)));
        }
        return 4 * largest * std::min<S>(S(1), sqrt(S(sqrt(largest / S(1e-3)))));
    }

    /// The nodes, and the middles of the elements on the curve between them.
    Meridian<S> sampled(const Meridian<S>& shape) const {
        const auto stencils = detail::local_stencils<S>(half());
        const Vector<S> r = detail::continued(shape.r, -1, half());
        const Vector<S> z = detail::continued(shape.z, 1, half());
        Meridian<S> result{Vector<S>(2 * shape.elements() + 1), Vector<S>(2 * shape.elements() + 1)};
        for (Index i = 0; i < shape.nodes(); ++i) {
            result.r[2 * i] = shape.r[i];
            result.z[2 * i] = shape.z[i];
        }
        for (Index e = 0; e < shape.elements(); ++e) {
            result.r[2 * e + 1] = stencils->middle.dot(r.segment(e + 1, 2 * half()));
            result.z[2 * e + 1] = stencils->middle.dot(z.segment(e + 1, 2 * half()));
        }
        return result;
    }

    Index most_elements() const { return meshing_.most_elements; }

    /// The number of elements that reduces `unresolved` from `now` to `wanted`: it falls like the differences it is of.
    Index finer(Index elements, const S& now, const S& wanted) const {
        using std::pow;
        const S factor = S(1.1) * pow(now / wanted, S(4) / S(5 * (2 * half() - 1)));
        return static_cast<Index>(std::ceil(static_cast<double>(S(elements) * std::clamp(factor, S(1.1), S(1.6)))));
    }

    /// As many elements as the resolution asks for; those there are if it asks for none.
    Index wanted_elements(const Meridian<S>& shape) const {
        using std::ceil;
        if (!meshing_.resolution) {
            return shape.elements();
        }
        const S wanted = *meshing_.resolution * total(shape, node_density(shape));
        return std::clamp(static_cast<Index>(ceil(static_cast<double>(wanted))), meshing_.least_elements,
                          meshing_.most_elements);
    }

    /// Largest ratio between the spacing of nodes and the wanted one, or its inverse; 1 is perfect.
    S distortion(const Meridian<S>& shape) const {
        const Vector<S> density = node_density(shape);
        const S mean = total(shape, density) / S(shape.elements());
        return std::max(S(density.maxCoeff() / mean), S(mean / density.minCoeff()));
    }

    /// Moves the nodes along the curve if their spacing has become too uneven, or their number wrong; true if it did.
    bool redistribute(Meridian<S>& shape) const {
        Meridian<S> nothing;
        return redistribute(shape, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    bool redistribute(Meridian<S>& shape, Meridian<S>& carried) const {
        Index elements = wanted_elements(shape);
        const Index now = shape.elements();
        if (20 * elements < 21 * now && 20 * elements > 17 * now) {
            elements = now;
        }
        if (elements == now && !(distortion(shape) > meshing_.largest_distortion)) {
            return false;
        }
        shape = redistributed(shape, elements, carried);
        return true;
    }

    /// `elements` + 1 nodes on the same curve, spaced as the parameters ask for. Throws InvalidArgument for fewer than
    /// 8 elements.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements) const {
        Meridian<S> nothing;
        return redistributed(shape, elements, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements, Meridian<S>& carried) const {
        detail::require_elements(elements);
        const detail::LocalPolynomials<S> density(node_density(shape), 1, half());
        Vector<S> before(shape.nodes());
        before[0] = 0;
        for (Index e = 0; e < shape.elements(); ++e) {
            before[e + 1] = before[e] + density.integral(e, S(1));
        }
        std::vector<std::pair<Index, S>> places;  // an element and the local coordinate on it
        Index e = 0;
        for (Index i = 1; i < elements; ++i) {
            const S wanted = before[shape.elements()] * S(i) / S(elements);
            while (e + 1 < shape.elements() && before[e + 1] < wanted) {
                ++e;
            }
            S low = 0;
            S high = 1;
            for (int k = 0; k < std::numeric_limits<S>::digits + 2; ++k) {
                const S middle = (low + high) / 2;
                (before[e] + density.integral(e, middle) < wanted ? low : high) = middle;
            }
            places.emplace_back(e, low);
        }
        if (carried.z.size() > 0) {
            carried = at(carried, places);
        }
        return at(shape, places);
    }

  private:
    Index half() const { return meshing_.half_width; }

    /// The poles of a meridian and, between them, its points at `places`.
    Meridian<S> at(const Meridian<S>& shape, const std::vector<std::pair<Index, S>>& places) const {
        const detail::LocalPolynomials<S> r(shape.r, -1, half());
        const detail::LocalPolynomials<S> z(shape.z, 1, half());
        const auto elements = static_cast<Index>(places.size()) + 1;
        Meridian<S> result{Vector<S>::Zero(elements + 1), Vector<S>(elements + 1)};
        result.z[0] = shape.z[0];
        result.z[elements] = shape.z[shape.elements()];
        for (Index i = 1; i < elements; ++i) {
            const auto& [e, t] = places[static_cast<std::size_t>(i - 1)];
            result.r[i] = r.value(e, t);
            result.z[i] = z.value(e, t);
        }
        return result;
    }

    /// Of nodal values of an even function, over the node index.
    S total(const Meridian<S>& shape, const Vector<S>& density) const {
        // The trapezoidal rule has no other errors: an even function is smooth across the poles.
        return density.sum() - (density[0] + density[shape.elements()]) / 2;
    }

    /// The wanted number of nodes per unit of the node index, up to a factor.
    Vector<S> node_density(const Meridian<S>& shape) const {
        using std::exp;
        using std::log;
        using std::sqrt;
        const CurveSamples<S> curve = at_nodes(shape);
        const Vector<S> k = curve.meridional_curvature();
        const Index last = shape.elements();
        Vector<S> density(shape.nodes());
        for (Index i = 0; i <= last; ++i) {
            const S azimuthal = i == 0 || i == last ? k[i] : S(curve.z1[i] / (curve.speed[i] * curve.r[i]));
            const S weighted = meshing_.azimuthal_weight * azimuthal;
            density[i] = log(S(meshing_.base * meshing_.base + k[i] * k[i] + weighted * weighted)) / 2;
        }
        // (1 - w^2 d^2/di^2)^2 x = density, by the tridiagonal matrix of differences, twice.
        const Vector<S> raw = density.array().exp().matrix().cwiseProduct(curve.speed);
        const S width = std::max<S>(S(2), meshing_.smoothing * S(last) / total(shape, raw));
        for (int pass = 0; pass < 2; ++pass) {
            smooth(density, width);
        }
        for (Index i = 0; i <= last; ++i) {
            density[i] = exp(density[i]) * curve.speed[i];
        }
        return density;
    }

    static void smooth(Vector<S>& x, const S& width) {
        const S w2 = width * width;
        const Index last = x.size() - 1;
        Vector<S> upper(x.size());
        const S diagonal = S(1) + 2 * w2;
        upper[0] = -2 * w2 / diagonal;
        x[0] /= diagonal;
        for (Index i = 1; i <= last; ++i) {
            const S lower = i == last ? S(-2 * w2) : S(-w2);
            const S pivot = diagonal - lower * upper[i - 1];
            upper[i] = -w2 / pivot;
            x[i] = (x[i] - lower * x[i - 1]) / pivot;
        }
        for (Index i = last - 1; i >= 0; --i) {
            x[i] -= upper[i] * x[i + 1];
        }
    }

    AdaptiveMeshingParams<S> meshing_;
};

}  // namespace axistokes
