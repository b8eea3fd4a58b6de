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

/// Returns the name of the first null member of `refs` that must be set, or nullptr.
const char* first_null(const DeviceRefs& refs) noexcept {
    if (refs.instance == VK_NULL_HANDLE)
        return "DeviceRefs::instance";
    if (refs.physical_device == VK_NULL_HANDLE)
        return "DeviceRefs::physical_device";
    if (refs.device == VK_NULL_HANDLE)
        return "DeviceRefs::device";
    if (refs.get_instance_proc_addr == nullptr)
        return "DeviceRefs::get_instance_proc_addr";
    if (const MemoryHooks* const hooks = refs.memory_hooks) {
        if (hooks->allocate == nullptr)
            return "MemoryHooks::allocate";
        if (hooks->free == nullptr)
            return "MemoryHooks::free";
    }
    return nullptr;
}

// Loads a function of a table with `find`; `missing` is the first that was not found.
#define GEODISK_LOAD(name)                                                                         \
    table.name = reinterpret_cast<PFN_##name>(find(#name));                                        \
    if (table.name == nullptr && missing == nullptr)                                               \
        missing = #name;

/// Returns a table that `fill` fills with `find`, for functions of `owner`.
template <class Table, class Find, class Fill>
Result<Table> filled(const char* owner, const Find& find, Fill&& fill) {
    Table table;
    const char* missing = nullptr;
    fill(table, find, missing);
    if (missing != nullptr)
        return missing_function(owner, missing);
    return table;
}

/// Fills a table of functions of an instance.
template <class Table, class Fill>
Result<Table> instance_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                             Fill&& fill) {
    if (get_instance_proc_addr == nullptr)
        return null_argument("get_instance_proc_addr");
    if (instance == VK_NULL_HANDLE)
        return null_argument("instance");
    const auto find = [&](const char* name) { return get_instance_proc_addr(instance, name); };
    return filled<Table>("instance", find, fill);
}

/// Fills a table of functions of a device.
template <class Table, class Fill>
Result<Table> device_table(const DeviceRefs& refs, Fill&& fill) {
    if (const char* name = first_null(refs))
        return null_argument(name);
    if (refs.api_version < VK_API_VERSION_1_1)
        return Error{Status::device_lacks, "DeviceRefs::api_version is below Vulkan 1.1"};
    const auto get_device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        refs.get_instance_proc_addr(refs.instance, "vkGetDeviceProcAddr"));
    if (get_device_proc_addr == nullptr)
        return missing_function("instance", "vkGetDeviceProcAddr");
    const auto find = [&](const char* name) { return get_device_proc_addr(refs.device, name); };
    return filled<Table>("device", find, fill);
}

} // namespace

Result<InstanceTable> load_instance_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                          VkInstance instance) noexcept {
    return guarded([&] {
        return instance_table<InstanceTable>(
            get_instance_proc_addr, instance,
            [](InstanceTable& table, const auto& find, const char*& missing) {
                GEODISK_INSTANCE_FUNCTIONS(GEODISK_LOAD)
            });
    });
}

Result<OwnerTable> load_owner_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                    VkInstance instance) noexcept {
    return guarded([&] {
        return instance_table<OwnerTable>(
            get_instance_proc_addr, instance,
            [](OwnerTable& table, const auto& find, const char*& missing) {
                GEODISK_OWNER_FUNCTIONS(GEODISK_LOAD)
            });
    });
}

Result<DeviceTable> load_device_table(const DeviceRefs& refs) noexcept {
    return guarded([&]() -> Result<DeviceTable> {
        auto loaded = device_table<DeviceTable>(
            refs, [](DeviceTable& table, const auto& find, const char*& missing) {
                GEODISK_DEVICE_FUNCTIONS(GEODISK_LOAD)
            });
        if (!loaded || !refs.debug_utils)
            return loaded;
        // Functions of an instance extension.
        DeviceTable& table = *loaded;
        const auto find = [&](const char* name) {
            return refs.get_instance_proc_addr(refs.instance, name);
        };
        const char* missing = nullptr;
        GEODISK_DEBUG_FUNCTIONS(GEODISK_LOAD)
        if (missing != nullptr)
            return Error{Status::device_lacks,
                         std::string("DeviceRefs::debug_utils is set, but the instance does not "
                                     "provide the function ") +
                             missing};
        return loaded;
    });
}

Result<QueryTable> load_query_table(const DeviceRefs& refs) noexcept {
    return guarded([&] {
        return device_table<QueryTable>(
            refs, [](QueryTable& table, const auto& find, const char*& missing) {
                GEODISK_QUERY_FUNCTIONS(GEODISK_LOAD)
            });
    });
}

} // namespace geodisk
