# meshoptimizer, compiled from its sources: what decodes.
set(source "${GEODISK_WHEEL_SOURCES}/meshoptimizer/src")
add_library(meshoptimizer STATIC
    "${source}/allocator.cpp"
    "${source}/indexcodec.cpp"
    "${source}/vertexcodec.cpp"
    "${source}/vertexfilter.cpp")
add_library(meshoptimizer::meshoptimizer ALIAS meshoptimizer)
target_include_directories(meshoptimizer SYSTEM PUBLIC "${source}")
set_target_properties(meshoptimizer PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    POSITION_INDEPENDENT_CODE ON)
