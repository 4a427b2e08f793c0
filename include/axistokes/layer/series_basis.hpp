// SPDX-License-Identifier: MIT
// Sine and cosine series through the nodes of a meridian, as a basis of a layer (layer_engine.hpp; docs/spectral.md,
// section 4). Panels are equal parts of [0, pi].
#pragma once

#include "../geometry/trigonometric.hpp"
#include "layer_engine.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace axistokes::detail {

/// The panels for series of a degree: their points, and the cardinal functions there.
template <class S>
struct SeriesPanels {
    /// Points per degree: the highest mode itself is integrated to a few digits, what is resolved to all.
    static constexpr double density = 2.5;

    SeriesPanels(Index degree, Index order) {
        const auto basis = TrigonometricBasis<S>::of_degree(degree);
        const auto wanted = density * static_cast<double>(degree);
        count = std::max<Index>(4, static_cast<Index>(std::ceil(wanted / static_cast<double>(order))));
        const GaussLegendreRule<S> rule = gauss_legendre<S>(order);
        for (Index p = 0; p < count; ++p) {
            points.add(p, boundary(p), boundary(p + 1), rule);
        }
        points.shares.resize(points.t.size() * static_cast<std::size_t>(basis->size()));
        for (Index q = 0; q < points.size(); ++q) {
            basis->cardinals(points.t[static_cast<std::size_t>(q)],
                             Eigen::Map<Vector<S>>(points.shares.data() + q * basis->size(), basis->size()));
        }
    }

    S boundary(Index panel) const { return pi_value<S>() * S(panel) / S(count); }

    Index count;
    LayerPoints<S> points;
};

template <class S>
class SeriesBasis {
  public:
    /// `order` points a panel; `rules` has them up to twice that.
    SeriesBasis(const Meridian<S>& m, const ElementRules<S>& rules, Index order)
        : degree_(m.elements()),
          rules_(rules),
          order_(order),
          basis_(TrigonometricBasis<S>::of_degree(degree_)),
          panels_(computed_once<SeriesPanels<S>>(degree_, order)),
          r_series_(basis_->odd_coefficients() * m.r),
          z_series_(basis_->even_coefficients() * m.z),
          nodal_(m.nodes(), 4),
          last_slope_(-S(degree_) * z_series_[degree_]),
          sines_(m.nodes()) {
        for (Index j = 0; j < m.nodes(); ++j) {
            sines_[j] = basis_->sine(j);
        }
        nodal_.col(0) = m.z;
        nodal_.col(1) = m.r.cwiseProduct(sines_);
        nodal_.col(2) = basis_->odd_first() * m.r;
        nodal_.col(3) = (basis_->even_first() * m.z).cwiseProduct(sines_);
        const LayerPoints<S> points = fixed(false);
        largest_speed_ = Vector<S>::Zero(panels_->count);
        for (std::size_t q = 0; q < points.t.size(); ++q) {
            const S speed = points.weight[q] / panels_->points.weight[q];
            largest_speed_[points.panel[q]] = std::max(largest_speed_[points.panel[q]], speed);
        }
    }

    Index size() const { return degree_ + 1; }
    Index panels() const { return panels_->count; }
    const ElementRules<S>& rules() const { return rules_; }
    Index least_order() const { return order_; }
    Index most_order() const { return order_; }
    Index least_product_order() const { return 2 * order_; }

    S begin(Index panel) const { return panels_->boundary(panel); }
    S end(Index panel) const { return panels_->boundary(panel + 1); }
    Point<S> position(Index, const S& t) const {
        return {sine_series<S>(r_series_, t), cosine_series<S>(z_series_, t)};
    }
    S length(Index panel, const S& begin, const Point<S>&, const S& end, const Point<S>&) const {
        using std::abs;
        return largest_speed_[panel] * abs(end - begin);
    }

    Index fixed_order() const { return order_; }
    LayerPoints<S> fixed(bool normals) const {
        LayerPoints<S> points = panels_->points;
        add_geometry(points, normals);
        return points;
    }

    std::vector<PanelSide<S>> sides(Index node) const {
        std::vector<PanelSide<S>> result;
        const S& t = basis_->nodes()[node];
        for (Index p = 0; p < panels(); ++p) {
            // Node i against the panel's ends, exactly: t_i = pi i/N, the ends are pi p/count.
            const Index after_begin = node * panels() - p * degree_;
            const Index before_end = (p + 1) * degree_ - node * panels();
            if (after_begin > 0 && before_end >= 0) {
                result.push_back({p, t, begin(p)});
            }
            if (after_begin >= 0 && before_end > 0) {
                result.push_back({p, t, end(p)});
            }
        }
        return result;
    }

    void evaluate(LayerPoints<S>& points, bool normals) const {
        points.shares.resize(points.t.size() * static_cast<std::size_t>(size()));
        for (Index q = 0; q < points.size(); ++q) {
            basis_->cardinals(points.t[static_cast<std::size_t>(q)],
                              Eigen::Map<Vector<S>>(points.shares.data() + q * size(), size()));
        }
        add_geometry(points, normals);
    }

    /// An odd series has the cardinal functions of the even one times sin t_j/sin t.
    void spread(const LayerPoints<S>& points, const Matrix<S>& entries, Eigen::Ref<Matrix<S>> to) const {
        const Index count = points.size();
        const Index columns = entries.cols();
        const Vector<S> even = vector(points.weight);
        const Vector<S> odd = even.cwiseQuotient(sine(points));
        Matrix<S> scaled(count, 2 * columns);
        for (Index c = 0; c < columns; ++c) {
            scaled.col(c) = entries.col(c).head(count).cwiseProduct(odd);
            scaled.col(columns + c) = entries.col(c).tail(count).cwiseProduct(even);
        }
        const Matrix<S> sum = cardinals(points) * scaled;
        for (Index c = 0; c < columns; ++c) {
            to.col(c).head(size()) += sum.col(c).cwiseProduct(sines_);
            to.col(c).tail(size()) += sum.col(columns + c);
        }
    }

  private:
    static Eigen::Map<const Vector<S>> vector(const std::vector<S>& values) {
        return {values.data(), static_cast<Index>(values.size())};
    }
    Eigen::Map<const Matrix<S>> cardinals(const LayerPoints<S>& points) const {
        return {points.shares.data(), size(), points.size()};
    }
    static Vector<S> sine(const LayerPoints<S>& points) { return vector(points.t).array().sin().matrix(); }

    /// The odd cardinal functions miss sin Nt, which vanishes at all nodes: the slope of z has it.
    void add_geometry(LayerPoints<S>& points, bool normals) const {
        using std::sin;
        using std::sqrt;
        const std::size_t count = points.t.size();
        const Matrix<S> values = cardinals(points).transpose() * nodal_;
        const Vector<S> sines = sine(points);
        for (std::vector<S>* coordinate : {&points.r, &points.z}) {
            coordinate->resize(count);
        }
        if (normals) {
            points.normal_r.resize(count);
            points.normal_z.resize(count);
        }
        for (std::size_t k = 0; k < count; ++k) {
            const auto q = static_cast<Index>(k);
            points.z[k] = values(q, 0);
            points.r[k] = values(q, 1) / sines[q];
            const S& r1 = values(q, 2);
            const S z1 = values(q, 3) / sines[q] + last_slope_ * sin(S(S(degree_) * points.t[k]));
            const S speed = sqrt(S(r1 * r1 + z1 * z1));
            points.weight[k] *= speed;
            if (normals) {
                points.normal_r[k] = z1 / speed;
                points.normal_z[k] = -r1 / speed;
            }
        }
    }

    Index degree_;
    const ElementRules<S>& rules_;
    Index order_;
    std::shared_ptr<const TrigonometricBasis<S>> basis_;
    std::shared_ptr<const SeriesPanels<S>> panels_;
    Vector<S> r_series_;
    Vector<S> z_series_;
    Matrix<S> nodal_;  // z, r sin t, r', z' sin t
    S last_slope_;
    Vector<S> sines_;
    Vector<S> largest_speed_;  // on each panel
};

}  // namespace axistokes::detail
