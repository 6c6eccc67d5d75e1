# Adds one test for each suite of a GoogleTest program, when ctest starts: tests of a suite share its set-up, and the program starts
# once for all of them. A generated file includes it with
#   PROGRAM      path of the program
#   PREFIX       what stands before a suite's name
#   PROPERTIES   of each test
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE result ERROR_QUIET)
if(NOT result EQUAL 0)
  get_filename_component(name ${PROGRAM} NAME)
  add_test(${PREFIX}${name}_NOT_BUILT ${PROGRAM})
  return()
endif()
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." suites "${listed}")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
  add_test(${PREFIX}${suite} ${PROGRAM} --gtest_filter=${suite}.*)
  set_tests_properties(${PREFIX}${suite} PROPERTIES ${PROPERTIES})
endforeach()
