# A reader who has nothing but the README: a project of his own with the README's CMakeLists.txt and
# its program, with the lines that the README gives for a density of one's own, built and run
# against the installed package on INPUT.
file(READ ${README} readme)

# The first block of this language at or after the position.
function(readme_block language result)
  set(begin "```${language}\n")
  string(FIND "${readme}" "${begin}" from)
  if(from LESS 0)
    message(FATAL_ERROR "the README has no block ${language}")
  endif()
  string(LENGTH "${begin}" length)
  math(EXPR from "${from} + ${length}")
  string(SUBSTRING "${readme}" ${from} -1 rest)
  string(FIND "${rest}" "```" to)
  string(SUBSTRING "${rest}" 0 ${to} text)
  math(EXPR to "${to} + 3")
  string(SUBSTRING "${rest}" ${to} -1 rest)
  set(readme "${rest}" PARENT_SCOPE)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

readme_block(cpp program)
readme_block(cpp density)
readme_block(cmake project)

set(call "  const auto report = CGAL::power_rtf_remeshing(in, 3000, out);\n")
string(FIND "${program}" "${call}" found)
if(found LESS 0)
  message(FATAL_ERROR "the README's program has no line: ${call}")
endif()
string(REPLACE "${call}" "${density}" program "${program}")

set(SOURCE ${SCRATCH}_project)
file(REMOVE_RECURSE ${SOURCE})
file(WRITE ${SOURCE}/my_program.cpp "${program}")
file(WRITE ${SOURCE}/CMakeLists.txt "${project}")
set(PROGRAM my_program)
include(${CMAKE_CURRENT_LIST_DIR}/../find_package/test.cmake)

# The output: 3000 vertices, more of them where the density says so.
file(STRINGS ${SCRATCH}/build/output.off lines REGEX "^-?[0-9.e+-]+ -?[0-9.e+-]+ -?[0-9.e+-]+ *$")
set(vertices 0)
set(north 0)
foreach(line IN LISTS lines)
  if(line MATCHES "^[^ ]+ [^ ]+ ([^ ]+) *$")
    math(EXPR vertices "${vertices} + 1")
    if(NOT CMAKE_MATCH_1 MATCHES "^-")
      math(EXPR north "${north} + 1")
    endif()
  endif()
endforeach()
message(STATUS "${north} of ${vertices} vertices lie in the north")
if(vertices LESS 3000 OR vertices GREATER 3001 OR north LESS 1800) # 3001: with OFF's line of counts
  message(FATAL_ERROR "not what the density asks for")
endif()
