# strict_target(NAME): compiles with the warnings of a careful user, also those that the library's
# headers cause.
function(strict_target name)
    set_target_properties(${name} PROPERTIES NO_SYSTEM_FROM_IMPORTED ON)
    if(MSVC)
        target_compile_options(${name} PRIVATE /W4 /WX)
    else()
        target_compile_options(${name} PRIVATE
            -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Werror)
    endif()
endfunction()
