# Flags for the project's own executables. Nothing here reaches a consumer of axistokes::axistokes.

add_library(axistokes_warnings INTERFACE)
target_compile_options(axistokes_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(AXISTOKES_WARNINGS_AS_ERRORS)
  target_compile_options(axistokes_warnings INTERFACE -Werror)
endif()

# -O3 costs a fifth more of the compile time than -O2, and no program here runs faster for it.
add_compile_options($<$<CONFIG:Release>:-O2>)

# What is built runs on processors like this one. The kernels take half of the time with AVX2. The tests do without.
add_library(axistokes_native INTERFACE)
if(AXISTOKES_NATIVE)
  target_compile_options(axistokes_native INTERFACE -march=native)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 takes what its own AVX-512 intrinsics leave undefined on purpose for forgotten.
    target_compile_options(axistokes_native INTERFACE -Wno-uninitialized -Wno-maybe-uninitialized)
  endif()
endif()
# The library and what links it must agree on this.
target_link_libraries(axistokes_compiled PUBLIC axistokes_native PRIVATE axistokes_warnings)

# Fuzzing (tests/fuzz): everything is instrumented, so that the fuzzer sees where inputs lead.
option(AXISTOKES_FUZZ "Build the fuzz targets and all else with libFuzzer's instrumentation and sanitizers (clang++)" OFF)
if(AXISTOKES_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "AXISTOKES_FUZZ needs clang++: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  set(axistokes_fuzz_flags -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer -g)
  add_compile_options(${axistokes_fuzz_flags})
  add_link_options(${axistokes_fuzz_flags})
endif()
