# cmake -DDOCUMENT=... -DDIRECTORY=... -P CheckListings.cmake
#
# The C++ blocks of the document are the headers of the directory, to the letter: each header is one, and there are no
# others.
cmake_minimum_required(VERSION 3.21)

file(READ ${DOCUMENT} document)
file(GLOB listings ${DIRECTORY}/*.hpp)
if(NOT listings)
  message(FATAL_ERROR "no header in ${DIRECTORY}")
endif()
foreach(listing IN LISTS listings)
  file(READ ${listing} text)
  set(block "```cpp\n${text}```\n")
  string(FIND "${document}" "${block}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "${DOCUMENT} does not contain ${listing}")
  endif()
  string(REPLACE "${block}" "" document "${document}")
endforeach()
if(document MATCHES "```c")
  message(FATAL_ERROR "${DOCUMENT} has a block of C++ that is no header of ${DIRECTORY}")
endif()
