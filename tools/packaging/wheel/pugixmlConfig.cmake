# pugixml, compiled from its source.
set(source "${GEODISK_WHEEL_SOURCES}/pugixml/src")
add_library(pugixml STATIC "${source}/pugixml.cpp")
add_library(pugixml::pugixml ALIAS pugixml)
target_include_directories(pugixml SYSTEM PUBLIC "${source}")
set_target_properties(pugixml PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    POSITION_INDEPENDENT_CODE ON)
