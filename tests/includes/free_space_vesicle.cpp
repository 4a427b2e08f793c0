// includes: membrane/vesicle
// omits: bessel|tube|fourier|gravity|poiseuille|rigid_body|gmres|explicit_euler
// SPDX-License-Identifier: MIT
#include <axistokes/discretization/linear_elements.hpp>
#include <axistokes/flow/quiescent.hpp>
#include <axistokes/kernel/free_space.hpp>
#include <axistokes/membrane/vesicle.hpp>
#include <axistokes/simulator.hpp>
#include <axistokes/solver/dense.hpp>
#include <axistokes/time/semi_implicit_euler.hpp>
