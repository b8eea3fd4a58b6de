// Device memory as an engine's allocator hands it out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include <geodisk/device.hpp>

#include "gpu/device_run.hpp"
#include "vk/dispatch.hpp"

namespace geodisk::test {

/// An engine's allocator: one large allocation of each memory type, cut from its front.
class Arena {
  public:
    explicit Arena(const DeviceRefs& refs) : refs_(refs), vk_(expect(load_device_table(refs))) {
        const auto instance =
            expect(load_instance_table(refs.get_instance_proc_addr, refs.instance));
        instance.vkGetPhysicalDeviceMemoryProperties(refs.physical_device, &memory_);
    }
    ~Arena() {
        for (const auto& [type, block] : blocks_) {
            vk_.vkFreeMemory(refs_.device, block.memory, nullptr);
        }
    }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    MemoryHooks hooks() {
        return {this,
                [](void* user, const MemoryRequest& request, MemoryGrant& grant) {
                    return static_cast<Arena*>(user)->allocate(request, grant);
                },
                [](void* user, const MemoryGrant& grant) {
                    auto& granted = static_cast<Arena*>(user)->alive;
                    REQUIRE(granted.erase(grant.allocation) == 1);
                }};
    }

    std::set<void*> alive;
    std::uint32_t asked = 0;
    std::uint32_t fail_from = ~0u; ///< First of those asked that fails.
    bool forget_to_map = false;
    VkDeviceSize largest = 0; ///< Largest size that was asked for.

  private:
    struct Block {
        VkDeviceMemory memory;
        VkDeviceSize used;
        std::byte* mapped;
    };
    static constexpr VkDeviceSize kBytes = VkDeviceSize{128} << 20;

    VkResult allocate(const MemoryRequest& request, MemoryGrant& grant) {
        largest = std::max(largest, request.requirements.size);
        if (asked++ >= fail_from) {
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        std::uint32_t type = 0;
        while ((request.requirements.memoryTypeBits & 1u << type) == 0 ||
               (memory_.memoryTypes[type].propertyFlags & request.required) != request.required) {
            ++type;
        }
        if (blocks_.count(type) == 0) {
            const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, kBytes,
                                            type};
            Block block{};
            REQUIRE(vk_.vkAllocateMemory(refs_.device, &info, nullptr, &block.memory) ==
                    VK_SUCCESS);
            if ((memory_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) !=
                0) {
                void* mapped = nullptr;
                REQUIRE(vk_.vkMapMemory(refs_.device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped) ==
                        VK_SUCCESS);
                block.mapped = static_cast<std::byte*>(mapped);
            }
            blocks_[type] = block;
        }
        Block& block = blocks_[type];
        const VkDeviceSize alignment = request.requirements.alignment;
        const VkDeviceSize offset = (block.used + alignment - 1) / alignment * alignment;
        if (offset + request.requirements.size > kBytes) {
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        block.used = offset + request.requirements.size;
        grant = {block.memory, offset,
                 block.mapped == nullptr || forget_to_map ? nullptr : block.mapped + offset,
                 // NOLINTNEXTLINE(performance-no-int-to-ptr): a name, which nobody follows.
                 reinterpret_cast<void*>(std::uintptr_t{asked})};
        alive.insert(grant.allocation);
        return VK_SUCCESS;
    }

    DeviceRefs refs_;
    DeviceTable vk_;
    VkPhysicalDeviceMemoryProperties memory_{};
    std::map<std::uint32_t, Block> blocks_;
};

} // namespace geodisk::test
