// Stands between geodisk and a device: counts its calls, fails one of them, follows what is created
// and destroyed, and tampers with fences and mapped memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk::test {

/// Since Vulkan's functions carry no user pointer, one object may exist at a time. It watches one
/// device, used by one thread, through DeviceRefs whose get_instance_proc_addr is this one's.
///
/// A call that is made to fail leaves the worst that Vulkan allows: a garbage handle, unless the
/// specification promises a null one.
class DeviceSpy {
  public:
    explicit DeviceSpy(PFN_vkGetInstanceProcAddr real);
    ~DeviceSpy();
    DeviceSpy(const DeviceSpy&) = delete;
    DeviceSpy& operator=(const DeviceSpy&) = delete;

    static PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name);

    /// Lets call `number` (from 0, counted from now) of `function` fail with `result`, and for
    /// VK_ERROR_DEVICE_LOST every later one.
    void fail(const char* function, std::uint32_t number, VkResult result);
    /// Returns true if that happened. Nothing fails any more after this.
    bool end_of_fault();

    std::uint32_t calls(std::string_view function) const;
    /// Called before each call that is watched.
    std::function<void(std::string_view)> on_call;

    /// Called for each dispatch with its work groups, 0 where the device alone knows them. Not
    /// called for those of no work groups, which only have kernels compiled.
    std::function<void(std::uint32_t)> on_dispatch;
    std::uint32_t empty_dispatches = 0; ///< Those of no work groups.

    bool never_signal = false; ///< Waiting for a fence times out, though the work ends.
    VkDeviceSize memory_left = std::numeric_limits<VkDeviceSize>::max();
    std::uint32_t refused = 0; ///< Allocations of more than that.
    bool gives_back = false;   ///< True if what is freed adds to the memory left.
    /// Called with what is mapped, after the work that a fence stood for has ended.
    std::function<void(std::span<const std::span<std::byte>>)> on_done;

    /// Returns the cache that the last pipeline was created with.
    VkPipelineCache pipeline_cache() const { return pipeline_cache_; }

    /// The functions that would destroy what is still alive, "vkDestroyFence vkFreeMemory".
    std::string alive() const;
    /// Handles destroyed that nobody created, or twice.
    std::uint32_t strangers() const { return strangers_; }
    /// Waits for the work of the device, and destroys what is alive, as nobody else can.
    void destroy_what_is_alive();

  private:
    struct Functions; // The replacements.
    struct Fault {
        std::string function;
        std::uint32_t number;
        VkResult result;
        bool fired;
    };
    struct Object {
        const char* destroy; ///< Name of the function that does.
        std::uint64_t handle;
        std::function<void()> destroy_now;
    };

    PFN_vkGetInstanceProcAddr real_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::map<std::string, PFN_vkVoidFunction, std::less<>> real_functions_;
    std::map<std::string, std::uint32_t, std::less<>> calls_;
    std::optional<Fault> fault_;
    std::vector<Object> objects_;
    std::map<std::uint64_t, std::span<std::byte>> mapped_; ///< By memory.
    std::map<std::uint64_t, VkDeviceSize> sizes_;          ///< Sizes of memory.
    std::uint32_t strangers_ = 0;
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
};

} // namespace geodisk::test
