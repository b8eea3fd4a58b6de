# Ends the build if the test program has a suite that no entry of CTest runs, or an entry names none.
# TESTS: the program; SUITES: the names of the entries, separated by |.
execute_process(COMMAND "${TESTS}" --list-test-suites --no-colors=true
    OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "${TESTS} --list-test-suites ended with ${status}")
endif()
string(REGEX MATCHALL "[^\n]+" listed "${listed}")
list(FILTER listed EXCLUDE REGEX "^(\\[doctest\\]|device: |=+$)")
string(REPLACE "|" ";" suites "${SUITES}")
list(SORT listed)
list(SORT suites)
if(NOT listed STREQUAL suites)
    message(FATAL_ERROR "suites of the program:\n  ${listed}\nentries in tests/gpu/CMakeLists.txt:\n  ${suites}")
endif()
