# Draco, compiled from its sources: what decodes.
set(source "${GEODISK_WHEEL_SOURCES}/draco/src")
file(GLOB sources
    "${source}/draco/attributes/*.cc"
    "${source}/draco/compression/decode.cc"
    "${source}/draco/compression/*/*decod*.cc"
    "${source}/draco/compression/point_cloud/algorithms/*decod*.cc"
    "${source}/draco/core/*.cc"
    "${source}/draco/mesh/corner_table.cc"
    "${source}/draco/mesh/mesh.cc"
    "${source}/draco/mesh/mesh_attribute_corner_table.cc"
    "${source}/draco/metadata/*.cc"
    "${source}/draco/point_cloud/point_cloud.cc")
list(FILTER sources EXCLUDE REGEX "_test|encod")
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/draco/draco/draco_features.h" "
#define DRACO_POINT_CLOUD_COMPRESSION_SUPPORTED
#define DRACO_MESH_COMPRESSION_SUPPORTED
#define DRACO_NORMAL_ENCODING_SUPPORTED
#define DRACO_STANDARD_EDGEBREAKER_SUPPORTED
#define DRACO_PREDICTIVE_EDGEBREAKER_SUPPORTED
#define DRACO_BACKWARDS_COMPATIBILITY_SUPPORTED
")
add_library(draco STATIC ${sources})
add_library(draco::draco ALIAS draco)
target_compile_features(draco PUBLIC cxx_std_11)
target_include_directories(draco SYSTEM PUBLIC "${source}" "${CMAKE_CURRENT_BINARY_DIR}/draco")
set_target_properties(draco PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    POSITION_INDEPENDENT_CODE ON)
