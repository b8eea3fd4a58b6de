#include "vk/dispatch.hpp"

#include <string>

#include "support/guard.hpp"

namespace geodisk {
namespace {

Error missing_function(const char* owner, const char* name) {
    return Error{Status::device_lacks, std::string("the Vulkan ") + owner +
                                           " does not provide the function " + name +
                                           " (core since version 1.1)"};
}

Error null_argument(const char* name) {
    return Error{Status::invalid_argument, std::string(name) + " is null"};
}

/// The first null member of `refs` that has to be set, or nullptr.
const char* first_null(const DeviceRefs& refs) noexcept {
    if (refs.instance == VK_NULL_HANDLE)
        return "DeviceRefs::instance";
    if (refs.physical_device == VK_NULL_HANDLE)
        return "DeviceRefs::physical_device";
    if (refs.device == VK_NULL_HANDLE)
        return "DeviceRefs::device";
    if (refs.get_instance_proc_addr == nullptr)
        return "DeviceRefs::get_instance_proc_addr";
    return nullptr;
}

} // namespace

Result<InstanceTable> load_instance_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                          VkInstance instance) noexcept {
    return guarded([&]() -> Result<InstanceTable> {
        if (get_instance_proc_addr == nullptr)
            return null_argument("get_instance_proc_addr");
        if (instance == VK_NULL_HANDLE)
            return null_argument("instance");
        InstanceTable table;
        const char* missing = nullptr;
#define GEODISK_LOAD(name)                                                                         \
    table.name = reinterpret_cast<PFN_##name>(get_instance_proc_addr(instance, #name));            \
    if (table.name == nullptr && missing == nullptr)                                               \
        missing = #name;
        GEODISK_INSTANCE_FUNCTIONS(GEODISK_LOAD)
#undef GEODISK_LOAD
        if (missing != nullptr)
            return missing_function("instance", missing);
        return table;
    });
}

Result<DeviceTable> load_device_table(const DeviceRefs& refs) noexcept {
    return guarded([&]() -> Result<DeviceTable> {
        if (const char* name = first_null(refs))
            return null_argument(name);
        if (refs.api_version < VK_API_VERSION_1_1)
            return Error{Status::device_lacks, "DeviceRefs::api_version is below Vulkan 1.1"};
        const auto get_device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
            refs.get_instance_proc_addr(refs.instance, "vkGetDeviceProcAddr"));
        if (get_device_proc_addr == nullptr)
            return missing_function("instance", "vkGetDeviceProcAddr");
        DeviceTable table;
        const char* missing = nullptr;
#define GEODISK_LOAD(name)                                                                         \
    table.name = reinterpret_cast<PFN_##name>(get_device_proc_addr(refs.device, #name));           \
    if (table.name == nullptr && missing == nullptr)                                               \
        missing = #name;
        GEODISK_DEVICE_FUNCTIONS(GEODISK_LOAD)
#undef GEODISK_LOAD
        if (missing != nullptr)
            return missing_function("device", missing);
        if (refs.debug_utils) {
            // Of an extension of the instance.
#define GEODISK_LOAD(name)                                                                         \
    table.name = reinterpret_cast<PFN_##name>(refs.get_instance_proc_addr(refs.instance, #name));  \
    if (table.name == nullptr && missing == nullptr)                                               \
        missing = #name;
            GEODISK_DEBUG_FUNCTIONS(GEODISK_LOAD)
#undef GEODISK_LOAD
            if (missing != nullptr)
                return Error{Status::device_lacks,
                             std::string("DeviceRefs::debug_utils is set, but the instance does "
                                         "not provide the function ") +
                                 missing};
        }
        return table;
    });
}

} // namespace geodisk
