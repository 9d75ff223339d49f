# Included by CTest itself, with NAME and PROGRAM set: makes one test of each suite of the unit
# tests in PROGRAM. A suite is a process, so that what its tests share is made once. The names are
# read when CTest runs, so that a crash in a static object fails a test, not the build.

execute_process(COMMAND ${PROGRAM} --gtest_list_tests
                OUTPUT_VARIABLE list RESULT_VARIABLE code)
string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${list}")
if(code OR NOT suites)
  # The test that says so runs the whole program.
  set(suites "\n*.")
endif()
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n(.*)\\.$" "\\1" suite "${suite}")
  add_test(${NAME}.${suite} ${PROGRAM} --gtest_brief=1 --gtest_filter=${suite}.*)
  # A processor is two slots: see tests/CMakeLists.txt.
  set_tests_properties(${NAME}.${suite} PROPERTIES LABELS unit TIMEOUT 900 PROCESSORS 2)
endforeach()
