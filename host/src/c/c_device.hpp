// Devices of the C API.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include <geodisk/context.hpp>
#include <geodisk/geodisk.h>
#include <geodisk/sampler.hpp>

namespace geodisk::c {

/// Adapts the caller's memory functions to MemoryHooks.
class LentMemory {
  public:
    explicit LentMemory(const geodisk_vulkan_device& lent)
        : user_(lent.memory_user), allocate_(lent.allocate), free_(lent.free) {}
    LentMemory(const LentMemory&) = delete;
    LentMemory& operator=(const LentMemory&) = delete;

    const MemoryHooks* hooks() const noexcept { return &hooks_; }

  private:
    static VkResult allocate(void* self, const MemoryRequest& request, MemoryGrant& grant);
    static void free(void* self, const MemoryGrant& grant);

    void* user_;
    decltype(geodisk_vulkan_device::allocate) allocate_;
    decltype(geodisk_vulkan_device::free) free_;
    MemoryHooks hooks_{this, &allocate, &free};
};

/// A device that geodisk opened, or a borrowed one.
class Device {
  public:
    explicit Device(Context context)
        : context_(std::move(context)), refs_(context_->device()), queue_(context_->queue()),
          report_(context_->report()) {}
    /// `memory` may be null.
    Device(const DeviceRefs& refs, const QueueRef& queue, DeviceReport report,
           std::unique_ptr<const LentMemory> memory)
        : memory_(std::move(memory)), refs_(refs), queue_(queue), report_(std::move(report)) {
        refs_.memory_hooks = memory_ ? memory_->hooks() : nullptr;
    }

    const QueueRef& queue() const noexcept { return queue_; }
    const DeviceReport& report() const noexcept { return report_; }

    /// Returns the shared sampler; compiles it at the first call.
    Result<std::shared_ptr<const Sampler>> sampler() const;

    /// Fails if the validation layer is on and reported messages.
    Result<Done> check_validation() const;

  private:
    std::optional<Context> context_;
    std::unique_ptr<const LentMemory> memory_;
    DeviceRefs refs_;
    QueueRef queue_;
    DeviceReport report_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Sampler> sampler_;
};

} // namespace geodisk::c

struct geodisk_device {
    std::shared_ptr<const geodisk::c::Device> shared;
};
