# The libraries of the checkout that this port lies in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

# The C library is a shared one, which static triplets do not allow.
string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" dynamic BUILD_C)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        "-DGEODISK_BUILD_C=${BUILD_C}"
        -DGEODISK_BUILD_TOOLS=OFF
        -DGEODISK_BUILD_TESTS=OFF
        -DGEODISK_BUILD_BENCH=OFF
        "-DGEODISK_GLSLANG=${CURRENT_HOST_INSTALLED_DIR}/tools/glslang/glslang${VCPKG_HOST_EXECUTABLE_SUFFIX}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/geodisk)
vcpkg_fixup_pkgconfig()

# Documents of the whole repository, and what the first of two builds has installed already.
file(REMOVE_RECURSE
    "${CURRENT_PACKAGES_DIR}/share/doc"
    "${CURRENT_PACKAGES_DIR}/debug/include"
    "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
