#include "host_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace geodisk::test {

HostMemory::HostMemory() {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* user, std::size_t size, std::size_t alignment,
                                  VkSystemAllocationScope) -> void* {
        return static_cast<HostMemory*>(user)->allocate(size, alignment);
    };
    callbacks_.pfnReallocation = [](void* user, void* block, std::size_t size,
                                    std::size_t alignment, VkSystemAllocationScope) -> void* {
        return static_cast<HostMemory*>(user)->reallocate(block, size, alignment);
    };
    callbacks_.pfnFree = [](void* user, void* block) {
        static_cast<HostMemory*>(user)->free(block);
    };
}

void* HostMemory::allocate(std::size_t size, std::size_t alignment) {
    // aligned_alloc wants a size that is a multiple of the alignment.
    const std::size_t unit = std::max(alignment, sizeof(void*));
    void* block =
        std::aligned_alloc(unit, (std::max<std::size_t>(size, 1) + unit - 1) / unit * unit);
    const std::lock_guard lock(mutex_);
    if (block != nullptr) {
        sizes_[block] = size;
        ++allocations_;
    }
    return block;
}

void* HostMemory::reallocate(void* block, std::size_t size, std::size_t alignment) {
    if (block == nullptr) {
        return allocate(size, alignment);
    }
    if (size == 0) {
        free(block);
        return nullptr;
    }
    void* larger = allocate(size, alignment);
    if (larger == nullptr) {
        return nullptr; // The old block stays.
    }
    std::size_t old_size = 0;
    {
        const std::lock_guard lock(mutex_);
        const auto found = sizes_.find(block);
        old_size = found != sizes_.end() ? found->second : 0;
    }
    std::memcpy(larger, block, std::min(old_size, size));
    free(block);
    return larger;
}

void HostMemory::free(void* block) {
    if (block == nullptr) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        if (sizes_.erase(block) == 0) {
            ++misuses_;
            return;
        }
    }
    std::free(block);
}

} // namespace geodisk::test
