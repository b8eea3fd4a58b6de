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
        geodisk_harden(${name})
    endif()
endfunction()

# geodisk_harden(NAME): programs read files from anywhere. What compilers and linkers can do against
# errors in that; tests/package/hardening.cmake looks whether it is there.
include(CheckPIESupported)
check_pie_supported()
function(geodisk_harden name)
    target_compile_options(${name} PRIVATE -fstack-protector-strong
        "$<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
    if(UNIX AND NOT APPLE)
        target_link_options(${name} PRIVATE -Wl,-z,relro,-z,now,-z,noexecstack)
    elseif(MINGW)
        target_link_libraries(${name} PRIVATE ssp) # What checks stacks is no part of its C library.
    endif()
endfunction()

# For what hardly computes: time to compile weighs more.
if(NOT MSVC)
    set(geodisk_quick_options "$<$<CONFIG:Release>:-O1>")
endif()

# geodisk_compile_quickly(SOURCE...): for sources that hardly compute and whose headers take long to
# optimize, such as options.
function(geodisk_compile_quickly)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${geodisk_quick_options}")
endfunction()

option(GEODISK_PRECOMPILE "Compile the standard headers once per target: builds all in less time, but finds no forgotten #include" OFF)

# geodisk_precompile(NAME): for a target of many sources.
function(geodisk_precompile name)
    if(GEODISK_PRECOMPILE)
        target_precompile_headers(${name} PRIVATE
            "$<$<COMPILE_LANGUAGE:CXX>:${CMAKE_CURRENT_FUNCTION_LIST_DIR}/standard_headers.hpp>")
        # GCC 12 warns of std::string itself, whose header it no longer knows to be the system's.
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            target_compile_options(${name} PRIVATE
                -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
        endif()
    endif()
endfunction()
