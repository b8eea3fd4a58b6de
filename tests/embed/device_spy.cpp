#include "device_spy.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace geodisk::test {
namespace {

DeviceSpy* active = nullptr;

/// A function's name as a template argument.
template <std::size_t kSize>
struct Name {
    char text[kSize];
    consteval Name(const char (&from)[kSize]) { std::copy_n(from, kSize, text); }
};

// NOLINTBEGIN(bugprone-sizeof-expression): of a handle, which may be a pointer.
template <class Handle>
std::uint64_t number_of(Handle handle) {
    std::uint64_t number = 0;
    std::memcpy(&number, &handle, sizeof(Handle));
    return number;
}

template <class Handle>
void make_garbage(Handle& handle) {
    std::memset(&handle, 0x5b, sizeof(Handle));
}
// NOLINTEND(bugprone-sizeof-expression)

// The specification promises a null handle for a pipeline that could not be created.
void make_garbage(VkPipeline& pipeline) {
    pipeline = VK_NULL_HANDLE;
}

} // namespace

struct DeviceSpy::Functions {
    template <class Function>
    static Function real(const char* name) {
        return reinterpret_cast<Function>(active->real_functions_.find(name)->second);
    }

    /// Notes a call and tells what it is to fail with, or VK_SUCCESS.
    static VkResult enter(const char* name) {
        DeviceSpy& spy = *active;
        if (spy.on_call) {
            spy.on_call(name);
        }
        const std::uint32_t number = spy.calls_[name]++;
        std::optional<Fault>& fault = spy.fault_;
        if (!fault || fault->function != name || number < fault->number ||
            (fault->fired && fault->result != VK_ERROR_DEVICE_LOST)) {
            return VK_SUCCESS;
        }
        fault->fired = true;
        return fault->result;
    }

    /// A function that creates nothing, or nothing that has to be destroyed.
    template <Name kName, class Function>
    struct Step;
    template <Name kName, class... Args>
    struct Step<kName, VkResult(VKAPI_PTR*)(Args...)> {
        static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args) {
            const VkResult failure = enter(kName.text);
            return failure != VK_SUCCESS ? failure
                                         : real<VkResult(VKAPI_PTR*)(Args...)>(kName.text)(args...);
        }
    };

    /// A function whose last argument takes the new handle.
    template <Name kName, Name kDestroy, class Function>
    struct Create;
    template <Name kName, Name kDestroy, class... Args>
    struct Create<kName, kDestroy, VkResult(VKAPI_PTR*)(Args...)> {
        static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args) {
            auto* handle = std::get<sizeof...(Args) - 1>(std::tie(args...));
            const VkResult failure = enter(kName.text);
            if (failure != VK_SUCCESS) {
                make_garbage(*handle);
                return failure;
            }
            const VkResult result = real<VkResult(VKAPI_PTR*)(Args...)>(kName.text)(args...);
            if (result == VK_SUCCESS) {
                const VkDevice device = std::get<0>(std::tie(args...));
                const VkAllocationCallbacks* allocator =
                    std::get<sizeof...(Args) - 2>(std::tie(args...));
                keep(device, *handle, allocator);
            }
            return result;
        }

        template <class Handle>
        static void keep(VkDevice device, Handle handle, const VkAllocationCallbacks* allocator) {
            using Function = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);
            active->objects_.push_back(
                {kDestroy.text, number_of(handle),
                 [=] { real<Function>(kDestroy.text)(device, handle, allocator); }});
        }
    };

    template <Name kName, class Function>
    struct Destroy;
    template <Name kName, class Handle>
    struct Destroy<kName, void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
        static VKAPI_ATTR void VKAPI_CALL call(VkDevice device, Handle handle,
                                               const VkAllocationCallbacks* allocator) {
            enter(kName.text);
            if (handle != VK_NULL_HANDLE && forget(kName.text, number_of(handle))) {
                real<void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*)>(kName.text)(
                    device, handle, allocator);
            }
        }
    };

    static bool forget(const char* destroy, std::uint64_t handle) {
        std::vector<Object>& objects = active->objects_;
        const auto found = std::find_if(objects.begin(), objects.end(), [&](const Object& object) {
            return object.handle == handle && std::string_view(object.destroy) == destroy;
        });
        if (found == objects.end()) {
            ++active->strangers_;
            return false;
        }
        objects.erase(found);
        active->mapped_.erase(handle);
        return true;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache,
                                                           std::uint32_t count,
                                                           const VkComputePipelineCreateInfo* infos,
                                                           const VkAllocationCallbacks* allocator,
                                                           VkPipeline* pipelines) {
        active->pipeline_cache_ = cache;
        return Create<"vkCreateComputePipelines", "vkDestroyPipeline",
                      PFN_vkCreateComputePipelines>::call(device, cache, count, infos, allocator,
                                                          pipelines);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device,
                                                   const VkMemoryAllocateInfo* info,
                                                   const VkAllocationCallbacks* allocator,
                                                   VkDeviceMemory* memory) {
        if (info->allocationSize > active->memory_left) {
            ++active->refused;
            make_garbage(*memory);
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        const VkResult result =
            Create<"vkAllocateMemory", "vkFreeMemory", PFN_vkAllocateMemory>::call(
                device, info, allocator, memory);
        if (result == VK_SUCCESS) {
            active->memory_left -= info->allocationSize;
            active->sizes_[number_of(*memory)] = info->allocationSize;
        }
        return result;
    }

    static VKAPI_ATTR void VKAPI_CALL free(VkDevice device, VkDeviceMemory memory,
                                           const VkAllocationCallbacks* allocator) {
        active->memory_left += active->gives_back ? active->sizes_[number_of(memory)] : 0;
        Destroy<"vkFreeMemory", PFN_vkFreeMemory>::call(device, memory, allocator);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice device, VkDeviceMemory memory,
                                              VkDeviceSize offset, VkDeviceSize size,
                                              VkMemoryMapFlags flags, void** data) {
        const VkResult result =
            Step<"vkMapMemory", PFN_vkMapMemory>::call(device, memory, offset, size, flags, data);
        if (result == VK_SUCCESS) {
            const VkDeviceSize all = active->sizes_[number_of(memory)] - offset;
            active->mapped_[number_of(memory)] = {
                static_cast<std::byte*>(*data),
                static_cast<std::size_t>(size == VK_WHOLE_SIZE ? all : size)};
        }
        return result;
    }

    static void tell_dispatch(std::uint32_t groups) {
        if (active->on_dispatch) {
            active->on_dispatch(groups);
        }
    }

    static VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x,
                                               std::uint32_t y, std::uint32_t z) {
        if (x * y * z > 0) {
            tell_dispatch(x * y * z);
        } else {
            ++active->empty_dispatches;
        }
        real<PFN_vkCmdDispatch>("vkCmdDispatch")(commands, x, y, z);
    }

    static VKAPI_ATTR void VKAPI_CALL dispatch_indirect(VkCommandBuffer commands, VkBuffer buffer,
                                                        VkDeviceSize offset) {
        tell_dispatch(0);
        real<PFN_vkCmdDispatchIndirect>("vkCmdDispatchIndirect")(commands, buffer, offset);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, std::uint32_t count,
                                               const VkFence* fences, VkBool32 all,
                                               std::uint64_t timeout) {
        const auto real_wait = real<PFN_vkWaitForFences>("vkWaitForFences");
        const VkResult failure = enter("vkWaitForFences");
        if (failure == VK_ERROR_DEVICE_LOST) {
            // Whoever loses a device may free what it used, so the work has to be over.
            real_wait(device, count, fences, all, std::numeric_limits<std::uint64_t>::max());
        }
        if (failure != VK_SUCCESS) {
            return failure;
        }
        const VkResult result = real_wait(device, count, fences, all, timeout);
        if (result == VK_SUCCESS && active->on_done) {
            std::vector<std::span<std::byte>> mapped;
            for (const auto& [memory, bytes] : active->mapped_) {
                mapped.push_back(bytes);
            }
            active->on_done(mapped);
        }
        return result == VK_SUCCESS && active->never_signal ? VK_TIMEOUT : result;
    }

    static PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
        const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
            active->real_(active->instance_, "vkGetDeviceProcAddr"));
        active->device_ = device;
        active->real_functions_[name] = get(device, name);
        const PFN_vkVoidFunction replacement = find(name);
        return replacement != nullptr ? replacement : active->real_functions_[name];
    }

    static PFN_vkVoidFunction find(std::string_view name);
};

PFN_vkVoidFunction DeviceSpy::Functions::find(std::string_view name) {
#define GEODISK_STEP(f)                                                                            \
    { #f, reinterpret_cast < PFN_vkVoidFunction>(&Step <#f, PFN_##f>::call) }
#define GEODISK_PAIR(f, g)                                                                         \
    {#f, reinterpret_cast<PFN_vkVoidFunction>(&Create<#f, #g, PFN_##f>::call)}, {                  \
#g, reinterpret_cast < PFN_vkVoidFunction>(&Destroy <#g, PFN_##g>::call)                   \
    }
    static const std::map<std::string_view, PFN_vkVoidFunction> kReplacements = {
        GEODISK_PAIR(vkCreateBuffer, vkDestroyBuffer),
        GEODISK_PAIR(vkCreateBufferView, vkDestroyBufferView),
        GEODISK_PAIR(vkCreateShaderModule, vkDestroyShaderModule),
        GEODISK_PAIR(vkCreatePipelineLayout, vkDestroyPipelineLayout),
        GEODISK_PAIR(vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout),
        GEODISK_PAIR(vkCreateDescriptorPool, vkDestroyDescriptorPool),
        GEODISK_PAIR(vkCreateCommandPool, vkDestroyCommandPool),
        GEODISK_PAIR(vkCreateFence, vkDestroyFence),
        GEODISK_PAIR(vkCreateImage, vkDestroyImage),
        GEODISK_PAIR(vkCreateImageView, vkDestroyImageView),
        GEODISK_PAIR(vkCreateRenderPass, vkDestroyRenderPass),
        GEODISK_PAIR(vkCreateFramebuffer, vkDestroyFramebuffer),
        GEODISK_STEP(vkBindImageMemory),
        GEODISK_STEP(vkBindBufferMemory),
        GEODISK_STEP(vkAllocateDescriptorSets),
        GEODISK_STEP(vkAllocateCommandBuffers),
        GEODISK_STEP(vkResetCommandPool),
        GEODISK_STEP(vkBeginCommandBuffer),
        GEODISK_STEP(vkEndCommandBuffer),
        GEODISK_STEP(vkQueueSubmit),
        GEODISK_STEP(vkResetFences),
        {"vkCreateComputePipelines", reinterpret_cast<PFN_vkVoidFunction>(&create_pipelines)},
        {"vkCreateGraphicsPipelines", reinterpret_cast<PFN_vkVoidFunction>(
                                          &Create<"vkCreateGraphicsPipelines", "vkDestroyPipeline",
                                                  PFN_vkCreateGraphicsPipelines>::call)},
        {"vkDestroyPipeline", reinterpret_cast<PFN_vkVoidFunction>(
                                  &Destroy<"vkDestroyPipeline", PFN_vkDestroyPipeline>::call)},
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(&allocate)},
        {"vkFreeMemory", reinterpret_cast<PFN_vkVoidFunction>(&free)},
        {"vkMapMemory", reinterpret_cast<PFN_vkVoidFunction>(&map)},
        {"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(&wait)},
        {"vkCmdDispatch", reinterpret_cast<PFN_vkVoidFunction>(&dispatch)},
        {"vkCmdDispatchIndirect", reinterpret_cast<PFN_vkVoidFunction>(&dispatch_indirect)},
    };
#undef GEODISK_PAIR
#undef GEODISK_STEP
    const auto found = kReplacements.find(name);
    return found != kReplacements.end() ? found->second : nullptr;
}

DeviceSpy::DeviceSpy(PFN_vkGetInstanceProcAddr real) : real_(real) {
    active = this;
}

DeviceSpy::~DeviceSpy() {
    active = nullptr;
}

PFN_vkVoidFunction DeviceSpy::get_instance_proc_addr(VkInstance instance, const char* name) {
    active->instance_ = instance;
    return std::string_view(name) == "vkGetDeviceProcAddr"
               ? reinterpret_cast<PFN_vkVoidFunction>(&Functions::get_device_proc_addr)
               : active->real_(instance, name);
}

void DeviceSpy::fail(const char* function, std::uint32_t number, VkResult result) {
    fault_ = Fault{function, calls(function) + number, result, false};
}

bool DeviceSpy::end_of_fault() {
    const bool fired = fault_ && fault_->fired;
    fault_.reset();
    return fired;
}

std::uint32_t DeviceSpy::calls(std::string_view function) const {
    const auto found = calls_.find(function);
    return found != calls_.end() ? found->second : 0;
}

std::string DeviceSpy::alive() const {
    std::string text;
    for (const Object& object : objects_) {
        text += text.empty() ? "" : " ";
        text += object.destroy;
    }
    return text;
}

void DeviceSpy::destroy_what_is_alive() {
    const auto get =
        reinterpret_cast<PFN_vkGetDeviceProcAddr>(real_(instance_, "vkGetDeviceProcAddr"));
    reinterpret_cast<PFN_vkDeviceWaitIdle>(get(device_, "vkDeviceWaitIdle"))(device_);
    while (!objects_.empty()) {
        objects_.back().destroy_now();
        objects_.pop_back();
    }
}

} // namespace geodisk::test
