# Runs one package test, CASE, with what SETTINGS says of the build.
cmake_minimum_required(VERSION 3.22)
include("${SETTINGS}")
set(package_tests "${CMAKE_CURRENT_LIST_DIR}")
set(installed "${work}/installed package") # The blank is part of the test.

# Runs a command; fails the test unless it succeeds without a warning.
function(run)
    execute_process(COMMAND ${ARGN}
        OUTPUT_VARIABLE printed ERROR_VARIABLE printed RESULT_VARIABLE status)
    list(JOIN ARGN " " command)
    if(NOT status EQUAL 0)
        message("${printed}")
        message(FATAL_ERROR "failed with ${status}: ${command}")
    endif()
    if(printed MATCHES "[Ww]arning:|CMake Warning|CMake Deprecation Warning")
        message("${printed}")
        message(FATAL_ERROR "warns: ${command}")
    endif()
endfunction()

# Configures a project from nothing. Vulkan's own package is kept out of reach: the headers do.
# The two cases that compile the library anew do so without optimization, to be quick.
function(configure source build)
    file(REMOVE_RECURSE "${build}")
    run("${CMAKE_COMMAND}" -S "${source}" -B "${build}" --no-warn-unused-cli
        ${common_options} -DCMAKE_DISABLE_FIND_PACKAGE_Vulkan=ON ${ARGN})
endfunction()

function(build folder)
    run("${CMAKE_COMMAND}" --build "${folder}" --parallel 2 ${ARGN})
endfunction()

# Sets `flags` to what pkg-config says of the one PACKAGE in a folder, with further flags for it, and
# `libraries` to the folder of its libraries; its own folder is the only one it looks in.
function(ask_pkg_config package folder)
    file(GLOB_RECURSE files "${folder}/*/${package}.pc")
    list(LENGTH files count)
    if(NOT count EQUAL 1)
        message(FATAL_ERROR "not one ${package}.pc in ${folder}, but ${count}")
    endif()
    cmake_path(GET files PARENT_PATH pc_folder)
    cmake_path(GET pc_folder PARENT_PATH libraries)
    set(ENV{PKG_CONFIG_LIBDIR} "${pc_folder}")
    set(ENV{PKG_CONFIG_PATH} "")
    execute_process(COMMAND "${pkg_config}" --cflags --libs ${ARGN} ${package}
        OUTPUT_VARIABLE flags ERROR_VARIABLE error RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "pkg-config: ${error}")
    endif()
    if(flags MATCHES "-lvulkan")
        message(FATAL_ERROR "it links a Vulkan loader: ${flags}")
    endif()
    separate_arguments(flags UNIX_COMMAND "${flags}")
    set(flags "${flags}" PARENT_SCOPE)
    set(libraries "${libraries}" PARENT_SCOPE)
endfunction()

# Whether there is pkg-config, as there must be in continuous integration.
function(find_pkg_config result)
    if(NOT pkg_config AND "$ENV{CI}" STREQUAL "true")
        message(FATAL_ERROR "pkg-config is not installed")
    elseif(NOT pkg_config)
        message("skipped: pkg-config is not installed")
    endif()
    set(${result} "${pkg_config}" PARENT_SCOPE)
endfunction()

# Compiles both programs of find_package/ by what pkg-config says of an installation, with further
# flags for it, and runs them.
function(use_by_pkg_config package folder)
    find_pkg_config(found)
    if(NOT found)
        return()
    endif()
    ask_pkg_config(geodisk-cpp "${package}" ${ARGN})
    separate_arguments(compiler_flags UNIX_COMMAND "${cxx_flags} ${linker_flags}")
    file(REMOVE_RECURSE "${folder}")
    file(MAKE_DIRECTORY "${folder}")
    foreach(program main:example check:check)
        string(REGEX MATCH "^([a-z]+):([a-z]+)$" matched "${program}")
        run("${cxx_compiler}" -std=c++20 -Wall -Wextra ${compiler_flags}
            "${package_tests}/find_package/${CMAKE_MATCH_1}.cpp" -o "${folder}/${CMAKE_MATCH_2}"
            ${flags})
    endforeach()
    set(ENV{LD_LIBRARY_PATH} "${libraries}:$ENV{LD_LIBRARY_PATH}")
    set(ENV{DYLD_LIBRARY_PATH} "${libraries}:$ENV{DYLD_LIBRARY_PATH}")
    run_programs("${folder}")
endfunction()

# Runs a program that prints points. What drivers write to stderr and leak is not ours.
function(run_example program)
    set(ENV{ASAN_OPTIONS} "detect_leaks=0")
    execute_process(COMMAND "${program}" OUTPUT_VARIABLE output RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${program} fails with ${status}")
    endif()
    if(NOT output MATCHES "^[0-9]+ samples\n([-0-9.e]+ [-0-9.e]+ [-0-9.e]+\n)+$")
        message("${output}")
        message(FATAL_ERROR "${program} prints something else than points")
    endif()
endfunction()

# Runs both programs of find_package/.
function(run_programs folder)
    set(ENV{ASAN_OPTIONS} "detect_leaks=0")
    execute_process(COMMAND "${folder}/check" RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "check fails with ${status}")
    endif()
    run_example("${folder}/example")
endfunction()

if(CASE STREQUAL "install")
    file(REMOVE_RECURSE "${installed}")
    run("${CMAKE_COMMAND}" --install "${build_root}" --prefix "${installed}")
    if(has_tools)
        run("${installed}/bin/geodisk" --version)
        foreach(written share/man/man1/geodisk.1 share/man/man1/geodisk-sample.1
                share/bash-completion/completions/geodisk share/zsh/site-functions/_geodisk)
            if(UNIX AND NOT EXISTS "${installed}/${written}")
                message(FATAL_ERROR "${written} is not installed")
            endif()
        endforeach()
    endif()
    if(has_tools AND has_mpi)
        foreach(written bin/geodisk_mpi include/geodisk/mpi.hpp share/man/man1/geodisk_mpi.1
                share/man/man1/geodisk_mpi-sample.1 share/bash-completion/completions/geodisk_mpi)
            if(NOT EXISTS "${installed}/${written}")
                message(FATAL_ERROR "${written} is not installed")
            endif()
        endforeach()
    endif()
    file(GLOB documents RELATIVE "${source_root}" "${source_root}/*.md" "${source_root}/LICENSE"
        "${source_root}/host/docs/*.md" "${source_root}/host/docs/*/*")
    foreach(document IN LISTS documents)
        if(NOT EXISTS "${installed}/${doc_folder}/${document}")
            message(FATAL_ERROR "${document} is not installed")
        endif()
    endforeach()
    # Nor do the links of what is installed lead nowhere.
    file(GLOB_RECURSE pages "${installed}/${doc_folder}/*.md")
    foreach(page IN LISTS pages)
        file(READ "${page}" text)
        string(REPLACE "](" "@@" text "${text}") # Brackets hold lists together.
        string(REGEX MATCHALL "@@[^])#:]+[)#]" links "${text}")
        get_filename_component(folder "${page}" DIRECTORY)
        foreach(link IN LISTS links)
            string(REGEX REPLACE "^..(.*).$" "\\1" target "${link}")
            if(NOT EXISTS "${folder}/${target}")
                message(FATAL_ERROR "${page} links to ${target}, which is not installed")
            endif()
        endforeach()
    endforeach()

elseif(CASE STREQUAL "hardening")
    include("${package_tests}/hardening.cmake")
    file(GLOB programs "${build_root}/bin/*" "${installed}/bin/*")
    file(GLOB_RECURSE libraries "${installed}/libgeodisk.so")
    foreach(program IN LISTS programs libraries)
        check_hardening("${program}")
    endforeach()

elseif(CASE STREQUAL "find_package")
    configure("${package_tests}/find_package" "${work}/find package"
        "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/find package")
    run_programs("${work}/find package")

elseif(CASE STREQUAL "mpi")
    # Programs started by mpirun in a container are root's, and there may be fewer cores.
    set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
    set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
    set(ENV{OMPI_MCA_rmaps_base_oversubscribe} 1)
    set(ENV{LP_NUM_THREADS} 1)
    configure("${package_tests}/mpi" "${work}/mpi" "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/mpi")
    set(ENV{ASAN_OPTIONS} "detect_leaks=0")
    foreach(count 1 3)
        execute_process(COMMAND "${mpiexec}" -n ${count} "${work}/mpi/together"
            OUTPUT_VARIABLE points_of_${count} RESULT_VARIABLE status)
        if(NOT status EQUAL 0 OR NOT points_of_${count} MATCHES "^[0-9]+ samples\n")
            message(FATAL_ERROR "together fails with ${status}: ${points_of_${count}}")
        endif()
    endforeach()
    if(NOT points_of_1 STREQUAL points_of_3)
        message(FATAL_ERROR "3 processes give other samples than one")
    endif()

elseif(CASE STREQUAL "pkg_config")
    # Also after a move, which the file must follow.
    use_by_pkg_config("${installed}" "${work}/pkg config")
    file(REMOVE_RECURSE "${work}/moved package")
    file(COPY "${installed}/" DESTINATION "${work}/moved package")
    use_by_pkg_config("${work}/moved package" "${work}/moved pkg config" --static)

elseif(CASE STREQUAL "shared")
    configure("${source_root}" "${work}/shared library"
        -DCMAKE_BUILD_TYPE=Debug
        -DBUILD_SHARED_LIBS=ON
        -DGEODISK_BUILD_TOOLS=OFF
        -DGEODISK_BUILD_TESTS=OFF
        -DGEODISK_BUILD_BENCH=OFF
        "-DCMAKE_INSTALL_PREFIX=${work}/shared package")
    build("${work}/shared library")
    file(REMOVE_RECURSE "${work}/shared package")
    run("${CMAKE_COMMAND}" --install "${work}/shared library")
    configure("${package_tests}/find_package" "${work}/shared user"
        "-DCMAKE_PREFIX_PATH=${work}/shared package")
    build("${work}/shared user")
    run_programs("${work}/shared user")
    use_by_pkg_config("${work}/shared package" "${work}/shared pkg config")

elseif(CASE MATCHES "^(configure|add)_subdirectory$")
    configure("${package_tests}/add_subdirectory" "${work}/${CASE}"
        -DCMAKE_BUILD_TYPE=
        -DBUILD_SHARED_LIBS=ON
        "-DGEODISK_SOURCE=${source_root}")
    if(CASE STREQUAL "add_subdirectory")
        build("${work}/${CASE}")
        run_programs("${work}/${CASE}")
    endif()

elseif(CASE STREQUAL "c")
    # As installed, since users take it from there.
    set(example "${installed}/${doc_folder}/examples/c/sample.c")
    configure("${package_tests}/c" "${work}/c" "-DCMAKE_PREFIX_PATH=${installed}"
        "-DGEODISK_EXAMPLE=${example}")
    build("${work}/c")
    run_example("${work}/c/example")
    find_pkg_config(found)
    if(found)
        ask_pkg_config(geodisk "${installed}")
        separate_arguments(compiler_flags UNIX_COMMAND "${c_flags} ${linker_flags}")
        file(MAKE_DIRECTORY "${work}/c pkg config")
        run("${c_compiler}" ${compiler_flags} "${example}" -o "${work}/c pkg config/example"
            ${flags})
        set(ENV{LD_LIBRARY_PATH} "${libraries}:$ENV{LD_LIBRARY_PATH}")
        set(ENV{DYLD_LIBRARY_PATH} "${libraries}:$ENV{DYLD_LIBRARY_PATH}")
        run_example("${work}/c pkg config/example")
    endif()

elseif(CASE STREQUAL "engine")
    # As installed, since users take it from there.
    configure("${installed}/share/doc/geodisk/examples/engine" "${work}/engine"
        "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/engine")
    set(ENV{ASAN_OPTIONS} "detect_leaks=0")
    file(REMOVE "${work}/engine.png")
    run("${work}/engine/engine" --validate "${work}/engine.png")
    file(SIZE "${work}/engine.png" size)
    if(size LESS 100000) # The torus alone takes less.
        message(FATAL_ERROR "no samples are drawn in ${work}/engine.png")
    endif()

elseif(CASE STREQUAL "paint")
    # As installed, since users take it from there. It compares its samples with a whole run.
    configure("${installed}/${doc_folder}/examples/paint" "${work}/paint"
        "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/paint")
    run("${work}/paint/paint" radii)
    run("${work}/paint/paint" mask)

elseif(CASE STREQUAL "record")
    # As installed, since users take it from there. Both have the samples of the example in C.
    configure("${installed}/${doc_folder}/examples/record" "${work}/record"
        "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/record")
    run_example("${work}/record/record_cpp")
    run_example("${work}/record/record_c")

elseif(CASE STREQUAL "headers")
    configure("${package_tests}/headers" "${work}/headers" "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/headers")

elseif(CASE STREQUAL "compile_fail")
    configure("${package_tests}/compile_fail" "${work}/compile fail"
        "-DCMAKE_PREFIX_PATH=${installed}")
    build("${work}/compile fail" --target right)
    execute_process(COMMAND "${CMAKE_COMMAND}" --build "${work}/compile fail" --target wrong
        OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
    if(status EQUAL 0)
        message(FATAL_ERROR "a Result that nobody looks at compiles")
    endif()
    if(NOT output MATCHES "unused-result|nodiscard")
        message("${output}")
        message(FATAL_ERROR "it fails for another reason")
    endif()

elseif(CASE STREQUAL "readme")
    # The README shows these files word for word.
    file(READ "${source_root}/README.md" readme)
    foreach(shown
            "cpp:tests/package/find_package/main.cpp"
            "cmake:tests/package/find_package/CMakeLists.txt")
        string(REGEX MATCH "^([a-z]+):(.*)$" matched "${shown}")
        set(language "${CMAKE_MATCH_1}")
        set(file "${CMAKE_MATCH_2}")
        file(READ "${source_root}/${file}" text)
        string(REGEX REPLACE "^(.*\n)?[#/]* Shown in the README from here on\\.\n+" "" text "${text}")
        string(REGEX REPLACE "\n+[#/]* Not shown from here on\\..*$" "\n" text "${text}")
        string(FIND "${readme}" "```${language}\n${text}```" place)
        if(place EQUAL -1)
            message(FATAL_ERROR "the README does not show ${file} as it is; expected:\n${text}")
        endif()
    endforeach()

else()
    message(FATAL_ERROR "there is no case \"${CASE}\"")
endif()
