# A reader who has nothing but the README: its program is that of the project in SOURCE, which is
# configured, built and run on INPUT against BUILD, installed to a scratch prefix.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result WORKING_DIRECTORY ${SCRATCH}/build)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

file(READ ${README} readme)
file(READ ${SOURCE}/user.cpp program)
string(REGEX REPLACE "^//[^\n]*\n" "" program "${program}")
string(FIND "${readme}" "```cpp\n${program}```" found)
if(found LESS 0)
  message(FATAL_ERROR "the README's program is not ${SOURCE}/user.cpp")
endif()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/build)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)

set(options)
foreach(variable CMAKE_MAKE_PROGRAM CMAKE_BUILD_TYPE CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS
        CMAKE_CXX_FLAGS_DEBUG CMAKE_CXX_COMPILER_LAUNCHER CGAL_DIR TBB_DIR)
  if(NOT "${${variable}}" STREQUAL "")
    list(APPEND options "-D${variable}=${${variable}}")
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${CMAKE_GENERATOR}
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix ${options})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build --verbose)
file(COPY_FILE ${INPUT} ${SCRATCH}/build/input.off)
run(${SCRATCH}/build/user)

file(STRINGS ${SCRATCH}/build/output.off lines REGEX "^3000 [0-9]+ ")
if(NOT lines)
  message(FATAL_ERROR "output.off has not 3000 vertices")
endif()
