# Packages of what this build installs, by CPack: Debian's by tools/packaging/build-debs, else a ZIP.
set(CPACK_PACKAGE_VENDOR "the geodisk authors")
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR ZIP)
if(GEODISK_DEB)
    include("${CMAKE_CURRENT_LIST_DIR}/deb/deb.cmake")
elseif(WIN32)
    # The licences of what the program is linked with, which ask for this.
    install(FILES "${CMAKE_CURRENT_LIST_DIR}/deb/copyright"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME COPYRIGHT.txt)
endif()
include(CPack)
