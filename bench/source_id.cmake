# Writes which sources a program is built of into a header, where that changed since.
#     cmake -DROOT=<sources> -DHEADER=<file> -P bench/source_id.cmake
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${ROOT}
  OUTPUT_VARIABLE source_id OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT source_id)
  set(source_id "source unknown")
endif()
set(text "#pragma once\n\n#define RVBENCH_SOURCE_ID \"${source_id}\"\n")
set(before "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${HEADER} "${text}")
endif()
