# axistokes_require_package(<package> DEBIAN <name> [VERSION <minimum>] [OPTION <variable>])
#
# find_package that, on failure, says what to install and which option (if any) makes the package unnecessary.
# A macro: variables that find_package sets must reach the caller.
macro(axistokes_require_package package)
  cmake_parse_arguments(axistokes_require "" "DEBIAN;VERSION;OPTION" "" ${ARGN})
  find_package(${package} QUIET)
  set(axistokes_require_problem "")
  if(NOT ${package}_FOUND)
    set(axistokes_require_problem "was not found")
  elseif(axistokes_require_VERSION AND ${package}_VERSION VERSION_LESS axistokes_require_VERSION)
    # Not left to find_package: version files of some packages reject a newer major version.
    set(axistokes_require_problem "${axistokes_require_VERSION} or newer is needed, found ${${package}_VERSION}")
  endif()
  if(axistokes_require_problem)
    set(axistokes_require_advice "Debian package: ${axistokes_require_DEBIAN}")
    if(axistokes_require_OPTION)
      string(APPEND axistokes_require_advice "; or configure with -D${axistokes_require_OPTION}=OFF")
    endif()
    message(FATAL_ERROR "axistokes: ${package} ${axistokes_require_problem}. ${axistokes_require_advice}.")
  endif()
endmacro()
