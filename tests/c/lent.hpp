// Devices of a caller's, and handles as the C API has them.
#pragma once

#include <geodisk/device.hpp>

#include "c/api.hpp"
#include "c/c_handles.hpp"

namespace geodisk::test {

using c::handle_of;
using c::number_of;

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
