# A reader who has nothing but the README: its program is that of the project in SOURCE, which is
# configured, built and run on INPUT against BUILD, installed to a scratch prefix; with the headers and
# with the compiled core, which write the same.
function(run folder)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result WORKING_DIRECTORY ${folder})
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}")
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
file(MAKE_DIRECTORY ${SCRATCH})
run(${SCRATCH} ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)

set(options "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG") # compiles in half the time
foreach(variable CMAKE_MAKE_PROGRAM CMAKE_BUILD_TYPE CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS
        CMAKE_CXX_FLAGS_DEBUG CMAKE_CXX_COMPILER_LAUNCHER CGAL_DIR TBB_DIR)
  if(NOT "${${variable}}" STREQUAL "")
    list(APPEND options "-D${variable}=${${variable}}")
  endif()
endforeach()

# build_and_run(target folder): with the target's library.
function(build_and_run target folder)
  file(READ ${SOURCE}/CMakeLists.txt project)
  string(REPLACE "PowerRTF::PowerRTF" ${target} project "${project}")
  file(WRITE ${folder}/CMakeLists.txt "${project}")
  file(COPY ${SOURCE}/user.cpp ${INPUT} DESTINATION ${folder})
  run(${folder} ${CMAKE_COMMAND} -S . -B . -G ${CMAKE_GENERATOR}
      -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix ${options})
  run(${folder} ${CMAKE_COMMAND} --build . --verbose)
  run(${folder} ${folder}/user)
endfunction()
build_and_run(PowerRTF::PowerRTF ${SCRATCH}/headers)
build_and_run(PowerRTF::core ${SCRATCH}/core)

file(STRINGS ${SCRATCH}/headers/output.off lines REGEX "^3000 [0-9]+ ")
if(NOT lines)
  message(FATAL_ERROR "output.off has not 3000 vertices")
endif()
run(${SCRATCH} ${CMAKE_COMMAND} -E compare_files headers/output.off core/output.off)
