// Devices of a caller's, and handles as the C API has them.
#pragma once

#include <cstdint>
#include <cstring>

#include <geodisk/device.hpp>

#include "c/api.hpp"

namespace geodisk::test {

template <class Handle>
std::uint64_t number_of(Handle handle) {
    std::uint64_t number = 0;
    std::memcpy(&number, &handle, sizeof handle);
    return number;
}
template <class Handle>
Handle handle_of(std::uint64_t number) {
    Handle handle;
    std::memcpy(&handle, &number, sizeof handle);
    return handle;
}

inline geodisk_vulkan_device lent_device(const DeviceRefs& refs, const QueueRef& queue) {
    auto lent = sized<geodisk_vulkan_device>();
    lent.instance = refs.instance;
    lent.physical_device = refs.physical_device;
    lent.device = refs.device;
    lent.get_instance_proc_addr = reinterpret_cast<void (*)(void)>(refs.get_instance_proc_addr);
    lent.api_version = refs.api_version;
    lent.queue = queue.queue;
    lent.queue_family = queue.family;
    return lent;
}

inline Owned<geodisk_device> borrowed(const geodisk_vulkan_device& lent) {
    return owned<geodisk_device>([&](auto** made, geodisk_error* error) {
        return geodisk_device_borrow(&lent, made, error);
    });
}

} // namespace geodisk::test
