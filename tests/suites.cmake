# CTest itself includes this file, which makes a test of each suite in PROGRAM, the unit tests of the
# room NAME. Suites whose names match LEFT_OUT, with that of the room, are left out. The tests of a
# suite stay together, so that what they share is made once. The names are read when CTest runs, so
# that a crash in a static object fails a test, not the build.

execute_process(COMMAND ${PROGRAM} --gtest_list_tests
                OUTPUT_VARIABLE list RESULT_VARIABLE code)
string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${list}")
if(code OR NOT suites)
  # The test that says so runs the whole program.
  set(suites "\n*.")
endif()
list(TRANSFORM suites REPLACE "^\n(.*)\\.$" "${NAME}.\\1")
if(LEFT_OUT)
  list(FILTER suites EXCLUDE REGEX "${LEFT_OUT}")
endif()
foreach(test IN LISTS suites)
  string(REGEX REPLACE "^${NAME}\\.(.*)$" "\\1" suite ${test})
  add_test(${test} ${PROGRAM} --gtest_brief=1 --gtest_filter=${suite}.*)
  # A processor is two slots: see tests/CMakeLists.txt.
  set_tests_properties(${test} PROPERTIES LABELS unit TIMEOUT 900 PROCESSORS 2)
endforeach()
