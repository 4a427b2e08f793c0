// SPDX-License-Identifier: MIT
// Spectral discretisation: coordinates and densities are sine and cosine series through the nodes, integrated on panels
// of Gauss-Legendre points that know the kernel's singularity (docs/spectral.md, section 4; layer/layer_engine.hpp).
#pragma once

#include "../geometry/spectral_geometry.hpp"
#include "../layer/layer_operators.hpp"
#include "../layer/series_basis.hpp"
#include "spectral_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace axistokes {

/// Discretisation policy: trigonometric series.
template <class S = double>
class SpectralMeridian : public SpectralGeometry<S>, public detail::LayerOperators<SpectralMeridian<S>, S> {
  public:
    using Scalar = S;
    using Surface = SpectralSurface<S>;

    struct Params {
        /// Relative error allowed in the integrals, in [eps, 0.1]; that of the series themselves depends on the degree.
        S tolerance = default_tolerance();
        SpectralMeshingParams<S> meshing;

        static S default_tolerance() {
            const S wanted = S(1e-10);
            const S reachable = 16 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument when the tolerance is not in [eps, 0.1] or a meshing parameter is out of range.
    explicit SpectralMeridian(Params params = {})
        : SpectralGeometry<S>(params.meshing),
          params_(checked(std::move(params))),
          order_(order_for(params_.tolerance)),
          rules_(params_.tolerance, 2 * order_) {}

    const Params& params() const { return params_; }

    /// The same with integrals as coarse as `tolerance`, or as coarse as they are.
    SpectralMeridian loosened(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return SpectralMeridian(std::move(params));
    }

    Surface surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) const {
        return spectral_surface(meridian, parts);
    }

    /// For LayerOperators, while the meridian lives.
    detail::SeriesBasis<S> layer_basis(const Meridian<S>& meridian) const { return {meridian, rules_, order_}; }

  private:
    static Params checked(Params params) {
        detail::require_tolerance("quadrature tolerance", params.tolerance);
        return params;
    }

    /// Enough nodes for a target half a panel's length away from a panel, or on its axis 0.22 lengths past its end.
    static Index order_for(const S& tolerance) {
        using std::log;
        return std::max<Index>(4, 1 + static_cast<Index>(std::ceil(static_cast<double>(log(S(1) / tolerance)) / 1.84)));
    }

    Params params_;
    Index order_;
    ElementRules<S> rules_;
};

}  // namespace axistokes
