// SPDX-License-Identifier: MIT
// All backgrounds. A scene that wants one includes that one's header.
#pragma once

#include "gravity.hpp"
#include "poiseuille.hpp"
#include "quiescent.hpp"
#include "sum.hpp"
#include "unbounded_poiseuille.hpp"
