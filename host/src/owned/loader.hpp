// The Vulkan loader, opened at run time.
#pragma once

#include <vulkan/vulkan_core.h>

#include <geodisk/status.hpp>

namespace geodisk {

/// Keeps the loader library open. Must outlive every Vulkan object made through it.
class Loader {
  public:
    /// Opens the library `path`, or for nullptr the system's loader. Errors: `no_device` with a
    /// hint what to install; `out_of_host_memory`.
    static Result<Loader> open(const char* path = nullptr) noexcept;

    /// Wraps a loader of the caller's: opens and closes nothing.
    explicit Loader(PFN_vkGetInstanceProcAddr function) noexcept
        : get_instance_proc_addr_(function) {}

    Loader(Loader&& other) noexcept;
    Loader& operator=(Loader&& other) noexcept;
    ~Loader();

    PFN_vkGetInstanceProcAddr get_instance_proc_addr() const noexcept {
        return get_instance_proc_addr_;
    }

  private:
    Loader(void* library, PFN_vkGetInstanceProcAddr function) noexcept
        : library_(library), get_instance_proc_addr_(function) {}

    void* library_ = nullptr;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr_ = nullptr;
};

} // namespace geodisk
