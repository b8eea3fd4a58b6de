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
        target_compile_options(${name} PRIVATE ${geodisk_optimization})
        geodisk_harden(${name})
    endif()
    if(GEODISK_UNITY)
        geodisk_unity(${name})
    endif()
endfunction()

# How targets of a folder optimize. CMake's -O3 takes a quarter longer to compile; what it gains is lost in
# the noise of measuring.
if(NOT MSVC)
    set(geodisk_optimization "$<$<CONFIG:Release>:-O2>")
endif()

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

# geodisk_compile_quickly(NAME): for a target that hardly computes itself and whose headers take long to
# optimize.
function(geodisk_compile_quickly name)
    target_compile_options(${name} PRIVATE ${geodisk_quick_options})
endfunction()

option(GEODISK_UNITY "Compile sources of a folder together: a whole build takes a third of the time, but no forgotten #include is found" OFF)

# geodisk_unity(NAME): joins the C++ sources of a target, up to sixteen of one folder at a time. Names in
# anonymous namespaces must therefore differ within a folder.
function(geodisk_unity name)
    get_target_property(sources ${name} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "(^|/)main\\.cpp$") # Says how doctest.h is to be read.
    set(folders)
    foreach(source IN LISTS sources)
        get_filename_component(folder "${source}" DIRECTORY)
        string(MAKE_C_IDENTIFIER "in_${folder}" folder)
        list(APPEND folders "${folder}")
        list(APPEND ${folder} "${source}")
    endforeach()
    list(REMOVE_DUPLICATES folders)
    foreach(folder IN LISTS folders)
        list(LENGTH ${folder} count)
        math(EXPR groups "(${count} + 15) / 16")
        set(number 0)
        foreach(source IN LISTS ${folder})
            math(EXPR group "${number} * ${groups} / ${count}")
            math(EXPR number "${number} + 1")
            set_property(SOURCE "${source}" PROPERTY UNITY_GROUP "${folder}_${group}")
        endforeach()
    endforeach()
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # GCC warns of types in anonymous namespaces wherever their source is included by another file, and
    # GCC 12 of std::string itself where much is inlined.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${name} PRIVATE
            $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage;-Wno-restrict>)
    elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang") # Of constants of other sources, too.
        target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-shadow>)
    endif()
endfunction()
