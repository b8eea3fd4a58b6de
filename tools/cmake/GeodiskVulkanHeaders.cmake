# Defines geodisk::vulkan_headers. Of Vulkan geodisk uses the headers alone: the library calls it
# through pointers it is given, and the context opens the loader at run time. FindVulkan would
# insist on a loader to link. Sets GEODISK_VULKAN_HEADERS_PROBLEM where the headers will not do.
set(GEODISK_VULKAN_HEADERS_PROBLEM "")
if(NOT TARGET geodisk::vulkan_headers)
    find_path(Vulkan_INCLUDE_DIR vulkan/vulkan_core.h
        HINTS "$ENV{VULKAN_SDK}/include"
        DOC "Folder of vulkan/vulkan_core.h")
    mark_as_advanced(Vulkan_INCLUDE_DIR)
    if(NOT Vulkan_INCLUDE_DIR)
        set(GEODISK_VULKAN_HEADERS_PROBLEM
            "the Vulkan headers were not found (package libvulkan-dev), set Vulkan_INCLUDE_DIR")
    else()
        file(STRINGS "${Vulkan_INCLUDE_DIR}/vulkan/vulkan_core.h" geodisk_new_enough
            REGEX "^#define VK_API_VERSION_MAJOR" LIMIT_COUNT 1)
        if(NOT geodisk_new_enough)
            set(GEODISK_VULKAN_HEADERS_PROBLEM
                "the Vulkan headers in ${Vulkan_INCLUDE_DIR} are older than 1.2.175")
        else()
            add_library(geodisk::vulkan_headers INTERFACE IMPORTED GLOBAL)
            target_include_directories(geodisk::vulkan_headers
                INTERFACE "${Vulkan_INCLUDE_DIR}")
        endif()
        unset(geodisk_new_enough)
    endif()
endif()
