# axistokes::compiled: explicit instantiations for double (axistokes/compiled.hpp), compiled once by whoever links it, with
# the flags of that build: -march among others changes the layout of Eigen's types.
file(GLOB axistokes_compiled_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/compiled/*.cpp)
add_library(axistokes_compiled STATIC EXCLUDE_FROM_ALL ${axistokes_compiled_sources})
add_library(axistokes::compiled ALIAS axistokes_compiled)
target_link_libraries(axistokes_compiled PUBLIC axistokes::axistokes)
target_compile_definitions(axistokes_compiled INTERFACE AXISTOKES_COMPILED)
