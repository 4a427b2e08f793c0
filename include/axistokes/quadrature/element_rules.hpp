// SPDX-License-Identifier: MIT
// Which Gauss-Legendre rule an element needs for a target at a given distance.
//
// On the line through an element of length L the kernel's only singularity near the element is at the target x0, seen
// in the complexified parameter: the kernel is analytic in the ellipse whose foci are the element's ends and whose axis
// sum is rho = a + sqrt(a^2 - 1), a = (|x0 - x1| + |x0 - x2|)/L. Gauss-Legendre with n nodes errs by O(rho^(-2n)) times
// the integrand's growth on the ellipse (Trefethen, Approximation Theory and Practice, theorem 19.3), which is up to
// rho^2 for the ring's radius and a linear density, so n = 1 + log(1/tolerance) / (2 log rho).
#pragma once

#include "computed_once.hpp"
#include "gauss_legendre.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace axistokes {

template <class S>
class ElementRules {
  public:
    static constexpr Index smallest_order = 2;

    /// Rules for a relative error in [eps, 0.1], up to `at_least` nodes if the tolerance does not ask for more.
    explicit ElementRules(const S& tolerance, Index at_least = 4)
        : rules_(detail::computed_once<GaussLegendreTable<S>>(std::max(at_least, largest_order(tolerance)))) {
        using std::cosh;
        using std::log;
        // A half-axis sum a >= needed_[n] makes n nodes enough.
        const S digits = log(S(1) / tolerance);
        needed_.assign(2, std::numeric_limits<S>::infinity());
        for (Index n = 2; n <= rules_->largest(); ++n) {
            needed_.push_back(cosh(digits / S(2 * n - 2)));
        }
    }

    Index largest() const { return rules_->largest(); }
    const GaussLegendreRule<S>& operator[](Index n) const { return (*rules_)[n]; }

    /// Nodes of the rule for a target whose distances to the two ends of an element sum to `distance_sum`, or 0 if the
    /// element must be halved. NaN does not ask for halving, which would not end.
    Index order(const S& distance_sum, const S& length) const {
        for (Index n = smallest_order; n <= rules_->largest(); ++n) {
            if (!(distance_sum < needed_[static_cast<std::size_t>(n)] * length)) {
                return n;
            }
        }
        return 0;
    }

  private:
    /// A rule of p nodes reaches the tolerance when the target is no closer than half an element (a = sqrt 2 at least).
    static Index largest_order(const S& tolerance) {
        using std::log;
        const auto digits = static_cast<double>(log(S(1) / tolerance));
        return std::max<Index>(4, 2 * static_cast<Index>(std::ceil(digits / (4 * std::log(1.0 + std::sqrt(2.0))))) + 4);
    }

    std::shared_ptr<const GaussLegendreTable<S>> rules_;
    std::vector<S> needed_;
};

}  // namespace axistokes
