// SPDX-License-Identifier: MIT
// The paper's P1 boundary elements: straight elements, linear densities, and quadrature that knows the kernel's
// singularity (layer/layer_engine.hpp).
#pragma once

#include "../geometry/spline_geometry.hpp"
#include "../layer/element_basis.hpp"
#include "../layer/layer_operators.hpp"
#include "linear_surface.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace axistokes {

/// Discretisation policy: P1 elements.
template <class S = double>
class LinearElements : public SplineGeometry<S>, public detail::LayerOperators<LinearElements<S>, S> {
  public:
    using Scalar = S;
    using Surface = LinearSurface<S>;

    struct Params {
        /// Relative error allowed in each element's integrals, in [eps, 0.1]. The elements themselves err by O(h^2).
        S tolerance = default_tolerance();
        MeshingParams<S> meshing;

        static S default_tolerance() {
            // Well below what hundreds of elements resolve (1e-5), and within reach of single precision.
            const S wanted = S(1e-6);
            const S reachable = 16 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument when the tolerance is not in [eps, 0.1] or a meshing parameter is out of range.
    explicit LinearElements(Params params = {})
        : SplineGeometry<S>(params.meshing), params_(checked(params)), rules_(params.tolerance) {}

    const Params& params() const { return params_; }

    /// The same discretisation with integrals as coarse as `tolerance`.
    LinearElements loosened(const S& tolerance) const {
        Params params = params_;
        params.tolerance = std::max(params.tolerance, tolerance);
        return LinearElements(std::move(params));
    }

    Surface surface(const Meridian<S>& meridian, SurfaceParts parts = SurfaceParts::all) const {
        return linear_surface(meridian, parts);
    }

    /// For LayerOperators, while the meridian lives.
    detail::ElementBasis<S> layer_basis(const Meridian<S>& meridian) const { return {meridian, rules_}; }

  private:
    static Params checked(Params params) {
        detail::require_tolerance("quadrature tolerance", params.tolerance);
        return params;
    }

    Params params_;
    ElementRules<S> rules_;
};

}  // namespace axistokes
