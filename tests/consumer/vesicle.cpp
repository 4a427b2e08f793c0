// SPDX-License-Identifier: MIT
#include <axistokes/axistokes.hpp>

#ifndef AXISTOKES_COMPILED
#error "axistokes::compiled defines AXISTOKES_COMPILED"
#endif

int main() {
    using namespace axistokes;
    Simulator<TubeKernel<double>, LinearElements<double>, Vesicle<double>, Poiseuille<double>, SemiImplicitEuler,
              DenseLU<double>>
        simulator(shape_in_tube<double>(1.59, 0.9, SpheroidKind::prolate, 16), Poiseuille<double>(100, 0.9), {},
                  TubeKernel<double>(0.9));
    return simulator.step().velocity > 0 ? 0 : 1;
}
