# cmake -DDOCUMENT=... -DLISTING=... -P CheckListing.cmake
#
# The document contains the listing to the letter.
cmake_minimum_required(VERSION 3.21)

file(READ ${DOCUMENT} document)
file(READ ${LISTING} listing)
string(FIND "${document}" "${listing}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "${DOCUMENT} does not contain ${LISTING}")
endif()
