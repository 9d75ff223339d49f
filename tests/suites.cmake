# CTest itself includes this file, which makes tests of the suites in PROGRAM, the unit tests of the
# package NAME. TOGETHER is the number of suites that share a test, and with it a process. Suites
# whose names match LEFT_OUT, with that of the package, are left out. The tests of a suite stay
# together, so that what they share is made once. The names are read when CTest runs, so that a
# crash in a static object fails a test, not the build.

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
list(LENGTH suites left)
set(first 0)
while(first LESS left)
  list(SUBLIST suites ${first} ${TOGETHER} some)
  math(EXPR first "${first} + ${TOGETHER}")
  list(GET some 0 test)
  list(LENGTH some count)
  if(count GREATER 1)
    math(EXPR others "${count} - 1")
    string(APPEND test "_and_${others}_more")
  endif()
  list(TRANSFORM some REPLACE "^${NAME}\\.(.*)$" "\\1.*")
  string(JOIN ":" filter ${some})
  add_test(${test} ${PROGRAM} --gtest_brief=1 --gtest_filter=${filter})
  # A processor is two slots: see tests/CMakeLists.txt.
  set_tests_properties(${test} PROPERTIES LABELS unit TIMEOUT 900 PROCESSORS 2)
endwhile()
