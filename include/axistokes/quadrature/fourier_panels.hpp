// SPDX-License-Identifier: MIT
// Nodes for Int_0^inf F(zeta) exp(i zeta x) dzeta along a ray, |x| <= range, where F has a logarithm at 0 and is
// analytic elsewhere near the ray.
//
// Panels double in length. A panel of length l with singularities no closer than b errs by rho^(-2n) max|integrand| on
// the ellipse of half-axis sum rho; the oscillation grows there by exp(range l (rho - 1/rho)/4). The n that suffices is
// the least over all rho the singularities allow:
//   n = min_rho [log(1/eps) + range l (rho - 1/rho)/4] / (2 log rho)                                              (1)
// which tends to range l/4 points, half a period each, for long panels. The first panel takes its logarithm by the
// product rule at the same nodes, exact to half the degree: twice the n of (1).
#pragma once

#include "gauss_legendre.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axistokes::detail {

/// Int F dzeta ~ sum weight F for F = smooth + log(zeta) logarithm: weight * smooth + log_weight * logarithm.
template <class S>
struct FourierNode {
    S zeta{};
    S weight{};
    S log_weight{};  // on the first panel; weight log(zeta) elsewhere
    bool first_panel = false;
};

/// On a ray of slope 1 an ellipse stays in the quadrant where the integrand is bounded up to this axis sum: its panel
/// is at most twice as long as it is far from 0, and 2 (rho^2 + rho^-2) <= 16.
inline constexpr double bounded_ratio = 2.8;

/// Eq. (1); `distance` is that of the nearest singularity from the panel's centre, at right angles to it.
inline double panel_nodes(double length, double range, double distance, double digits, double largest_ratio = 60) {
    const double half = length / 2;
    const double largest = distance / half + std::sqrt(1 + distance * distance / (half * half));
    double best = 1e9;
    for (double rho = 1.05; rho < std::min(largest, largest_ratio); rho *= 1.1) {
        best = std::min(best, (digits + range * length * (rho - 1 / rho) / 4) / (2 * std::log(rho)));
    }
    return best;
}

/// What is known of the integrand, all lengths inverse to zeta's.
struct FourierIntegrand {
    double range;   // largest |x|
    bool decays;    // along the ray exp(i zeta x) decays, and is bounded on the ellipses of all but the first panel
    double radius;  // distance from the ray to the nearest singularity other than 0
    double sector;  // that distance at zeta is at least sector * zeta
    double cut;     // the integrand is negligible past this zeta
};

template <class S>
std::vector<FourierNode<S>> fourier_nodes(const FourierIntegrand& f, double eps) {
    using std::log;
    constexpr Index most_nodes = 48;
    static const GaussLegendreTable<S> rules(most_nodes);
    const double digits = std::log(1 / eps);
    std::vector<FourierNode<S>> nodes;
    const auto add = [&](double begin, double length, double wanted, bool first) {
        const auto n = std::clamp<Index>(static_cast<Index>(std::ceil(wanted)), 2, most_nodes);
        const GaussLegendreRule<S>& rule = rules[n];
        for (Index q = 0; q < n; ++q) {
            const S zeta = S(begin) + S(length) * rule.nodes[q];
            const S weight = S(length) * rule.weights[q];
            const S log_weight =
                first ? S(weight * log(S(length)) + S(length) * rule.log_weights[q]) : S(weight * log(zeta));
            nodes.push_back({zeta, weight, log_weight, first});
        }
    };
    double begin = std::min({f.radius / 2, 4 / f.range, f.cut});
    const auto first = [&] { return 2 * panel_nodes(begin, f.range, f.radius, digits); };
    while (first() > most_nodes) {
        begin *= 0.8;
    }
    add(0, begin, first(), true);
    while (begin < f.cut) {
        double length = std::min(2 * begin, f.cut - begin);
        const auto wanted = [&] {
            return panel_nodes(length, f.decays ? 0 : f.range, std::max(f.radius, f.sector * (begin + length / 2)),
                               digits, f.decays ? bounded_ratio : 60);
        };
        while (wanted() > most_nodes) {
            length *= 0.8;
        }
        add(begin, length, wanted(), false);
        begin += length;
    }
    return nodes;
}

}  // namespace axistokes::detail
