# The preset `headers` installs without a build, and needs nothing that only programs and tests do.
# A tree that has something to build installs nothing before it is built, and says what to do.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result WORKING_DIRECTORY ${SOURCE})
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

set(options -G ${CMAKE_GENERATOR})
foreach(variable CMAKE_MAKE_PROGRAM CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS CMAKE_CXX_COMPILER_LAUNCHER
        CGAL_DIR TBB_DIR)
  if(NOT "${${variable}}" STREQUAL "")
    list(APPEND options "-D${variable}=${${variable}}")
  endif()
endforeach()

file(REMOVE_RECURSE ${SCRATCH})
set(not_needed -DCMAKE_DISABLE_FIND_PACKAGE_doctest=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
run(${CMAKE_COMMAND} --preset headers -B ${SCRATCH}/headers ${options} ${not_needed})
run(${CMAKE_COMMAND} --install ${SCRATCH}/headers --prefix ${SCRATCH}/prefix)
file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/include/*.h)
foreach(header IN LISTS headers)
  if(NOT EXISTS ${SCRATCH}/prefix/${header})
    message(FATAL_ERROR "${header} is not installed")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${SCRATCH}/user ${options}
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
run(${CMAKE_COMMAND} --build ${SCRATCH}/user)
file(READ ${SCRATCH}/user/compile_commands.json json)
string(JSON commands LENGTH "${json}")
math(EXPR last "${commands} - 1")
foreach(k RANGE ${last})
  string(JSON command GET "${json}" ${k} command)
  string(FIND "${command}" "contracting_user.dir" contracting)
  string(FIND "${command}" "-ffp-contract=off" off)
  if(contracting EQUAL -1 AND off EQUAL -1 OR NOT contracting EQUAL -1 AND NOT off EQUAL -1)
    message(FATAL_ERROR "-ffp-contract=off, or not, in the wrong place: ${command}")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/unbuilt ${options} -DPOWER_RTF_BUILD_TOOLS=ON
    -DPOWER_RTF_BUILD_TESTING=OFF -DPOWER_RTF_WITH_CUDA=OFF)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${SCRATCH}/unbuilt --prefix ${SCRATCH}/nothing
                RESULT_VARIABLE result ERROR_VARIABLE said)
if(result EQUAL 0 OR EXISTS ${SCRATCH}/nothing OR NOT said MATCHES "preset headers")
  message(FATAL_ERROR "an unbuilt tree was installed, or the reason is not said: ${said}")
endif()
