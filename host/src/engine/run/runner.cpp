#include <geodisk/runner.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/division.hpp"
#include "engine/run/run.hpp"
#include "engine/run/runner_impl.hpp"
#include "support/guard.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Default target length and stall limit of a submission, in seconds.
constexpr double kSubmissionSeconds = 0.02;
constexpr double kCpuSubmissionSeconds = 0.1;
constexpr double kStallSeconds = 120;
constexpr double kCpuStallSeconds = 600;
// Part of the memory that a run may take, and of a binding, for records of disks.
constexpr double kRecordsOfMemory = 0.2;
constexpr double kRecordsOfBinding = 0.5;

Result<VkQueueFamilyProperties>
check_queue(const InstanceTable& vk, VkPhysicalDevice physical_device, const QueueRef& queue) {
    if (queue.queue == VK_NULL_HANDLE) {
        return Error{Status::invalid_argument, "QueueRef::queue is null"};
    }
    if ((queue.lock == nullptr) != (queue.unlock == nullptr)) {
        return Error{Status::invalid_argument,
                     "QueueRef::lock and QueueRef::unlock must be set both or neither"};
    }
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families.data());
    if (queue.family >= count || (families[queue.family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
        return Error{Status::invalid_argument, "QueueRef::family is " +
                                                   std::to_string(queue.family) +
                                                   ", which is no family with compute"};
    }
    return families[queue.family];
}

/// Checks the times of the options; 0 means the default.
Result<Done> check_seconds(const RunnerOptions& options) {
    const auto check = [](const char* name, double seconds) -> Result<Done> {
        if (seconds >= 0 && std::isfinite(seconds)) {
            return Done{};
        }
        return Error{Status::invalid_argument, std::string("RunnerOptions::") + name + " is " +
                                                   number_text(seconds) + ", neither 0 nor a time"};
    };
    auto checked = check("submission_seconds", options.submission_seconds);
    return checked ? check("stall_seconds", options.stall_seconds) : checked;
}

/// Returns the candidates of a run, as far as they are known.
std::uint32_t candidates_of(const Domain& domain) {
    return static_cast<std::uint32_t>(Domain::Impl::of(domain).stages.candidates());
}

} // namespace

Runner::Impl::Impl(std::shared_ptr<const Sampler> s)
    : shared_sampler(std::move(s)), now([] {
          const auto time = std::chrono::steady_clock::now().time_since_epoch();
          return std::chrono::duration<double>(time).count();
      }) {}

double Runner::Impl::submission_seconds() const {
    return options.submission_seconds > 0 ? options.submission_seconds
           : is_cpu()                     ? kCpuSubmissionSeconds
                                          : kSubmissionSeconds;
}

std::chrono::duration<double> Runner::Impl::stall_limit() const {
    return std::chrono::duration<double>(options.stall_seconds > 0 ? options.stall_seconds
                                         : is_cpu()                ? kCpuStallSeconds
                                                                   : kStallSeconds);
}

Runner::Impl::~Impl() {
    cancel();
    settle();
}

bool Runner::Impl::go_on(std::chrono::milliseconds patience) {
    if (division != nullptr) {
        note(division->progress());
        division->poll(patience);
        return true;
    }
    const bool goes_on = submitter->is_awaited() && submitter->is_over(patience);
    if (goes_on) {
        submitter->resume();
    }
    return goes_on;
}

Runner::Runner(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Runner::Runner(Runner&&) noexcept = default;
Runner& Runner::operator=(Runner&&) noexcept = default;
Runner::~Runner() = default;

void Runner::release_memory() noexcept {
    if (impl_->work == nullptr) {
        impl_->release();
    }
}

const Sampler& Runner::sampler() const noexcept {
    return impl_->sampler;
}

Result<DeviceBuffer> Runner::Impl::allocate(VkDeviceSize bytes, VkBufferUsageFlags usage,
                                            MemoryKind kind) const {
    return DeviceBuffer::create(engine().device, engine().vk, memory, bytes, usage, kind);
}

double Runner::Impl::record_bytes() const {
    auto bytes = static_cast<double>(engine().report.limits.max_storage_buffer_range);
    if (options.device_bytes != 0) {
        bytes = std::min(bytes, kRecordsOfMemory * static_cast<double>(options.device_bytes));
    }
    return kRecordsOfBinding * bytes;
}

std::uint64_t Runner::Impl::bytes_allowed() const {
    std::uint64_t bytes = options.device_bytes != 0 ? options.device_bytes : ~std::uint64_t{0};
    const DeviceRefs& refs = engine().device;
    if (!refs.memory_budget) {
        return bytes;
    }
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
    budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
    VkPhysicalDeviceMemoryProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
    properties.pNext = &budget;
    memory_properties2(refs.physical_device, &properties);
    std::uint64_t max_free = 0;
    bool is_told = false;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        const bool is_local = (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0;
        const VkDeviceSize used = std::min(budget.heapUsage[i], budget.heapBudget[i]);
        is_told = is_told || (is_local && budget.heapBudget[i] > 0);
        max_free = is_local ? std::max(max_free, budget.heapBudget[i] - used) : max_free;
    }
    // Memory that is kept can be used too.
    const std::uint64_t kept = workspace ? workspace->bytes() : 0;
    return is_told ? std::min(bytes, max_free + kept) : bytes;
}

Result<Done> Runner::Impl::submit_timed(const std::function<void(VkCommandBuffer)>& record) {
    if (!clock) {
        return submitter->submit(record);
    }
    return submitter->submit([&](VkCommandBuffer commands) {
        clock->begin(commands);
        record(commands);
    });
}

void Runner::Impl::cancel() noexcept {
    if (work) {
        submitter->give_up();
        work.reset();
        division = nullptr;
        as_whole = nullptr;
    }
}

Result<Runner> Runner::create(const DeviceRefs& device, const QueueRef& queue,
                              const RunnerOptions& options) noexcept {
    return guarded([&]() -> Result<Runner> {
        auto sampler = Sampler::create(device, options.sampler);
        GEODISK_TRY(sampler);
        return create(std::make_shared<const Sampler>(std::move(*sampler)), queue, options);
    });
}

Result<Runner> Runner::create(std::shared_ptr<const Sampler> sampler, const QueueRef& queue,
                              const RunnerOptions& options) noexcept {
    return guarded([&]() -> Result<Runner> {
        if (!sampler) {
            return Error{Status::invalid_argument, "the sampler is null"};
        }
        auto impl = std::make_unique<Impl>(std::move(sampler));
        const DeviceRefs& device = impl->engine().device;
        const DeviceTable& vk = impl->engine().vk;
        const auto instance = load_instance_table(device.get_instance_proc_addr, device.instance);
        GEODISK_TRY(instance);
        const auto family = check_queue(*instance, device.physical_device, queue);
        GEODISK_TRY(family);
        GEODISK_TRY(check_seconds(options));
        impl->options = options;
        if (device.memory_budget) {
            constexpr const char* kName = "vkGetPhysicalDeviceMemoryProperties2";
            impl->memory_properties2 = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(
                device.get_instance_proc_addr(device.instance, kName));
            if (impl->memory_properties2 == nullptr) {
                return Error{Status::device_lacks, std::string("DeviceRefs::memory_budget is set, "
                                                               "but the instance does not provide "
                                                               "the function ") +
                                                       kName};
            }
        }
        instance->vkGetPhysicalDeviceMemoryProperties(device.physical_device, &impl->memory);
        auto submitter = Submitter::create(device, vk, queue, impl->stall_limit());
        GEODISK_TRY(submitter);
        impl->submitter.emplace(std::move(*submitter));
        if (options.time_stages && family->timestampValidBits != 0) {
            auto clock = StageClock::create(device, impl->sampler.report().limits.timestamp_period,
                                            family->timestampValidBits);
            GEODISK_TRY(clock);
            impl->clock.emplace(std::move(*clock));
        }
        if (!impl->engine().rounds_well) {
            GEODISK_TRY(impl->check_rounding());
            impl->engine().rounds_well = true;
        }
        return Runner(std::move(impl));
    });
}

Result<SampleSet> Runner::sample_and_wait(const Domain& domain,
                                          const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SampleSet> {
        return impl_->complete(geodisk::run(*impl_, domain), candidates_of(domain), progress);
    });
}

Result<SampleSet> Runner::sample_and_wait(const PreparedMesh& mesh, const SampleParams& params,
                                          const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SampleSet> {
        const auto domain = Domain::surface(mesh, params);
        GEODISK_TRY(domain);
        return sample_and_wait(*domain, progress);
    });
}

Result<Done> Runner::start(const Domain& domain, const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<Done> {
        return impl_->begin(geodisk::run(*impl_, domain), candidates_of(domain), progress);
    });
}

Result<std::optional<SampleSet>> Runner::poll(std::chrono::milliseconds patience) noexcept {
    return impl_->poll<SampleSet>(patience);
}

void Runner::cancel() noexcept {
    impl_->cancel();
}

Progress Runner::progress() const noexcept {
    return impl_->progress;
}

VkFence Runner::fence() const noexcept {
    return impl_->submitter->is_awaited() ? impl_->submitter->fence() : VK_NULL_HANDLE;
}

} // namespace geodisk
