// SPDX-License-Identifier: MIT
// Adaptive discretisation: piecewise polynomials of high order, nodes where the shape needs them (docs/adaptive.md).
#pragma once

#include "../geometry/adaptive_geometry.hpp"
#include "../layer/adaptive_basis.hpp"
#include "../layer/layer_operators.hpp"
#include "adaptive_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace axistokes {

/// Discretisation policy: piecewise polynomials in the node index.
template <class S = double>
class AdaptiveMeridian : public AdaptiveGeometry<S>, public detail::LayerOperators<AdaptiveMeridian<S>, S> {
  public:
    using Scalar = S;
    using Surface = AdaptiveSurface<S>;

    struct Params {
        /// Relative error allowed in the integrals, in [eps, 0.1]; that of the polynomials depends on the nodes.
        S tolerance = default_tolerance();
        AdaptiveMeshingParams<S> meshing;

        static S default_tolerance() {
            const S wanted = S(1e-8);
            const S reachable = 16 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument when the tolerance is not in [eps, 0.1] or a meshing parameter is out of range.
    explicit AdaptiveMeridian(Params params = {})
        : AdaptiveGeometry<S>(params.meshing),
          params_(checked(std::move(params))),
          order_(params_.meshing.half_width),
          rules_(params_.tolerance, 2 * order_) {}

    const Params& params() const { return params_; }

    /// The same with integrals as coarse as `tolerance`, or as coarse as they are.
    AdaptiveMeridian loosened(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return AdaptiveMeridian(std::move(params));
    }

    Surface surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) const {
        return adaptive_surface(meridian, params_.meshing.half_width, parts);
    }

    /// For LayerOperators, while the meridian lives.
    detail::AdaptiveBasis<S> layer_basis(const Meridian<S>& meridian) const {
        return {meridian, rules_, params_.meshing.half_width, order_};
    }

  private:
    static Params checked(Params params) {
        detail::require_tolerance("quadrature tolerance", params.tolerance);
        return params;
    }

    Params params_;
    Index order_;
    ElementRules<S> rules_;
};

}  // namespace axistokes
