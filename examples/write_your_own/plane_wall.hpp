// SPDX-License-Identifier: MIT
// A kernel of your own: what a plane no-slip wall adds to the free-space kernel, after Blake, Proc. Camb. Phil. Soc. 70
// (1971) 303.
//
// Let h and k be the heights of source and target over the wall, H = h + k, X the vector from the image of a point of
// the ring to the target, R its length. A point force along z, or along a unit vector e normal to z, adds
//
//   -Stokeslet(image) with the sign of its z component turned where e_z acts on r and the reverse, of weight (h - k)/H,
//   +-2 h k grad grad (1/R) . (e or e_z): a dipole of sources.
//
// The images' Stokeslets are the library's ring kernel F. The dipoles' ring integrals of 1/R^3 and 1/R^5 are sums of
// the h and c of special/ring_integrals.hpp. With D^2 = (r + r0)^2 + H^2, m1 = ((r - r0)^2 + H^2)/D^2, t = H^2/D^2, s =
// 2 (1 + m1) c + 3 m1 h and A = 8 h k r/(D^3 m1^2):
//
//   M_rr = -F_rr + A (4 r r0/D^2) [(m1 - 2 (1 + m1) t) c - 3 t m1 h]
//   M_rz = (h - k)/H F_rz + 2 A (r0 H/D^2) [m1 c + ((r - r0)(r + r0) - H^2)/D^2 s]
//   M_zr = (h - k)/H F_zr + 2 A (r H/D^2) [m1 c - ((r - r0)(r + r0) + H^2)/D^2 s]
//   M_zz = -F_zz + A [(m1 (1 + m1) - 2 (1 + m1 + m1^2) t) c + m1 (2 m1 - 3 (1 + m1) t) h]
//
// No entry subtracts nearly equal numbers except at its own zeros. On the wall, k = 0, what remains of M cancels the
// free-space kernel exactly.
#pragma once

#include <axistokes/core.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/special/ring_integrals.hpp>

#include <cmath>
#include <sstream>

namespace write_your_own {

/// A no-slip wall at z = `position`, with fluid above it.
template <class S = double>
class PlaneImages {
  public:
    using Scalar = S;
    /// The wall is at rest in the laboratory: the place of the bodies matters.
    static constexpr bool laboratory_frame = true;

    /// Throws InvalidArgument unless the position is finite.
    explicit PlaneImages(S position = S(0)) : position_(position) {
        using std::isfinite;
        if (!isfinite(position)) {
            throw axistokes::InvalidArgument("position of the plane wall: must be finite");
        }
    }

    /// Distance from the wall.
    S gap(const axistokes::Point<S>& x) const { return x.z - position_; }

    /// Velocity at `target` that the images of a ring of forces through `source` cause, without the factor 1/(8 pi) and
    /// with the ring's radius. Either may lie on the wall, but not both in the same point. Throws InvalidArgument
    /// for points below the wall.
    axistokes::KernelBlock<S> correction(const axistokes::Point<S>& target, const axistokes::Point<S>& source) const {
        using std::sqrt;
        const S r0 = target.r;
        const S r = source.r;
        const S h = height_of(source);
        const S k = height_of(target);
        const S height = h + k;
        const axistokes::KernelBlock<S> image = stokeslet_.singular({r0, k}, {r, -h});

        const S big_d2 = (r + r0) * (r + r0) + height * height;
        const S m1 = ((r - r0) * (r - r0) + height * height) / big_d2;
        const S t = height * height / big_d2;
        const S difference = (r - r0) * (r + r0) / big_d2;
        const axistokes::RingIntegrals<S> ring = axistokes::ring_integrals(m1);
        const S s = 2 * (1 + m1) * ring.c + 3 * m1 * ring.h;
        const S a = 8 * (h / (m1 * big_d2)) * (k / m1) * (r / sqrt(big_d2));
        const S b = 2 * a * height / big_d2;
        const S along = (h - k) / height;
        return {-image.rr + a * (4 * r * r0 / big_d2) * ((m1 - 2 * (1 + m1) * t) * ring.c - 3 * t * m1 * ring.h),
                along * image.rz + b * r0 * (m1 * ring.c + (difference - t) * s),
                along * image.zr + b * r * (m1 * ring.c - (difference + t) * s),
                -image.zz + a * ((m1 * (1 + m1) - 2 * (1 + m1 + m1 * m1) * t) * ring.c +
                                 m1 * (2 * m1 - 3 * (1 + m1) * t) * ring.h)};
    }

  private:
    S height_of(const axistokes::Point<S>& x) const {
        if (!(gap(x) >= S(0))) {
            std::ostringstream message;
            message << "z = " << x.z << ": must be at least " << position_ << ", where the plane wall is";
            throw axistokes::InvalidArgument(message.str());
        }
        return gap(x);
    }

    axistokes::FreeSpaceKernel<S> stokeslet_;
    S position_;
};

}  // namespace write_your_own
