// SPDX-License-Identifier: MIT
// The geometric services a Simulator asks of a discretisation, on the cubic spline through the nodes: errors O(h^4),
// two orders below those of the P1 operators.
#pragma once

#include "curvature.hpp"
#include "meridian_spline.hpp"
#include "remesh.hpp"
#include "restore.hpp"

#include <limits>

namespace axistokes {

/// Where nodes go, and when they are moved.
template <class S>
struct MeshingParams {
    NodeSpacing<S> spacing;
    /// Nodes are redistributed when an interval differs from the wanted one by more than this factor, > 1.
    S largest_distortion = S(1.2);
};

/// Base of the discretisations whose meridian is the spline through its nodes.
template <class S>
class SplineGeometry {
  public:
    /// Throws InvalidArgument when a parameter is out of range.
    explicit SplineGeometry(MeshingParams<S> meshing = {}) : meshing_(meshing) {
        detail::require(meshing.spacing.curvature_weight >= S(0), "curvature weight", meshing.spacing.curvature_weight,
                        ">= 0");
        detail::require(meshing.spacing.smoothing >= S(0), "smoothing of the node density", meshing.spacing.smoothing,
                        ">= 0");
        detail::require(meshing.largest_distortion > S(1), "largest distortion", meshing.largest_distortion, "> 1");
    }

    const MeshingParams<S>& meshing() const { return meshing_; }

    Measures<S> measures(const Meridian<S>& shape) const { return MeridianSpline<S>(shape).measures(); }

    S max_radius(const Meridian<S>& shape) const { return MeridianSpline<S>(shape).max_radius(); }

    /// 2 Int H^2 dA in kappa.
    S bending_energy(const Meridian<S>& shape) const { return axistokes::bending_energy(shape); }

    /// Meridional curvatures at the lower and the upper pole, in 1/R0, positive on a sphere.
    std::pair<S, S> pole_curvatures(const Meridian<S>& shape) const {
        const Vector<S> k = principal_curvatures(shape).meridional;
        return {k[0], k[k.size() - 1]};
    }

    /// Gives the shape the area and volume again that time stepping has lost; false if that fails.
    bool restore(Meridian<S>& shape, const S& area, const S& volume) const {
        return restore_area_and_volume<S>(shape, area, volume, 1000 * std::numeric_limits<S>::epsilon());
    }

    /// Gives the shape its volume again, if its area may change; false if that fails.
    bool restore(Meridian<S>& shape, const S& volume) const {
        return restore_volume<S>(shape, volume, 1000 * std::numeric_limits<S>::epsilon());
    }

    /// The nodes, and the middles of the elements on the curve between them.
    Meridian<S> sampled(const Meridian<S>& shape) const {
        const MeridianSpline<S> spline(shape);
        Meridian<S> result{Vector<S>(2 * shape.elements() + 1), Vector<S>(2 * shape.elements() + 1)};
        for (Index i = 0; i < shape.nodes(); ++i) {
            result.r[2 * i] = shape.r[i];
            result.z[2 * i] = shape.z[i];
        }
        for (Index e = 0; e < shape.elements(); ++e) {
            const Point<S> middle = spline.at(e, S(0.5)).position;
            result.r[2 * e + 1] = middle.r;
            result.z[2 * e + 1] = middle.z;
        }
        return result;
    }

    /// Moves the nodes along the curve if their spacing has become too uneven; true if it did.
    bool redistribute(Meridian<S>& shape) const {
        Meridian<S> nothing;
        return redistribute(shape, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    bool redistribute(Meridian<S>& shape, Meridian<S>& carried) const {
        if (!(spacing_distortion(shape, meshing_.spacing) > meshing_.largest_distortion)) {
            return false;
        }
        shape = redistributed(shape, shape.elements(), carried);
        return true;
    }

    /// `elements` elements on the same curve, spaced as the parameters ask for. Throws InvalidArgument for fewer
    /// than 8.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements) const {
        Meridian<S> nothing;
        return redistributed(shape, elements, nothing);
    }
    /// `carried`, if not empty, is another meridian on the same nodes: it gets the new ones too.
    Meridian<S> redistributed(const Meridian<S>& shape, Index elements, Meridian<S>& carried) const {
        return axistokes::redistribute(shape, meshing_.spacing, elements, carried);
    }

  private:
    MeshingParams<S> meshing_;
};

}  // namespace axistokes
