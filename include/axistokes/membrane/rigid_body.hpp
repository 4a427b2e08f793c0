// SPDX-License-Identifier: MIT
// Rigid body translating along the axis (a policy for the law of an interface).
#pragma once

#include "law.hpp"

#include <optional>

namespace axistokes {

/// Its traction f and velocity U obey u_inf + G f = U e_z. U is given, or follows from the balance of forces,
/// Int f_z dA = Int load_z dA (load: the pressure jump whose resultant is the weight).
template <class S = double>
struct RigidBody {
    using Scalar = S;
    static constexpr Constraint constraint = Constraint::rigid;

    /// Along z in the laboratory frame, in kappa/(eta R0^2).
    std::optional<S> velocity{};
};

}  // namespace axistokes
