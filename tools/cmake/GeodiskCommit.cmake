# geodisk_commit_header(TARGET HEADER NAMESPACE): lets TARGET include HEADER, which has the commit
# of this checkout as `kCommit`, "unknown" where there is none, and whether tracked files differ
# from it as `kCommitIsDirty`. It is looked up with every build and written when it has changed.
#
# The same file, run as a script, is what looks it up.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    set(GEODISK_COMMIT_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

    function(geodisk_commit_header target header namespace)
        find_package(Git QUIET)
        set(folder "${CMAKE_CURRENT_BINARY_DIR}/commit")
        add_custom_target(${target}_commit
            COMMAND "${CMAKE_COMMAND}" "-DGIT=${GIT_EXECUTABLE}" "-DSOURCE=${PROJECT_SOURCE_DIR}"
                "-DHEADER=${folder}/${header}" "-DNAMESPACE=${namespace}"
                -P "${GEODISK_COMMIT_SCRIPT}"
            BYPRODUCTS "${folder}/${header}"
            COMMENT "Looking up the commit"
            VERBATIM)
        add_dependencies(${target} ${target}_commit)
        target_include_directories(${target} PRIVATE "${folder}")
    endfunction()
    return()
endif()

function(ask_git result)
    set(${result} "" PARENT_SCOPE)
    if(GIT)
        execute_process(COMMAND "${GIT}" -C "${SOURCE}" ${ARGN}
            OUTPUT_VARIABLE answer RESULT_VARIABLE status
            OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        if(status EQUAL 0)
            set(${result} "${answer}" PARENT_SCOPE)
        endif()
    endif()
endfunction()

set(commit "unknown")
set(is_dirty "false")
# Sources within the checkout of something else have no commit of their own.
ask_git(prefix rev-parse --show-prefix)
ask_git(head rev-parse HEAD)
if(head AND NOT prefix)
    set(commit "${head}")
    ask_git(changes status --porcelain --untracked-files=no)
    if(changes)
        set(is_dirty "true")
    endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
// Generated.
#pragma once

namespace @NAMESPACE@ {
inline constexpr const char* kCommit = "@commit@";
inline constexpr bool kCommitIsDirty = @is_dirty@;
} // namespace @NAMESPACE@
]])
