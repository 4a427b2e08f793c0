// SPDX-License-Identifier: MIT
// Spectral discretisation: coordinates and densities are sine and cosine series through the nodes, integrated on panels
// of Gauss-Legendre points that know the kernel's singularity (docs/spectral.md, section 4).
//
// Fixed panels carry the points for targets far from them; a panel too close to a target is halved until the parts
// keep the distance the rule needs (the criterion of linear_elements.hpp). From a target on the panel itself a product
// rule takes the logarithm, on a part short enough to keep clear of the mirror point behind the axis; so the error is
// controlled near the axis as elsewhere.
#pragma once

#include "../geometry/spectral_geometry.hpp"
#include "../quadrature/gauss_legendre.hpp"
#include "../quadrature/regular_quadrature.hpp"
#include "spectral_panels.hpp"
#include "spectral_surface.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace axistokes {

/// Discretisation policy: trigonometric series.
template <class S = double>
class SpectralMeridian : public SpectralGeometry<S> {
  public:
    using Scalar = S;
    using Surface = SpectralSurface<S>;

    struct Params {
        /// Relative error allowed in the integrals, in (0, 0.1]; that of the series themselves depends on the degree.
        S tolerance = default_tolerance();
        SpectralMeshingParams<S> meshing;

        static S default_tolerance() {
            const S wanted = S(1e-10);
            const S reachable = 16 * std::numeric_limits<S>::epsilon();
            return wanted > reachable ? wanted : reachable;
        }
    };

    /// Throws InvalidArgument when the tolerance is not in (0, 0.1] or a meshing parameter is out of range.
    explicit SpectralMeridian(Params params = {})
        : SpectralGeometry<S>(params.meshing),
          params_(checked(std::move(params))),
          order_(order_for(params_.tolerance)),
          rule_(gauss_legendre<S>(order_)),
          singular_rule_(gauss_legendre<S>(2 * order_)) {
        using std::cosh;
        using std::log;
        needed_sum_ = cosh(log(S(1) / params_.tolerance) / S(2 * order_ - 2));
    }

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

    /// u = G f for targets at the nodes: G is 2n x 2n, f and u are stacked [r; z]; f is a force density (kappa/R0^3), u
    /// a velocity (kappa/(eta R0^2)). Includes the factor 1/(8 pi).
    template <class Kernel>
    Matrix<S> single_layer(const Meridian<S>& meridian, const Kernel& kernel) const {
        return Assembly<Kernel>(*this, meridian, meridian, kernel, true).matrix();
    }

    /// As single_layer, for targets anywhere (for a target on the curve, between the nodes, panels are halved towards
    /// it).
    template <class Kernel>
    Matrix<S> single_layer_at(const Meridian<S>& targets, const Meridian<S>& meridian, const Kernel& kernel) const {
        return Assembly<Kernel>(*this, targets, meridian, kernel, false).matrix();
    }

  private:
    static constexpr int deepest_halving = 45;
    static constexpr Index most_parts = 1024;
    /// Least half-axis sum towards the mirror point in the product rule: m1 < 0.12 on its part of the panel. Closer to
    /// the axis the kernel's split is a difference of steep polynomials in m1.
    static constexpr int mirror_clearance = 7;

    static Params checked(Params params) {
        detail::require(params.tolerance > S(0) && params.tolerance <= S(0.1), "quadrature tolerance", params.tolerance,
                        "in (0, 0.1]");
        return params;
    }

    /// Enough nodes for a target half a panel's length away from a panel, or on its axis 0.22 lengths past its end.
    static Index order_for(const S& tolerance) {
        using std::log;
        return std::max<Index>(4, 1 + static_cast<Index>(std::ceil(static_cast<double>(log(S(1) / tolerance)) / 1.84)));
    }

    static S distance(const Point<S>& a, const Point<S>& b) {
        using std::sqrt;
        return sqrt((a.r - b.r) * (a.r - b.r) + (a.z - b.z) * (a.z - b.z));
    }

    template <class Kernel>
    class Assembly {
      public:
        Assembly(const SpectralMeridian& rules, const Meridian<S>& targets, const Meridian<S>& m, const Kernel& kernel,
                 bool at_nodes)
            : rules_(rules),
              targets_(targets),
              meridian_(m),
              kernel_(kernel),
              at_nodes_(at_nodes),
              basis_(TrigonometricBasis<S>::of_degree(m.elements())),
              panels_(detail::computed_once<detail::SpectralPanels<S>>(m.elements(), rules.order_)),
              fixed_(m),
              moving_(m),
              z_series_(basis_->even_coefficients() * m.z),
              r_series_(basis_->odd_coefficients() * m.r) {
            fixed_.evaluate(panels_->t, panels_->cardinals);
            const Index order = rules.order_;
            for (Index p = 0; p <= panels_->count; ++p) {
                ends_.push_back(p == 0 || p == panels_->count ? Point<S>{S(0), m.z[p == 0 ? 0 : m.elements()]}
                                                              : at(panels_->boundary(p)));
                if (p < panels_->count) {
                    largest_speed_.push_back(fixed_.speed.segment(p * order, order).maxCoeff());
                }
            }
            sines_.resize(m.nodes());
            for (Index j = 0; j < m.nodes(); ++j) {
                sines_[j] = basis_->sine(j);
            }
        }

        Matrix<S> matrix() {
            const Index rows = targets_.nodes();
            const Index n = meridian_.nodes();
            const Index order = rules_.order_;
            Matrix<S> g = Matrix<S>::Zero(2 * rows, 2 * n);
            far_.set_zero(panels_->t.size(), rows);
            for (Index i = 0; i < rows; ++i) {
                target_ = {targets_.r[i], targets_.z[i]};
                t_.clear();
                weights_.clear();
                logs_.clear();
                singular_ = 0;
                Index run = 0;
                for (Index p = 0; p < panels_->count; ++p) {
                    if (!take_apart(i, p)) {
                        continue;
                    }
                    evaluate_far(i, run * order, p * order);
                    run = p + 1;
                }
                evaluate_far(i, run * order, panels_->count * order);
                add_near(i, g);
            }
            add_far(g);
            g *= S(1) / (8 * detail::pi_value<S>());
            if constexpr (Kernel::has_images) {
                add_regular_part(g);
            }
            return g;
        }

      private:
        Point<S> at(const S& t) const {
            return {detail::sine_series<S>(r_series_, t), detail::cosine_series<S>(z_series_, t)};
        }

        /// Whether panel p is close to target i; its points then are added to the near ones.
        bool take_apart(Index i, Index p) {
            const S begin = panels_->boundary(p);
            const S end = panels_->boundary(p + 1);
            const auto index = static_cast<std::size_t>(p);
            speed_ = largest_speed_[index];
            if (at_nodes_) {
                // Node i against the panel's ends, exactly: t_i = pi i/N, the ends are pi p/count.
                const Index after_begin = i * panels_->count - p * meridian_.elements();
                const Index before_end = (p + 1) * meridian_.elements() - i * panels_->count;
                if (after_begin >= 0 && before_end >= 0) {
                    const S here = basis_->nodes()[i];
                    if (after_begin > 0) {
                        add_singular(here, begin, ends_[index]);
                    }
                    if (before_end > 0) {
                        add_singular(here, end, ends_[index + 1]);
                    }
                    return true;
                }
            }
            if (far(begin, end, ends_[index], ends_[index + 1])) {
                return false;
            }
            add_part(begin, end, ends_[index], ends_[index + 1], 0);
            return true;
        }

        /// NaN counts as far: halving would not end.
        bool far(const S& begin, const S& end, const Point<S>& first, const Point<S>& last) const {
            using std::abs;
            return !(distance(target_, first) + distance(target_, last) <
                     rules_.needed_sum_ * speed_ * abs(end - begin));
        }

        /// [begin, end] of a panel, halved until the target is far enough from all parts. Regular points come after
        /// those of the product rules.
        void add_part(const S& begin, const S& end, const Point<S>& first, const Point<S>& last, int depth) {
            using std::abs;
            if (far(begin, end, first, last) || depth == deepest_halving) {
                const GaussLegendreRule<S>& rule = rules_.rule_;
                for (Index q = 0; q < rule.nodes.size(); ++q) {
                    t_.push_back(begin + (end - begin) * rule.nodes[q]);
                    weights_.push_back(abs(end - begin) * rule.weights[q]);
                }
                return;
            }
            const S middle = (begin + end) / 2;
            const Point<S> half = at(middle);
            add_part(begin, middle, first, half, depth + 1);
            add_part(middle, end, half, last, depth + 1);
        }

        /// From the target's own parameter `here` to `end`: the product rule on a part of it, the rest is regular.
        void add_singular(const S& here, const S& end, const Point<S>& last) {
            using std::abs;
            using std::log;
            S cut = end;
            Point<S> there = last;
            const Point<S> mirror{-target_.r, target_.z};
            if (target_.r > S(0)) {
                const auto reaches_mirror = [&] {
                    return 2 * target_.r + distance(mirror, there) < mirror_clearance * distance(target_, there);
                };
                for (int depth = 0; depth < deepest_halving && reaches_mirror(); ++depth) {
                    cut = here + (cut - here) / 2;
                    there = at(cut);
                }
            }
            const GaussLegendreRule<S>& rule = rules_.singular_rule_;
            const auto position = static_cast<std::ptrdiff_t>(singular_);
            std::vector<S> t;
            std::vector<S> weights;
            for (Index q = 0; q < rule.nodes.size(); ++q) {
                t.push_back(here + (cut - here) * rule.nodes[q]);
                weights.push_back(abs(cut - here) * rule.weights[q]);
                // Int f log(tau^2) in terms of f at the nodes, less log(tau^2) itself: that is part of log m1.
                logs_.push_back(2 * rule.log_weights[q] / rule.weights[q] - 2 * log(rule.nodes[q]));
            }
            t_.insert(t_.begin() + position, t.begin(), t.end());
            weights_.insert(weights_.begin() + position, weights.begin(), weights.end());
            singular_ += static_cast<Index>(t.size());
            if (cut != end) {
                add_part(cut, end, there, last, 0);
            }
        }

        void evaluate_far(Index i, Index begin, Index end) {
            if (begin < end) {
                kernel_.singular(target_, &fixed_.r[begin], &fixed_.z[begin], end - begin, far_.arrays(begin, i));
            }
        }

        void add_far(Matrix<S>& g) {
            const Index rows = targets_.nodes();
            const Index n = meridian_.nodes();
            const Vector<S> weights = panels_->weights.cwiseProduct(fixed_.speed);
            const Vector<S> odd = weights.cwiseProduct(fixed_.inverse_sine);
            const Matrix<S> even_side = weights.asDiagonal() * panels_->cardinals.transpose();
            const Matrix<S> odd_side = odd.asDiagonal() * panels_->cardinals.transpose() * sines_.asDiagonal();
            g.topLeftCorner(rows, n).noalias() += far_.rr.transpose() * odd_side;
            g.topRightCorner(rows, n).noalias() += far_.rz.transpose() * even_side;
            g.bottomLeftCorner(rows, n).noalias() += far_.zr.transpose() * odd_side;
            g.bottomRightCorner(rows, n).noalias() += far_.zz.transpose() * even_side;
        }

        void add_near(Index i, Matrix<S>& g) {
            const auto count = static_cast<Index>(t_.size());
            if (count == 0) {
                return;
            }
            const Index n = meridian_.nodes();
            const Vector<S> t = Eigen::Map<const Vector<S>>(t_.data(), count);
            cardinals_.resize(n, count);
            for (Index q = 0; q < count; ++q) {
                basis_->cardinals(t[q], cardinals_.col(q));
            }
            moving_.evaluate(t, cardinals_);
            near_.resize(count, 1);
            if (count > singular_) {
                kernel_.singular(target_, &moving_.r[singular_], &moving_.z[singular_], count - singular_,
                                 near_.arrays(singular_, 0));
            }
            if (singular_ > 0) {
                add_logarithm();
            }
            Matrix<S> scaled(count, 4);  // rr, zr for the odd densities, rz, zz for the even ones
            const Vector<S> even = Eigen::Map<const Vector<S>>(weights_.data(), count).cwiseProduct(moving_.speed);
            const Vector<S> odd = even.cwiseProduct(moving_.inverse_sine);
            scaled.col(0) = near_.rr.col(0).cwiseProduct(odd);
            scaled.col(1) = near_.zr.col(0).cwiseProduct(odd);
            scaled.col(2) = near_.rz.col(0).cwiseProduct(even);
            scaled.col(3) = near_.zz.col(0).cwiseProduct(even);
            const Matrix<S> row = cardinals_ * scaled;
            const Index rows = targets_.nodes();
            g.row(i).head(n) = row.col(0).cwiseProduct(sines_).transpose();
            g.row(i).tail(n) = row.col(2).transpose();
            g.row(rows + i).head(n) = row.col(1).cwiseProduct(sines_).transpose();
            g.row(rows + i).tail(n) = row.col(3).transpose();
        }

        /// M = smooth + log_coefficient log m1 at the points of the product rules, with the rule's own log tau^2.
        void add_logarithm() {
            using std::log;
            log_.resize(singular_, 1);
            kernel_.singular_split(target_, moving_.r.data(), moving_.z.data(), singular_, near_.arrays(0, 0),
                                   log_.arrays(0, 0));
            for (Index q = 0; q < singular_; ++q) {
                const S dr = moving_.r[q] - target_.r;
                const S sum = moving_.r[q] + target_.r;
                const S dz = moving_.z[q] - target_.z;
                const S factor = log((dr * dr + dz * dz) / (sum * sum + dz * dz)) + logs_[static_cast<std::size_t>(q)];
                near_.rr(q, 0) += factor * log_.rr(q, 0);
                near_.rz(q, 0) += factor * log_.rz(q, 0);
                near_.zr(q, 0) += factor * log_.zr(q, 0);
                near_.zz(q, 0) += factor * log_.zz(q, 0);
            }
        }

        /// The kernel's smooth part, for all targets at once: from points on the curve first, as r and z components
        /// are interpolated differently. Its singularities are the targets' images, as far behind the wall as the
        /// targets, at least `nearest`, are before it: panels are halved as for targets abreast of their middles.
        void add_regular_part(Matrix<S>& g) {
            using std::isfinite;
            using std::sqrt;
            const S nearest = least_gap(targets_.r, targets_.z);
            if (!isfinite(nearest)) {
                return;
            }
            t_.clear();
            weights_.clear();
            const Index order = rules_.order_;
            for (Index p = 0; p < panels_->count; ++p) {
                const S closest = least_gap(fixed_.r.segment(p * order, order), fixed_.z.segment(p * order, order)) +
                                  std::max<S>(nearest, S(0));
                const S width = panels_->boundary(p + 1) - panels_->boundary(p);
                const S length = largest_speed_[static_cast<std::size_t>(p)] * width;
                Index parts = 1;
                const auto too_long = [&](const S& part) {
                    return 2 * sqrt(part * part / 4 + closest * closest) < rules_.needed_sum_ * part;
                };
                while (too_long(length / S(parts)) && parts < most_parts) {
                    parts *= 2;
                }
                for (Index k = 0; k < parts; ++k) {
                    for (Index q = 0; q < order; ++q) {
                        t_.push_back(panels_->boundary(p) + width * (S(k) + rules_.rule_.nodes[q]) / S(parts));
                        weights_.push_back(width * rules_.rule_.weights[q] / S(parts));
                    }
                }
            }
            const auto count = static_cast<Index>(t_.size());
            const Index n = meridian_.nodes();
            const Vector<S> t = Eigen::Map<const Vector<S>>(t_.data(), count);
            cardinals_.resize(n, count);
            for (Index q = 0; q < count; ++q) {
                basis_->cardinals(t[q], cardinals_.col(q));
            }
            moving_.evaluate(t, cardinals_);
            const Vector<S> even = Eigen::Map<const Vector<S>>(weights_.data(), count).cwiseProduct(moving_.speed) /
                                   (8 * detail::pi_value<S>());
            RegularQuadrature<S> points{{moving_.r, moving_.z}, moving_.z, {}};
            points.weights.resize(count, count);
            points.weights.setIdentity();
            const Index rows = targets_.nodes();
            Matrix<S> m = Matrix<S>::Zero(2 * rows, 2 * count);
            kernel_.regular(
                targets_, [&](const S&) { return points; }, m);
            const Vector<S> odd = even.cwiseProduct(moving_.inverse_sine);
            g.leftCols(n) += m.leftCols(count) * (odd.asDiagonal() * cardinals_.transpose() * sines_.asDiagonal());
            g.rightCols(n) += m.rightCols(count) * (even.asDiagonal() * cardinals_.transpose());
        }

        S least_gap(const Eigen::Ref<const Vector<S>>& r, const Eigen::Ref<const Vector<S>>& z) const {
            S least = kernel_.gap({r[0], z[0]});
            for (Index i = 1; i < r.size(); ++i) {
                least = std::min<S>(least, kernel_.gap({r[i], z[i]}));
            }
            return least;
        }

        const SpectralMeridian& rules_;
        const Meridian<S>& targets_;
        const Meridian<S>& meridian_;
        const Kernel& kernel_;
        bool at_nodes_;
        std::shared_ptr<const TrigonometricBasis<S>> basis_;
        std::shared_ptr<const detail::SpectralPanels<S>> panels_;
        detail::SpectralCurvePoints<S> fixed_;
        detail::SpectralCurvePoints<S> moving_;
        Vector<S> z_series_;
        Vector<S> r_series_;
        Vector<S> sines_;
        std::vector<Point<S>> ends_;
        std::vector<S> largest_speed_;

        // Of the present target.
        Point<S> target_;
        S speed_{};  // largest on the present panel
        std::vector<S> t_;
        std::vector<S> weights_;
        std::vector<S> logs_;
        Index singular_ = 0;  // points of product rules, the first ones
        Matrix<S> cardinals_;
        detail::EntryMatrices<S> near_;
        detail::EntryMatrices<S> log_;
        detail::EntryMatrices<S> far_;
    };

    Params params_;
    Index order_;
    GaussLegendreRule<S> rule_;
    GaussLegendreRule<S> singular_rule_;
    S needed_sum_{};
};

}  // namespace axistokes
