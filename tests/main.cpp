// SPDX-License-Identifier: MIT
// main() of the tests for Catch2 version 2; version 3 brings its own, and this file is not compiled.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
