#include "c/c_device.hpp"

#include <string>
#include <utility>
#include <vector>

#include "c/c_call.hpp"
#include "c/c_handles.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

geodisk_device_info info_of(const DeviceReport& report) {
    geodisk_device_info info{};
    info.is_usable = report.usable() ? 1 : 0;
    info.type = static_cast<std::uint32_t>(report.type);
    info.vendor_id = report.vendor_id;
    info.device_id = report.device_id;
    info.api_version = report.api_version;
    info.driver_version = report.driver_version;
    info.compute_queue_family = report.compute_queue_family.value_or(GEODISK_NO_QUEUE_FAMILY);
    info.graphics_queue_family = report.graphics_queue_family.value_or(GEODISK_NO_QUEUE_FAMILY);
    info.memory_bytes = report.largest_device_local_heap;
    std::copy(report.uuid.begin(), report.uuid.end(), info.uuid);
    copy_text(report.name, info.name);
    copy_text(report.driver_name + (report.driver_info.empty() ? "" : " " + report.driver_info),
              info.driver);
    std::string reasons;
    for (const std::string& reason : report.reasons_against) {
        reasons += (reasons.empty() ? "" : "\n") + reason;
    }
    copy_text(reasons, info.reasons);
    return info;
}

PFN_vkGetInstanceProcAddr loader_of(void (*function)(void)) {
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(function);
}

} // namespace

VkResult LentMemory::allocate(void* self, const MemoryRequest& request, MemoryGrant& grant) {
    const auto& own = *static_cast<const LentMemory*>(self);
    geodisk_memory_request asked{};
    asked.struct_size = sizeof asked;
    asked.buffer = number_of(request.buffer);
    asked.bytes = request.requirements.size;
    asked.alignment = request.requirements.alignment;
    asked.memory_types = request.requirements.memoryTypeBits;
    asked.required = request.required;
    asked.preferred = request.preferred;
    geodisk_memory_grant given{};
    given.struct_size = sizeof given;
    const auto result = static_cast<VkResult>(own.allocate_(own.user_, &asked, &given));
    if (result == VK_SUCCESS) {
        grant.memory = handle_of<VkDeviceMemory>(given.memory);
        grant.offset = given.offset;
        grant.mapped = given.mapped;
        grant.allocation = given.allocation;
    }
    return result;
}

void LentMemory::free(void* self, const MemoryGrant& grant) {
    const auto& own = *static_cast<const LentMemory*>(self);
    geodisk_memory_grant given{};
    given.struct_size = sizeof given;
    given.memory = number_of(grant.memory);
    given.offset = grant.offset;
    given.mapped = grant.mapped;
    given.allocation = grant.allocation;
    own.free_(own.user_, &given);
}

Result<std::shared_ptr<const Sampler>> Device::sampler() const {
    const std::lock_guard lock(mutex_);
    if (!sampler_) {
        auto created = Sampler::create(refs_);
        if (!created) {
            return std::move(created).error();
        }
        sampler_ = std::make_shared<const Sampler>(std::move(*created));
    }
    return sampler_;
}

Result<Done> Device::check_validation() const {
    if (!context_ || context_->validation_message_count() == 0) {
        return Done{};
    }
    const auto messages = context_->validation_messages();
    GEODISK_TRY(messages);
    return Error{Status::internal,
                 std::to_string(context_->validation_message_count()) +
                     " messages of the validation layer, the first: " + messages->front()};
}

} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_list_devices(geodisk_device_info* infos, size_t capacity, size_t* count,
                                    geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (count == nullptr || (infos == nullptr && capacity > 0)) {
            return wrong("infos or count is NULL");
        }
        const auto reports = list_devices();
        GEODISK_TRY(reports);
        for (std::size_t i = 0; i < reports->size() && i < capacity; ++i) {
            geodisk_device_info* const info = element_of(infos, i);
            info->struct_size = infos->struct_size;
            const auto given = give(info, "infos", info_of((*reports)[i]));
            GEODISK_TRY(given);
        }
        *count = reports->size();
        return Done{};
    });
}

geodisk_status geodisk_device_open(const geodisk_device_options* options, geodisk_device** device,
                                   geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr) {
            return wrong("device is NULL");
        }
        const auto given = taken_if_any(options, "options");
        GEODISK_TRY(given);
        ContextOptions wanted;
        wanted.device = given->device != nullptr ? given->device : "";
        wanted.validation = given->validation != 0;
        wanted.keep_pipelines = given->keep_pipelines != 0;
        auto context = Context::create(wanted);
        GEODISK_TRY(context);
        *device = new geodisk_device{std::make_shared<const Device>(std::move(*context))};
        return Done{};
    });
}

geodisk_status geodisk_device_borrow(const geodisk_vulkan_device* lent, geodisk_device** device,
                                     geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr) {
            return wrong("device is NULL");
        }
        const auto given = taken(lent, "lent");
        GEODISK_TRY(given);
        if (given->instance == nullptr || given->physical_device == nullptr ||
            given->device == nullptr || given->queue == nullptr ||
            given->get_instance_proc_addr == nullptr) {
            return wrong("a handle of lent, or get_instance_proc_addr, is NULL");
        }
        if ((given->lock == nullptr) != (given->unlock == nullptr)) {
            return wrong("lent->lock and lent->unlock go together");
        }
        if ((given->allocate == nullptr) != (given->free == nullptr)) {
            return wrong("lent->allocate and lent->free go together");
        }
        DeviceRefs refs;
        refs.instance = static_cast<VkInstance>(given->instance);
        refs.physical_device = static_cast<VkPhysicalDevice>(given->physical_device);
        refs.device = static_cast<VkDevice>(given->device);
        refs.get_instance_proc_addr = loader_of(given->get_instance_proc_addr);
        refs.api_version = given->api_version != 0 ? given->api_version : VK_API_VERSION_1_1;
        refs.pipeline_cache = handle_of<VkPipelineCache>(given->pipeline_cache);
        refs.memory_budget = given->memory_budget != 0;
        refs.debug_utils = given->debug_utils != 0;
        refs.host_allocator = static_cast<const VkAllocationCallbacks*>(given->host_allocator);
        QueueRef queue;
        queue.queue = static_cast<VkQueue>(given->queue);
        queue.family = given->queue_family;
        queue.lock_user = given->lock_user;
        queue.lock = given->lock;
        queue.unlock = given->unlock;
        auto report =
            query_device(refs.get_instance_proc_addr, refs.instance, refs.physical_device);
        GEODISK_TRY(report);
        auto memory =
            given->allocate != nullptr ? std::make_unique<const LentMemory>(*given) : nullptr;
        *device = new geodisk_device{
            std::make_shared<const Device>(refs, queue, std::move(*report), std::move(memory))};
        return Done{};
    });
}

geodisk_status geodisk_query_device(void (*get_instance_proc_addr)(void), void* instance,
                                    void* physical_device, geodisk_device_info* info,
                                    geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        const auto report =
            query_device(loader_of(get_instance_proc_addr), static_cast<VkInstance>(instance),
                         static_cast<VkPhysicalDevice>(physical_device));
        GEODISK_TRY(report);
        return give(info, "info", info_of(*report));
    });
}

geodisk_status geodisk_device_describe(const geodisk_device* device, geodisk_device_info* info,
                                       geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr) {
            return wrong("device is NULL");
        }
        return give(info, "info", info_of(device->shared->report()));
    });
}

void geodisk_device_release(geodisk_device* device) {
    delete device;
}

} // extern "C"
