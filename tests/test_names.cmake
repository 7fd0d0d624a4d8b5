# Fails where a test has a name that CMake or Catch would not take for one: at a ";" CMake splits it
# in two, neither of which is a test, and one that begins with "-" is an option to Catch. Such a
# test is never run, nor is one in a file that is not called ..._test.cpp.
#   cmake -DROOT=<source dir> -P tests/test_names.cmake
set(bad "")
set(names 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/tests/*.cpp ${ROOT}/tests/*.hpp)
# Quotes after a backslash are part of a name.
set(name "\"(([^\"\\]|[\\].)*)\"")
foreach(file IN LISTS files)
  file(READ ${ROOT}/${file} text)
  # CMake's own list of the matches is parted by ";", and held together by brackets.
  string(REPLACE ";" "<semicolon>" text "${text}")
  string(REPLACE "[" "<open>" text "${text}")
  string(REPLACE "]" "<close>" text "${text}")
  string(REGEX MATCHALL "(TEST_CASE|SCENARIO)\\([ \n]*${name}"
         tests "${text}")
  if(tests AND NOT file MATCHES "_test[.]cpp$")
    string(APPEND bad "  ${file}: is not called ..._test.cpp\n")
  endif()
  foreach(test IN LISTS tests)
    math(EXPR names "${names} + 1")
    if(test MATCHES "<semicolon>" OR test MATCHES "\\([ \n]*\"-")
      string(REGEX REPLACE "^[A-Z_]*\\([ \n]*" "" shown "${test}")
      string(APPEND bad "  ${file}: ${shown}\n")
    endif()
  endforeach()
endforeach()
if(names LESS 1000)
  message(FATAL_ERROR "only ${names} tests seen under ${ROOT}")
endif()
if(bad)
  string(REPLACE "<semicolon>" ";" bad "${bad}")
  message(FATAL_ERROR "tests that would not be run, for their file's name, or one that holds \";\" or begins with \"-\":\n${bad}")
endif()
