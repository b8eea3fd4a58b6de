// Names and labels for debuggers. They do nothing unless the caller enabled VK_EXT_debug_utils.
#pragma once

#include <cstdint>
#include <cstring>

#include <vulkan/vulkan_core.h>

#include "vk/dispatch.hpp"

namespace geodisk {

template <class Handle>
void name_object(const DeviceTable& vk, VkDevice device, VkObjectType type, Handle handle,
                 const char* name) {
    if (vk.vkSetDebugUtilsObjectNameEXT == nullptr) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    // NOLINTBEGIN(bugprone-sizeof-expression): of a handle, which may be a pointer.
    static_assert(sizeof(Handle) <= sizeof info.objectHandle);
    std::memcpy(&info.objectHandle, &handle, sizeof(Handle));
    // NOLINTEND(bugprone-sizeof-expression)
    info.pObjectName = name;
    vk.vkSetDebugUtilsObjectNameEXT(device, &info);
}

inline void begin_label(const DeviceTable& vk, VkCommandBuffer commands, const char* name) {
    if (vk.vkCmdBeginDebugUtilsLabelEXT == nullptr) {
        return;
    }
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = name;
    vk.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
}

inline void end_label(const DeviceTable& vk, VkCommandBuffer commands) {
    if (vk.vkCmdEndDebugUtilsLabelEXT != nullptr) {
        vk.vkCmdEndDebugUtilsLabelEXT(commands);
    }
}

} // namespace geodisk
