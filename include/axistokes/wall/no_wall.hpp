// SPDX-License-Identifier: MIT
// The policy for a scene whose only walls, if any, are those of its kernel.
#pragma once

#include "../core.hpp"

namespace axistokes {

struct NoWall {
    static constexpr bool present = false;
};

}  // namespace axistokes
