#include <algorithm>
#include <atomic>
#include <bit>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/sampler.hpp>

#include "bindings.h"
#include "engine/capacity.hpp"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/job_checks.hpp"
#include "engine/job/plan.hpp"
#include "engine/job/sampler_impl.hpp"
#include "engine/kernels/loop_bounds.hpp"
#include "records.h"
#include "support/guard.hpp"
#include "support/try.hpp"
#include "vk/descriptors.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

/// The buffer that a binding names, be it a second time, as texels.
std::uint32_t buffer_of(std::uint32_t binding) {
    switch (binding) {
    case gpu::kBindPoolTexels:
        return gpu::kBindPool;
    case gpu::kBindOrdersTexels:
        return gpu::kBindOrders;
    case gpu::kBindCellsTexels:
        return gpu::kBindCells;
    default:
        return binding;
    }
}

/// The buffer behind a binding; the scan kernels work on whatever is bound as cells.
std::size_t bound_as(SetRole role, std::uint32_t binding, bool has_cells) {
    const std::uint32_t buffer = buffer_of(binding);
    if (buffer == gpu::kBindCells) {
        switch (role) {
        case SetRole::workspace:
        case SetRole::cell_scan:
            return has_cells ? gpu::kBindCells : gpu::kBindStarts;
        case SetRole::start_scan:
            return gpu::kBindStarts;
        case SetRole::bucket_scan:
            return gpu::kBindBuckets;
        }
    }
    return buffer;
}

/// Returns true if some kernel reads this buffer as texels, by any binding.
bool read_as_texels(std::size_t buffer) {
    for (std::size_t k = 0; k < kKernels; ++k) {
        for (const KernelBinding& binding : interface_of(static_cast<Kernel>(k), true).bindings) {
            for (std::size_t role = 0; role < 2 * kSetRoles; ++role) {
                const bool has_cells = role >= kSetRoles;
                if (binding.type != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER &&
                    bound_as(static_cast<SetRole>(role % kSetRoles), binding.number, has_cells) ==
                        buffer) {
                    return true;
                }
            }
        }
    }
    return false;
}

} // namespace

Job::Job(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Job::Job(Job&&) noexcept = default;
Job& Job::operator=(Job&&) noexcept = default;
Job::~Job() = default;

const RunPlan& Job::plan() const noexcept {
    return impl_->plan;
}

Job::Impl::~Impl() {
    if (sampler->abandoned) {
        return;
    }
    sampler->vk.vkDestroyDescriptorPool(sampler->device.device, descriptor_pool,
                                        sampler->device.host_allocator);
    for (const VkBufferView view : views) {
        destroy_view(view);
    }
}

Result<Done> Job::Impl::choose_kernels(KernelVariant wanted, const RunPlan& for_plan) {
    const bool has_slices = wanted.domain == DomainKind::surface;
    const bool may_group = has_slices && !wanted.records();
    wanted.groups =
        (for_plan.disks_by == DisksBy::groups || for_plan.large_groups > 0) && may_group;
    wanted.trims = for_plan.trims && has_slices;
    wanted.lanes_apart = for_plan.pool_block != sampler->choices.tuning.pool_block && has_slices;
    const auto pipelines = sampler->pipelines.of(wanted);
    GEODISK_TRY(pipelines);
    own_pipelines = *pipelines;
    variant = wanted;
    return Done{};
}

void Job::Impl::apply_plan(const RunPlan& new_plan) {
    plan = new_plan;
    is_pool_divided = true;
    const bool by_groups = plan.disks_by == DisksBy::groups;
    push.slots = plan.slots;
    // Very large disks leave only the slots that disks of equal order need. Disks beyond the groups
    // would then be computed after the others, many of them in vain.
    const bool is_min = by_groups && plan.slots == kMinSlots;
    push.batch = is_min ? std::min(plan.lanes, plan.slots) : plan.batch_slots();
    push.window_capacity = plan.window_capacity;
    push.table_capacity = plan.table_capacity;
    push.list_capacity = plan.list_capacity;
    push.lanes = has_lane_per_slot ? plan.slots : plan.lanes;
    push.lanes_per_group = by_groups ? 1 : sampler->choices.tuning.slot_local_size;
    push.lane_rows = plan.lane_rows();
    push.first_list_row = static_cast<std::uint32_t>(plan.first_list_row());
    KernelVariant of_detect = variant;
    of_detect.groups = by_groups;
    push.step_budget = std::min(plan.step_budget, max_steps(sampler->report, of_detect));
    push.large_groups = variant.groups && !by_groups ? plan.large_groups : 0;
    push.large_after = plan.large_after;
    push.sample_capacity = plan.sample_capacity;
    push.list_groups = std::clamp(plan.dispatch_items / gpu::kSelectBlock, 1u, kMaxGroups);
}

gpu::Push Job::Impl::large_push() const {
    gpu::Push large = push;
    large.lanes = plan.large_groups;
    large.lanes_per_group = 1;
    large.window_capacity = plan.large_window_capacity;
    large.table_capacity = plan.large_table_capacity;
    large.lane_rows = plan.large_rows();
    large.first_slice_row = static_cast<std::uint32_t>(plan.first_large_row());
    large.step_budget =
        std::clamp(push.step_budget / gpu::kGroupStepCost, 1u, max_steps(sampler->report, variant));
    return large;
}

Result<Done> Job::set_plan(const RunPlan& plan) noexcept {
    return guarded([&]() -> Result<Done> {
        if (auto checked = check_plan(plan, *impl_, impl_->workspace[gpu::kBindPool].size);
            !checked) {
            return checked;
        }
        GEODISK_TRY(impl_->choose_kernels(impl_->variant, plan));
        impl_->apply_plan(plan);
        return Done{};
    });
}

Result<Done> Job::set_plan(const RunPlan& plan, const BufferRange& pool) noexcept {
    return guarded([&]() -> Result<Done> {
        Workspace changed = impl_->workspace;
        changed[gpu::kBindPool] = pool;
        if (auto checked =
                check_replacement(changed, gpu::kBindPool, plan.pool_bytes(), *impl_->sampler);
            !checked) {
            return checked;
        }
        GEODISK_TRY(check_plan(plan, *impl_, pool.size));
        GEODISK_TRY(impl_->choose_kernels(impl_->variant, plan));
        GEODISK_TRY(impl_->replace_buffer(gpu::kBindPool, pool));
        impl_->apply_plan(plan);
        return Done{};
    });
}

void Job::Impl::begin_stages(std::uint32_t first, std::uint32_t count) {
    begun = finished = counted = {};
    is_begin_due = true;
    is_count_due = is_stop_counted = false;
    thrown = first == 0 ? 0 : thrown;
    ready = first == 0 ? 0 : ready;
    awaits_cut = constants.capacity > stages.still_wanted(thrown);
    cut.reset();
    chunk_end = (count << gpu::kPriorityBits) + constants.max_lag;
    push.first_stage = first;
    push.stages = count;
    push.intensity = static_cast<float>(stages.per_sample(first) * samples_per_measure);
    push.bucket_shift = static_cast<std::uint32_t>(std::bit_width(chunk_end - 1u)) -
                        static_cast<std::uint32_t>(std::countr_zero(constants.buckets));
    chunk_end = variant.records() ? 0 : chunk_end; // Only existing samples have disks.
    apply_end();
}

void Job::set_end_order(std::uint64_t order) noexcept {
    impl_->end_order = order;
    impl_->apply_end();
}

void Job::Impl::apply_end() {
    const std::uint64_t before = std::uint64_t{push.first_stage} << gpu::kPriorityBits;
    const std::uint64_t wanted = end_order - std::min(end_order, before);
    const auto end = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, chunk_end));
    const std::uint32_t old = std::exchange(push.end_order, awaits_cut ? 0 : end);
    is_end_changed = is_end_changed || push.end_order != old;
}

Result<Done> Job::set_existing(std::span<const gpu::SampleRec> samples) noexcept {
    return guarded([&]() -> Result<Done> {
        GEODISK_TRY(check_existing_records(samples, *impl_));
        impl_->existing = static_cast<std::uint32_t>(samples.size());
        if (impl_->constants.stop_count != kMaxCandidates) {
            impl_->constants.stop_count -= impl_->avoided;
        }
        impl_->avoided = 0;
        // Bounds are those of the samples before.
        impl_->constants.path_rules &= ~gpu::kRuleBounded;
        impl_->begin_first_stages();
        return Done{};
    });
}

std::array<VkDeviceSize, 3> Job::sample_bytes(std::uint32_t capacity) const noexcept {
    return geodisk::sample_bytes(capacity, impl_->constants.buckets);
}

Result<Done> Job::set_samples(std::uint32_t capacity, const BufferRange& samples,
                              const BufferRange& accepted, const BufferRange& buckets) noexcept {
    return guarded([&]() -> Result<Done> {
        const auto bytes = sample_bytes(capacity);
        const std::array<std::pair<std::size_t, BufferRange>, 3> ranges{
            {{gpu::kBindSamples, samples},
             {gpu::kBindAccepted, accepted},
             {gpu::kBindBuckets, buckets}}};
        if (capacity <= impl_->plan.slots) {
            return Error{Status::invalid_argument, "room for " + std::to_string(capacity) +
                                                       " samples is not more than the plan's " +
                                                       std::to_string(impl_->plan.slots) +
                                                       " slots"};
        }
        Workspace changed = impl_->workspace;
        for (const auto& [role, range] : ranges) {
            changed[role] = range;
        }
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            if (auto checked =
                    check_replacement(changed, ranges[i].first, bytes[i], *impl_->sampler);
                !checked) {
                return checked;
            }
        }
        for (const auto& [role, range] : ranges) {
            GEODISK_TRY(impl_->replace_buffer(role, range));
        }
        impl_->plan.sample_capacity = capacity;
        impl_->push.sample_capacity = capacity;
        return Done{};
    });
}

std::uint32_t next_number() noexcept {
    static std::atomic<std::uint32_t> last = 0;
    return ++last;
}

Result<Job> Sampler::make_job(const Domain& domain, const RunPlan& plan,
                              const Workspace& workspace) const noexcept {
    return guarded([&]() -> Result<Job> {
        auto job = std::make_unique<Job::Impl>();
        job->sampler = impl_.get();
        GEODISK_TRY(job->set_out(domain, plan, workspace));
        return Job(std::move(job));
    });
}

Result<Done> Job::renew(const Domain& domain, const RunPlan& plan) noexcept {
    return guarded([&] { return impl_->set_out(domain, plan, impl_->workspace); });
}

void Job::set_seed(std::uint64_t seed) noexcept {
    impl_->set_seed(seed);
    impl_->begin_first_stages();
}

void Job::Impl::set_seed(std::uint64_t seed) {
    constants.seed_low = static_cast<std::uint32_t>(seed);
    constants.seed_high = static_cast<std::uint32_t>(seed >> 32);
}

Result<Done> Job::Impl::set_out(const Domain& of_domain, const RunPlan& new_plan,
                                const Workspace& ranges) {
    GEODISK_TRY(check_plan(new_plan, sampler->choices.tuning));
    const auto needs = needs_of(of_domain, new_plan, sampler->report);
    GEODISK_TRY(needs);
    const Domain::Impl& of = Domain::Impl::of(of_domain);
    if (of.maximal) {
        return Error{Status::invalid_argument,
                     "a maximal set takes several jobs; sample it with Runner"};
    }
    GEODISK_TRY(check_workspace(ranges, *needs, of, *sampler));
    GEODISK_TRY(choose_kernels(sampler->variant_for(of_domain), new_plan));
    number = next_number();
    if (of.settled.size() > new_plan.sample_capacity) {
        return too_many_existing(of.settled.size(), new_plan);
    }
    const bool has_sets = sets_for == variant.domain;
    const bool had_cells = has_cells();
    max_slots = new_plan.slots;
    max_lanes = new_plan.lanes;
    has_lane_per_slot = of.has_lane_per_slot;
    stages = of.stages;
    samples_per_measure = of.samples_per_measure;
    error = of.error;
    dispatches = 0;
    existing = static_cast<std::uint32_t>(of.settled.size());
    avoided = of.avoided;
    classes = of.classes;
    has_shares = of.has_shares;
    push = {};
    constants = {};
    constants.capacity = capacity_for(of.stages, new_plan.stages);
    constants.buckets = bucket_count(constants.capacity);
    constants.faces = static_cast<std::uint32_t>(of.units);
    constants.cells =
        static_cast<std::uint32_t>(of.cells(constants.capacity, new_plan.error_bound));
    set_seed(of.seed);
    constants.stop_count = of.stop_count != 0 ? of.stop_count + avoided : kMaxCandidates;
    constants.idle_capacity = new_plan.idle_capacity;
    of.set_constants(constants, new_plan);
    apply_plan(new_plan);
    begin_first_stages();
    const bool is_bound = has_sets && had_cells == has_cells();
    if (!is_bound) {
        sets_for.reset(); // Until all is bound.
    }
    if (!has_sets) {
        GEODISK_TRY(allocate_sets());
    }
    GEODISK_TRY(bind(ranges, !is_bound));
    sets_for = variant.domain;
    return Done{};
}

/// Returns what a kernel binds; nothing if the job has no use for it.
std::span<const KernelBinding> Job::Impl::bindings_of(std::size_t kernel) const {
    if (!has(kernel)) {
        return {};
    }
    return sampler->pipelines.interface_of(static_cast<Kernel>(kernel)).bindings;
}

/// Binds what has changed, or all.
Result<Done> Job::Impl::bind(const Workspace& ranges, bool all) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (ranges[i] != workspace[i]) {
            GEODISK_TRY(replace_buffer(i, ranges[i]));
        } else if (all && ranges[i].buffer != VK_NULL_HANDLE) {
            write_buffer(i);
        }
    }
    return Done{};
}

void Job::Impl::begin_first_stages() {
    end_order = kAllOrders;
    begin_stages(0, std::min(plan.stages, stages.left(0, 0)));
}

Result<Done> Job::Impl::allocate_sets() {
    const DeviceTable& vk = sampler->vk;
    const VkDevice device = sampler->device.device;
    constexpr std::uint32_t kSets = kSetRoles * kKernels;
    std::vector<VkDescriptorPoolSize> sizes;
    for (std::size_t k = 0; k < kKernels; ++k) {
        for (const KernelBinding& binding : bindings_of(k)) {
            sizes.push_back({binding.type, kSetRoles}); // Those of one type add up.
        }
    }
    if (descriptor_pool != VK_NULL_HANDLE) {
        vk.vkDestroyDescriptorPool(device, std::exchange(descriptor_pool, VK_NULL_HANDLE),
                                   sampler->device.host_allocator);
        sets = {};
    }
    if (auto created = create_descriptor_pool(sampler->device, vk, sizes, kSets, descriptor_pool);
        !created) {
        return created;
    }
    std::vector<std::size_t> kernels;
    std::vector<VkDescriptorSetLayout> layouts;
    for (std::size_t k = 0; k < kKernels; ++k) {
        if (has(k)) {
            kernels.push_back(k);
            layouts.push_back(sampler->pipelines.set_layout(k));
        }
    }
    for (std::uint32_t role = 0; role < kSetRoles; ++role) {
        std::vector<VkDescriptorSet> allocated(layouts.size());
        if (auto done =
                allocate_descriptor_sets(sampler->device, vk, descriptor_pool, layouts, allocated);
            !done) {
            return done;
        }
        for (std::size_t i = 0; i < kernels.size(); ++i) {
            sets[role][kernels[i]] = allocated[i];
        }
    }
    return Done{};
}

Result<VkBufferView> Job::Impl::create_view(std::size_t buffer, const BufferRange& range) const {
    if (range.buffer == VK_NULL_HANDLE || !sampler->reads_texels() || !read_as_texels(buffer)) {
        return VkBufferView{VK_NULL_HANDLE};
    }
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = range.buffer;
    info.format = texel_format(static_cast<std::uint32_t>(buffer));
    info.offset = range.offset;
    info.range = range.size / texel_bytes(info.format) * texel_bytes(info.format);
    VkBufferView view = VK_NULL_HANDLE;
    const VkResult result =
        null_unless_success(sampler->vk.vkCreateBufferView(sampler->device.device, &info,
                                                           sampler->device.host_allocator, &view),
                            view);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateBufferView", result);
    }
    return view;
}

void Job::Impl::destroy_view(VkBufferView view) const {
    sampler->vk.vkDestroyBufferView(sampler->device.device, view, sampler->device.host_allocator);
}

Result<Done> Job::Impl::replace_buffer(std::size_t buffer, const BufferRange& range) {
    auto view = create_view(buffer, range);
    GEODISK_TRY(view);
    workspace[buffer] = range;
    const VkBufferView before = std::exchange(views[buffer], *view);
    if (range.buffer != VK_NULL_HANDLE) {
        write_buffer(buffer);
    }
    if (before != VK_NULL_HANDLE) {
        destroy_view(before);
    }
    return Done{};
}

void Job::Impl::write_buffer(std::size_t buffer) const {
    const VkDescriptorBufferInfo info{workspace[buffer].buffer, workspace[buffer].offset,
                                      workspace[buffer].size};
    for (std::size_t k = 0; k < kKernels; ++k) {
        for (const KernelBinding& binding : bindings_of(k)) {
            for (std::size_t role = 0; role < kSetRoles; ++role) {
                if (bound_as(static_cast<SetRole>(role), binding.number, has_cells()) == buffer) {
                    geodisk::write_buffer(sampler->device, sampler->vk, sets[role][k],
                                          binding.number, binding.type, info, views[buffer]);
                }
            }
        }
    }
}

} // namespace geodisk
