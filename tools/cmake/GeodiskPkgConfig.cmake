# geodisk_install_pkg_config(): installs geodisk-cpp.pc, with the C++ library of this build and the
# context, and geodisk.pc, with the C library where there is one. They find these from where they
# lie, so that an installation may be moved.
#
# C++20 is for the user to ask for: pkg-config has no way to say so that other flags could override.
function(geodisk_install_pkg_config)
    set(folder "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
    foreach(name libdir includedir)
        string(TOUPPER "${name}" variable)
        cmake_path(IS_ABSOLUTE CMAKE_INSTALL_${variable} is_absolute)
        set(${name} "${CMAKE_INSTALL_${variable}}")
        if(NOT is_absolute)
            set(${name} "\${prefix}/${${name}}")
        endif()
    endforeach()
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" OUTPUT_VARIABLE from)
    cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY "${from}"
        OUTPUT_VARIABLE prefix_from_here)

    set(cflags "-I\${includedir}")
    # Headers that the compiler would not find by itself. Vulkan's own pkg-config file would do, but
    # it links the loader, and is not installed everywhere. What is built for another system goes there.
    if(NOT CMAKE_CROSSCOMPILING
            AND NOT Vulkan_INCLUDE_DIR IN_LIST CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
        string(APPEND cflags " -I\"${Vulkan_INCLUDE_DIR}\"")
    endif()
    get_target_property(type geodisk TYPE)
    if(type STREQUAL "SHARED_LIBRARY")
        string(APPEND cflags " -DGEODISK_SHARED")
    endif()
    # Not Libs.private: the context is static in every build, so what it needs is linked in all.
    set(context_libs ${CMAKE_THREAD_LIBS_INIT})
    foreach(library IN LISTS CMAKE_DL_LIBS)
        list(APPEND context_libs "-l${library}")
    endforeach()
    if(MINGW)
        list(APPEND context_libs -lssp) # As geodisk_harden() says.
    endif()
    list(JOIN context_libs " " context_libs)

    set(packages geodisk-cpp)
    if(GEODISK_BUILD_C)
        list(APPEND packages geodisk)
    endif()
    foreach(package IN LISTS packages)
        configure_file("${PROJECT_SOURCE_DIR}/tools/cmake/${package}.pc.in"
            "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc" @ONLY)
        install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${package}.pc" DESTINATION "${folder}")
    endforeach()
endfunction()
