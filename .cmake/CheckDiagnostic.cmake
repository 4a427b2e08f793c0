# cmake -DCOMPILER=... -DINCLUDES=a|b -DIMPLICIT=c|d -DSOURCE=... -P CheckDiagnostic.cmake
#
# A source named *_ok.cpp must compile. Any other must not: its first line is `// expect: <regex>` (CMake syntax), the
# regex must occur in the compiler's output, and the output must be readable: one or two errors.
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
  # LC_ALL=C: untranslated messages with ASCII quotes, whatever the user's locale.
  COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${COMPILER} -std=c++20 -fsyntax-only ${flags} ${SOURCE}
  RESULT_VARIABLE status
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
message("${output}")

if(SOURCE MATCHES "_ok\\.cpp$")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${SOURCE} must compile")
  endif()
  return()
endif()

file(READ ${SOURCE} text)
if(NOT text MATCHES "^// expect: ([^\n]+)")
  message(FATAL_ERROR "${SOURCE}: the first line is not `// expect: <regex>`")
endif()
set(expected "${CMAKE_MATCH_1}")

if(status EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles but must not")
endif()
if(NOT output MATCHES "${expected}")
  message(FATAL_ERROR "the message does not match the expected: ${expected}")
endif()
string(REGEX MATCHALL "error: " errors "${output}")
list(LENGTH errors count)
if(count LESS 1 OR count GREATER 2)
  message(FATAL_ERROR "the number of errors is ${count}: not one or two")
endif()
