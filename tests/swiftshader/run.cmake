# Runs the test cases CASES of the program TESTS on the driver that MANIFEST describes, and on no other.
if(NOT EXISTS "${MANIFEST}")
    if("$ENV{CI}" STREQUAL "true")
        message(FATAL_ERROR "SwiftShader is not there: run tools/dev/fetch-swiftshader")
    endif()
    message("skipped: SwiftShader is not there, tools/dev/fetch-swiftshader fetches it")
    return()
endif()
set(ENV{VK_DRIVER_FILES} "${MANIFEST}")
set(ENV{VK_ICD_FILENAMES} "${MANIFEST}") # The older name of the same.
execute_process(COMMAND "${TESTS}" "--test-case=${CASES}" --duration=true
    OUTPUT_VARIABLE output RESULT_VARIABLE status ECHO_OUTPUT_VARIABLE)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "the tests end with ${status}")
endif()
if(NOT output MATCHES "SwiftShader")
    message(FATAL_ERROR "they ran on another device")
endif()
