# Debian's tinygltf is a shared library for libstdc++; the wheel compiles its header by itself.
find_path(TinyGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
set(source "${CMAKE_CURRENT_BINARY_DIR}/tinygltf.cpp")
file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT [[
#define TINYGLTF_IMPLEMENTATION
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <tiny_gltf.h>
]])
add_library(TinyGLTF STATIC "${source}")
add_library(TinyGLTF::TinyGLTF ALIAS TinyGLTF)
target_compile_features(TinyGLTF PUBLIC cxx_std_11)
target_include_directories(TinyGLTF SYSTEM PUBLIC
    "${TinyGLTF_INCLUDE_DIR}" "${TinyGLTF_INCLUDE_DIR}/nlohmann" "${TinyGLTF_INCLUDE_DIR}/stb")
set_target_properties(TinyGLTF PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    POSITION_INDEPENDENT_CODE ON)
