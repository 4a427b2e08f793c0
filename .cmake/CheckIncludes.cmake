# cmake -DCOMPILER=... -DINCLUDES=a|b -DIMPLICIT=c|d -DSOURCE=... -P CheckIncludes.cmake
#
# A scene pays for what it uses only: SOURCE, directly or indirectly, includes headers that match the regex of its first
# line, `// includes: <regex>`, and none that match that of its second, `// omits: <regex>` (CMake syntax; paths relative
# to include/, such as axistokes/core.hpp).
cmake_minimum_required(VERSION 3.21)

string(REPLACE "|" ";" INCLUDES "${INCLUDES}")
string(REPLACE "|" ";" IMPLICIT "${IMPLICIT}")
list(REMOVE_DUPLICATES INCLUDES)
if(IMPLICIT)
  # -isystem /usr/include would break the standard library's #include_next.
  list(REMOVE_ITEM INCLUDES ${IMPLICIT})
endif()
set(flags "")
foreach(directory IN LISTS INCLUDES)
  list(APPEND flags -isystem ${directory})
endforeach()

execute_process(
  COMMAND ${COMPILER} -std=c++20 -M ${flags} ${SOURCE}
  OUTPUT_VARIABLE output
  COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "/include/axistokes/[a-z_/.]+[.]hpp" headers "${output}")
list(TRANSFORM headers REPLACE "^/include/" "")
# clang++ prints axistokes/kernel/../special/elliptic.hpp.
list(TRANSFORM headers REPLACE "[a-z_]+/[.][.]/" "")
list(JOIN headers " " headers)
message("${headers}")

file(READ ${SOURCE} text)
if(NOT text MATCHES "^// includes: ([^\n]+)\n// omits: ([^\n]+)\n")
  message(FATAL_ERROR "${SOURCE}: the first two lines are not `// includes: <regex>` and `// omits: <regex>`")
endif()
set(included "${CMAKE_MATCH_1}")
set(omitted "${CMAKE_MATCH_2}")
if(NOT headers MATCHES "${included}")
  message(FATAL_ERROR "no header matches ${included}")
endif()
if(headers MATCHES "${omitted}")
  message(FATAL_ERROR "${CMAKE_MATCH_0} is included")
endif()
