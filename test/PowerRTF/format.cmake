# All C++ and CUDA files are formatted as .clang-format says, by the version of clang-format that the
# project has chosen: others format a few places otherwise.
# (`-DSOURCE=folder`, `-DCLANG_FORMAT=program`, empty: none was found)
cmake_minimum_required(VERSION 3.22)
set(version 14)

set(found "there is none")
if(CLANG_FORMAT)
  execute_process(COMMAND ${CLANG_FORMAT} --version OUTPUT_VARIABLE found
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(NOT found MATCHES "version ${version}\\.")
  message("skipped: this needs clang-format ${version} (Debian, Ubuntu: clang-format-${version}), "
          "and here: ${found}")
  return()
endif()

set(files)
foreach(folder include src cuda tools python test examples benchmark doc)
  foreach(extension h cpp cu cuh)
    file(GLOB_RECURSE more ${SOURCE}/${folder}/*.${extension})
    list(APPEND files ${more})
  endforeach()
endforeach()
list(LENGTH files count)
if(count LESS 100)
  message(FATAL_ERROR "only ${count} files in ${SOURCE}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "clang-format -i mends these files")
endif()
message(STATUS "${count} files")
