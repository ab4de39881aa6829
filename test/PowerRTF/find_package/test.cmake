# Installs BUILD to a scratch prefix, then configures, builds and runs the program PROGRAM of the
# project in SOURCE against what was installed, in the folder of the build.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result WORKING_DIRECTORY ${SCRATCH}/build)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/build)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)

set(options)
foreach(variable CMAKE_MAKE_PROGRAM CMAKE_BUILD_TYPE CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS
        CMAKE_CXX_FLAGS_DEBUG CMAKE_CXX_COMPILER_LAUNCHER CGAL_DIR Eigen3_DIR TBB_DIR)
  if(NOT "${${variable}}" STREQUAL "")
    list(APPEND options "-D${variable}=${${variable}}")
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${CMAKE_GENERATOR}
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix ${options})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build --verbose)
if(INPUT)
  file(COPY_FILE ${INPUT} ${SCRATCH}/build/input.off)
endif()
run(${SCRATCH}/build/${PROGRAM})
