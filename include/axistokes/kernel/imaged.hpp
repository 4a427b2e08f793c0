// SPDX-License-Identifier: MIT
// A Green function composed of free space and of images: the part that a wall adds and that is smooth inside it.
//
//   M(x0, x) = M_FS(x0, x) + M_c(x0, x),   M = 0 for a target x0 on the wall
//
// The images are a policy of their own: a class with
//
//   Scalar                                          number type
//   correction(target, source) -> KernelBlock       M_c of one pair, with the ring's Jacobian r as in M_FS
//   gap(point) -> Scalar                            distance to the wall, < 0 beyond it, infinite without a wall
//
// and, where it makes sense,
//
//   regular(targets, quadrature, out)               a batch faster than pair by pair
//   loosened(tolerance) -> the same type            less accurate and faster
//   stress_correction(target, source, normal) -> KernelBlock   the same for the double layer's kernel
//   unit_flow(point) -> Point                       a straight tube's undisturbed flow of flow rate 1
//   static constexpr bool laboratory_frame          true if M_c depends on z itself, not only on z - z0 (a plane wall)
//
// Points outside the wall are refused by `correction`, with InvalidArgument.
#pragma once

#include "../geometry/meridian.hpp"
#include "../quadrature/regular_quadrature.hpp"
#include "free_space.hpp"

#include <utility>

namespace axistokes {

namespace detail {

template <class Images>
constexpr bool images_in_laboratory_frame() {
    if constexpr (requires { Images::laboratory_frame; }) {
        return Images::laboratory_frame;
    } else {
        return false;
    }
}

/// out += kernel(target, source index) integrated over the sources; the layout is that of ImagedKernel::regular.
template <class S, class Kernel>
void integrate_by_pairs(const Kernel& kernel, const Meridian<S>& targets, const RegularQuadrature<S>& sources,
                        Matrix<S>& out) {
    const Index rows = targets.nodes();
    const Index columns = sources.weights.cols();
    for (Index i = 0; i < rows; ++i) {
        for (Index q = 0; q < sources.points.nodes(); ++q) {
            const KernelBlock<S> m = kernel(Point<S>{targets.r[i], targets.z[i]}, q);
            for (typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator it(sources.weights, q); it; ++it) {
                out(i, it.col()) += it.value() * m.rr;
                out(i, columns + it.col()) += it.value() * m.rz;
                out(rows + i, it.col()) += it.value() * m.zr;
                out(rows + i, columns + it.col()) += it.value() * m.zz;
            }
        }
    }
}

/// ImagedKernel::regular by the images' `correction` of every pair.
template <class S, class Images>
void regular_by_pairs(const Images& images, const Meridian<S>& targets, const RegularQuadrature<S>& sources,
                      Matrix<S>& out) {
    integrate_by_pairs<S>(
        [&](const Point<S>& target, Index q) {
            return images.correction(target, Point<S>{sources.points.r[q], sources.points.z[q]});
        },
        targets, sources, out);
}

}  // namespace detail

/// Free space with the images of a wall.
template <class S, class Images>
class ImagedKernel {
  public:
    using Scalar = S;
    static constexpr bool has_images = true;
    static constexpr bool laboratory_frame = detail::images_in_laboratory_frame<Images>();

    explicit ImagedKernel(Images images) : images_(std::move(images)) {}

    const Images& images() const { return images_; }
    /// Without the images.
    const FreeSpaceKernel<S>& free_space() const { return free_space_; }

    /// The free-space part, which carries the singularity: as FreeSpaceKernel.
    void singular(const Point<S>& target, const S* r, const S* z, Index n, const KernelArrays<S>& out) const {
        free_space_.singular(target, r, z, n, out);
    }
    KernelBlock<S> singular(const Point<S>& target, const Point<S>& source) const {
        return free_space_.singular(target, source);
    }
    void singular_split(const Point<S>& target, const S* r, const S* z, Index n, const KernelArrays<S>& smooth,
                        const KernelArrays<S>& log_coefficient) const {
        free_space_.singular_split(target, r, z, n, smooth, log_coefficient);
    }

    /// Distance of a point from the wall, < 0 beyond it; its image is twice as far. Infinite without a wall.
    S gap(const Point<S>& x) const { return images_.gap(x); }

    /// The wall's part M_c(target, source), for probing: a batch may be much faster per pair. Throws InvalidArgument
    /// for points outside.
    KernelBlock<S> correction(const Point<S>& target, const Point<S>& source) const {
        return images_.correction(target, source);
    }
    /// Free space plus correction.
    KernelBlock<S> total(const Point<S>& target, const Point<S>& source) const {
        return singular(target, source) + correction(target, source);
    }

    /// out += M_c integrated over the sources, 2 targets x 2 nodes, stacked [r; z]. `quadrature(distance)` is a
    /// RegularQuadrature whose integrands are analytic within `distance` and within their distance to the nearest
    /// image. A point outside the wall got there by deformation: SimulationFailure, unlike in `correction`.
    template <class Quadrature>
    void regular(const Meridian<S>& targets, const Quadrature& quadrature, Matrix<S>& out) const {
        try {
            if constexpr (requires { images_.regular(targets, quadrature, out); }) {
                images_.regular(targets, quadrature, out);
            } else {
                detail::regular_by_pairs<S>(images_, targets, quadrature(S(0)), out);
            }
        } catch (const InvalidArgument& outside) {
            throw SimulationFailure(outside.what());
        }
    }

    /// The double layer's kernel in free space, which carries the singularity: as FreeSpaceKernel.
    void stress(const Point<S>& target, const S* r, const S* z, const S* normal_r, const S* normal_z, Index n,
                const KernelArrays<S>& out) const {
        free_space_.stress(target, r, z, normal_r, normal_z, n, out);
    }
    KernelBlock<S> stress(const Point<S>& target, const Point<S>& source, const Point<S>& normal) const {
        return free_space_.stress(target, source, normal);
    }
    void stress_split(const Point<S>& target, const S* r, const S* z, const S* normal_r, const S* normal_z, Index n,
                      const KernelArrays<S>& smooth, const KernelArrays<S>& log_coefficient) const {
        free_space_.stress_split(target, r, z, normal_r, normal_z, n, smooth, log_coefficient);
    }

    /// The wall's part of the double layer's kernel, for probing: as `correction`.
    KernelBlock<S> stress_correction(const Point<S>& target, const Point<S>& source, const Point<S>& normal) const
        requires(requires(const Images& images) { images.stress_correction(target, source, normal); }) {
        return images_.stress_correction(target, source, normal);
    }

    /// out += the wall's part of the double layer's kernel integrated over the sources, pair by pair, with `normals` at
    /// the quadrature points, stacked [r; z]. Layout, weights and failures as of `regular`.
    void regular_stress(const Meridian<S>& targets, const RegularQuadrature<S>& sources, const Vector<S>& normals,
                        Matrix<S>& out) const
        requires(requires(const Images& images, Point<S> x) { images.stress_correction(x, x, x); }) {
        const Index n = sources.points.nodes();
        try {
            detail::integrate_by_pairs<S>(
                [&](const Point<S>& target, Index q) {
                    return images_.stress_correction(target, Point<S>{sources.points.r[q], sources.points.z[q]},
                                                     Point<S>{normals[q], normals[n + q]});
                },
                targets, sources, out);
        } catch (const InvalidArgument& outside) {
            throw SimulationFailure(outside.what());
        }
    }

    /// The undisturbed flow of flow rate 1 along the tube.
    Point<S> unit_flow(const Point<S>& x) const requires(requires(const Images& images) { images.unit_flow(x); }) {
        return images_.unit_flow(x);
    }

    /// The same with the error `tolerance`, or the present one if that is larger.
    ImagedKernel loosened(const S& tolerance) const
        requires(requires(const Images& images) { images.loosened(tolerance); }) {
        return ImagedKernel(images_.loosened(tolerance));
    }

  private:
    FreeSpaceKernel<S> free_space_;
    Images images_;
};

}  // namespace axistokes
