// SPDX-License-Identifier: MIT
#include <axistokes/core.hpp>

int main() {
    const axistokes::Point<double> point{1.0, 2.0};
    const axistokes::Vector<double> ones = axistokes::Vector<double>::Ones(3);
    return point.r + point.z == ones.sum() ? 0 : 1;
}
