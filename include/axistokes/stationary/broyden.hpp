// SPDX-License-Identifier: MIT
// What the correctors of Newton's method and of continuation learn on the way: Broyden, Math. Comp. 19 (1965) 577.
#pragma once

#include "../core.hpp"

namespace axistokes::detail {

/// The least correction of a derivative after which it maps `step` to the change that was found.
template <class S>
void learn(Matrix<S>& derivative, const Vector<S>& step, const Vector<S>& change) {
    const Vector<S> missed = change - derivative * step;
    derivative += missed * step.transpose() / step.squaredNorm();
}

}  // namespace axistokes::detail
