# Debian packages: one for each component of the installation. Of what Debian asks for, this adds
# what an installation elsewhere has no use for.
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    message(FATAL_ERROR "geodisk: Debian packages are for CMAKE_INSTALL_PREFIX=/usr")
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program library development python mpi mpi_development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/compress.cmake")

# Who answers for the packages, as Debian's own tools are told.
set(name "$ENV{DEBFULLNAME}")
set(address "$ENV{DEBEMAIL}")
if(NOT name)
    set(name "geodisk maintainers")
endif()
if(NOT address)
    set(address "maintainers@geodisk.invalid")
endif()
set(CPACK_PACKAGE_CONTACT "${name} <${address}>")

set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # Each package has its own, the first line of these.
set(about "geodisk scatters random points over a triangle mesh so that no two are closer
than a minimum distance, measured exactly along the surface. It runs in Vulkan
compute shaders, on any GPU or on the CPU.
")
# What dlopen() finds at run time, and no tool does.
set(vulkan "libvulkan1, mesa-vulkan-drivers | vulkan-icd")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME geodisk)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Poisson-disk samples of triangle meshes, along the surface
${about}
This package has the program, which also verifies, measures and draws samples,
and the documentation.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME "libgeodisk${geodisk_SOVERSION}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "Poisson-disk samples of triangle meshes, C library
${about}
This package has the library for programs in C and languages that call C.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgeodisk-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libgeodisk${geodisk_SOVERSION} (= ${version}), libvulkan-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS geodisk)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Poisson-disk samples of triangle meshes, development files
${about}
This package has what programs in C and C++ are compiled with: headers, the C++
library, CMake and pkg-config files, and examples.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-geodisk)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, python3-pandas")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Poisson-disk samples of triangle meshes, Python package
${about}
This package has the modules for Python, and the library that they call.")

set(CPACK_DEBIAN_MPI_PACKAGE_NAME geodisk-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS openmpi-bin) # mpirun.
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_MPI_PACKAGE_SUGGESTS "geodisk (= ${version})") # For its documentation.
set(CPACK_DEBIAN_MPI_DESCRIPTION "Poisson-disk samples of triangle meshes, by many processes
${about}
This package has the program that samples one surface by many processes, by
MPI.")

set(CPACK_DEBIAN_MPI_DEVELOPMENT_PACKAGE_NAME libgeodisk-mpi-dev)
set(CPACK_DEBIAN_MPI_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_MPI_DEVELOPMENT_PACKAGE_DEPENDS
    "libgeodisk-dev (= ${version}), libmetis-dev, libopenmpi-dev")
set(CPACK_DEBIAN_MPI_DEVELOPMENT_DESCRIPTION
    "Poisson-disk samples of triangle meshes, development files for MPI
${about}
This package has what programs in C++ are compiled with that sample one surface
by many processes: a header, the library, and files for CMake.")

# The package for Python, with a library of its own that reads files. A wheel has its metadata from pyproject.toml.
set(modules lib/python3/dist-packages)
install(DIRECTORY tools/python/geodisk DESTINATION "${modules}" COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
install(TARGETS geodisk_python LIBRARY DESTINATION "${modules}/geodisk" COMPONENT python)
set(written "${PROJECT_BINARY_DIR}/deb")
file(WRITE "${written}/METADATA" "Metadata-Version: 2.1\nName: geodisk\nVersion: ${PROJECT_VERSION}\n"
    "Summary: ${PROJECT_DESCRIPTION}\nRequires-Dist: numpy\n")
install(FILES "${written}/METADATA" COMPONENT python
    DESTINATION "${modules}/geodisk-${PROJECT_VERSION}.dist-info")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_LIST_DIR}/postinst" "${CMAKE_CURRENT_LIST_DIR}/prerm")

# Who links the library depends on its package, and the linker's cache is to know it.
file(WRITE "${written}/shlibs" "libgeodisk ${geodisk_SOVERSION} libgeodisk${geodisk_SOVERSION} (>= ${PROJECT_VERSION})\n")
file(WRITE "${written}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${written}/shlibs" "${written}/triggers")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${written}/changelog.Debian" "geodisk (${version}) unstable; urgency=medium

  * geodisk ${PROJECT_VERSION}, whose changes CHANGELOG.md of the package geodisk lists.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
set(overrides_of_program
    "# README.md links to it.\ngeodisk: wrong-name-for-upstream-changelog *\n")
set(overrides_of_library
    "# CPack adds the calls.\nlibgeodisk${geodisk_SOVERSION}: maintscript-calls-ldconfig *\n")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER "${component}" key)
    set(package "${CPACK_DEBIAN_${key}_PACKAGE_NAME}")
    set(folder "share/doc/${package}")
    install(FILES "${CMAKE_CURRENT_LIST_DIR}/copyright" "${written}/changelog.Debian"
        DESTINATION "${folder}" COMPONENT ${component})
    file(WRITE "${written}/overrides/${package}"
        "# Not made for Debian's archive.\n${package}: initial-upload-closes-no-bugs *\n"
        ${overrides_of_${component}})
    install(FILES "${written}/overrides/${package}"
        DESTINATION share/lintian/overrides COMPONENT ${component})
endforeach()
