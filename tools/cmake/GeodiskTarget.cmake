# geodisk_target(NAME): what every target of the project compiles with.
#
# -ffp-contract=off: host geometry and the float twins must round like the shaders, so no
# multiplication may fuse with an addition.
function(geodisk_target name)
    target_compile_features(${name} PUBLIC cxx_std_20)
    set_target_properties(${name} PROPERTIES
        CXX_EXTENSIONS OFF
        CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON
        POSITION_INDEPENDENT_CODE ON)
    if(MSVC)
        target_compile_options(${name} PRIVATE /W4 /fp:precise)
        if(GEODISK_WERROR)
            target_compile_options(${name} PRIVATE /WX)
        endif()
    else()
        target_compile_options(${name} PRIVATE
            -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -ffp-contract=off)
        if(GEODISK_WERROR)
            target_compile_options(${name} PRIVATE -Werror)
        endif()
    endif()
endfunction()
