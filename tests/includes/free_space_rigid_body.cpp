// includes: membrane/rigid_body
// omits: vesicle|bending|bessel|tube|fourier|poiseuille|gmres|time/
// SPDX-License-Identifier: MIT
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/gravity.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/rigid_body.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
