# Flags for the project's own executables. Nothing here reaches a consumer of axistokes::axistokes.

add_library(axistokes_warnings INTERFACE)
target_compile_options(axistokes_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(AXISTOKES_WARNINGS_AS_ERRORS)
  target_compile_options(axistokes_warnings INTERFACE -Werror)
endif()

add_library(axistokes_native INTERFACE)
if(AXISTOKES_NATIVE)
  target_compile_options(axistokes_native INTERFACE -march=native)
endif()
# The library and what links it must agree on this.
target_link_libraries(axistokes_compiled PUBLIC axistokes_native PRIVATE axistokes_warnings)
