# Toolchain: builds for Linux with glibc 2.28, on the processor GEODISK_WHEEL_ARCH, with Zig's C++ compiler
# (Python package ziglang). Zig brings headers and symbols of that glibc, and links libc++ statically.
# GEODISK_WHEEL_ZIG is the folder of zig-cc and its siblings, GEODISK_WHEEL_SYSROOT that of the libraries of
# other projects; build-wheel makes both.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR "${GEODISK_WHEEL_ARCH}")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES
    GEODISK_WHEEL_ARCH GEODISK_WHEEL_ZIG GEODISK_WHEEL_SYSROOT)
set(CMAKE_C_COMPILER "${GEODISK_WHEEL_ZIG}/zig-cc")
set(CMAKE_CXX_COMPILER "${GEODISK_WHEEL_ZIG}/zig-c++")
set(CMAKE_AR "${GEODISK_WHEEL_ZIG}/zig-ar" CACHE FILEPATH "")
set(CMAKE_RANLIB "${GEODISK_WHEEL_ZIG}/zig-ranlib" CACHE FILEPATH "")
set(CMAKE_LIBRARY_ARCHITECTURE "${GEODISK_WHEEL_ARCH}-linux-gnu")

# Headers and libraries of the sysroot alone: those of this system belong to another glibc.
set(CMAKE_FIND_ROOT_PATH "${GEODISK_WHEEL_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Debian keeps some headers apart for each processor.
set(CMAKE_C_STANDARD_INCLUDE_DIRECTORIES "${GEODISK_WHEEL_SYSROOT}/usr/include/${GEODISK_WHEEL_ARCH}-linux-gnu")
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES "${CMAKE_C_STANDARD_INCLUDE_DIRECTORIES}")

# Binaries come without symbols: strip of this system knows its own processor alone.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-s")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-s")
