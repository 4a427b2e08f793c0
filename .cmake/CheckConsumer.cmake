# cmake -DMODE=find_package|add_subdirectory -DSOURCE_DIR=... -DBINARY_DIR=... -DWORK_DIR=... -DGENERATOR=...
#       -DCOMPILER=... -P CheckConsumer.cmake
#
# Configures, builds and runs tests/consumer against an installed axistokes or against its source tree.
cmake_minimum_required(VERSION 3.21)

# A leftover prefix would hide a header or a file that is no longer installed.
file(REMOVE_RECURSE ${WORK_DIR})

set(arguments -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=${COMPILER})
if(MODE STREQUAL "find_package")
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${WORK_DIR}/prefix OUTPUT_QUIET
                  COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND arguments -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
else()
  list(APPEND arguments -DAXISTOKES_SOURCE=${SOURCE_DIR})
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/consumer -B ${WORK_DIR}/build ${arguments}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/build/consumer COMMAND_ERROR_IS_FATAL ANY)
if(MODE STREQUAL "find_package")
  execute_process(COMMAND ${WORK_DIR}/build/vesicle COMMAND_ERROR_IS_FATAL ANY)
endif()
