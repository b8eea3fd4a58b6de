#include "device_run.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <doctest/doctest.h>

#include "engine/job/plan.hpp"
#include "kernels/resolve.hpp"
#include "vk/barriers.hpp"

namespace geodisk::test {
namespace {

void barrier_to_host(const DeviceTable& vk, VkCommandBuffer commands) {
    record_barrier(vk, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                   VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

} // namespace

Context& shared_context() {
    static Context context = expect(Context::create());
    return context;
}

DeviceRun::DeviceRun(const Domain& domain, const RunPlan& plan, const SamplerOptions& options,
                     const Context& context)
    : device_(context.device()), vk_(expect(load_device_table(device_))),
      sampler_(expect(Sampler::create(device_, options))) {
    submitter_.emplace(
        expect(Submitter::create(device_, vk_, context.queue(), std::chrono::seconds(300))));
    const auto instance =
        expect(load_instance_table(device_.get_instance_proc_addr, device_.instance));
    instance.vkGetPhysicalDeviceMemoryProperties(device_.physical_device, &memory_);
    const RunPlan used =
        overridden(expect(sampler_.plan_run(domain, std::uint64_t{64} << 20)), plan);
    const WorkspaceNeeds needs = expect(sampler_.workspace_needs(domain, used));
    Workspace workspace;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (needs.bytes[i] == 0) {
            continue;
        }
        buffers_[i] = make_buffer(needs.bytes[i]);
        workspace[i] = {buffers_[i].handle(), 0, buffers_[i].size()};
        const auto role = static_cast<BufferRole>(i);
        if (const std::size_t size = sampler_.upload_size(domain, role); size > 0) {
            expect(sampler_.write_upload(domain, used, role, buffers_[i].bytes().first(size)));
        }
    }
    job_.emplace(expect(sampler_.make_job(domain, used, workspace)));
}

void DeviceRun::submit(const std::function<void(VkCommandBuffer)>& record) {
    expect(submitter_->run([&](VkCommandBuffer commands) {
        record(commands);
        barrier_to_host(vk_, commands);
    }));
}

bool DeviceRun::begin(std::uint32_t dispatches) {
    bool is_last = false;
    submit([&](VkCommandBuffer commands) {
        is_last = sampler_.record_begin(commands, *job_, dispatches);
    });
    return is_last;
}

bool DeviceRun::finish(std::uint32_t dispatches) {
    bool is_last = false;
    submit([&](VkCommandBuffer commands) {
        is_last = sampler_.record_finish(commands, *job_, dispatches);
    });
    return is_last;
}

void DeviceRun::rounds(std::uint32_t count) {
    submit([&](VkCommandBuffer commands) { sampler_.record_rounds(commands, *job_, count); });
}

bool DeviceRun::count(std::uint32_t dispatches) {
    bool is_last = false;
    submit([&](VkCommandBuffer commands) {
        is_last = sampler_.record_count(commands, *job_, dispatches);
    });
    return is_last;
}

void DeviceRun::grow() {
    const Advice advice = expect(job_->advance(control()));
    REQUIRE(advice.next == Next::larger_pool);
    follow(advice);
}

bool DeviceRun::follow(const Advice& advice) {
    switch (advice.next) {
    case Next::begin:
        begin();
        return true;
    case Next::count:
        count();
        return true;
    case Next::go_on:
        rounds(1);
        return true;
    case Next::finish:
        finish();
        return true;
    case Next::larger_pool:
        set_plan(advice.plan);
        rewind();
        return true;
    case Next::larger_samples:
        enlarge_samples(advice.sample_capacity);
        rewind();
        return true;
    default:
        return false;
    }
}

Advice DeviceRun::follow_all() {
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const Advice advice = expect(job_->advance(control()));
        if (!follow(advice)) {
            return advice;
        }
    }
    throw std::runtime_error("the advice leads nowhere");
}

void DeviceRun::rewind() {
    submit([&](VkCommandBuffer commands) { sampler_.record_rewind(commands, *job_); });
}

void DeviceRun::enlarge_samples(std::uint32_t capacity) {
    const auto bytes = job_->sample_bytes(capacity);
    std::array<BufferRange, 3> ranges;
    constexpr std::array kRoles{BufferRole::samples, BufferRole::accepted, BufferRole::buckets};
    for (std::size_t i = 0; i < kRoles.size(); ++i) {
        DeviceBuffer& buffer = buffers_[static_cast<std::size_t>(kRoles[i])];
        DeviceBuffer larger = make_buffer(bytes[i]);
        std::copy(buffer.bytes().begin(), buffer.bytes().end(), larger.bytes().begin());
        buffer = std::move(larger);
        ranges[i] = {buffer.handle(), 0, buffer.size()};
    }
    expect(job_->set_samples(capacity, ranges[0], ranges[1], ranges[2]));
}

std::vector<gpu::SlotRec> slots_of(const DeviceRun& run) {
    return run.read<gpu::SlotRec>(BufferRole::control, run.plan().slots, sizeof(gpu::ControlRec));
}

std::vector<PlaceState> states_of(const DeviceRun& run, std::size_t count) {
    const auto words = run.read<std::uint32_t>(BufferRole::orders, (count + 31) / 32 * 2,
                                               std::size_t{4} * run.constants().capacity);
    std::vector<PlaceState> states(count);
    for (std::size_t place = 0; place < count; ++place) {
        const std::uint32_t bit = 1u << place % 32;
        const bool is_undecided = (words[place / 32 * 2] & bit) != 0;
        const bool is_active = (words[place / 32 * 2 + 1] & bit) != 0;
        CHECK((is_undecided || !is_active));
        states[place] = is_active      ? PlaceState::active
                        : is_undecided ? PlaceState::idle
                                       : PlaceState::decided;
    }
    return states;
}

std::vector<std::uint32_t> listed(const DeviceRun& run, std::size_t index, std::uint32_t rank,
                                  const std::vector<std::uint32_t>& by_place) {
    const RunPlan& plan = run.plan();
    const gpu::SlotRec slot = slots_of(run)[index];
    const std::size_t lists = plan.first_list_row() * 16;
    const auto list = run.read<std::uint32_t>(BufferRole::pool, plan.list_capacity,
                                              lists + index * plan.list_capacity * 4);
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t i = 0; i < slot.idle_conflicts; ++i) {
        ranks.push_back(by_place[list[i]]);
    }
    for (std::uint32_t i = 0; i < slot.active_conflicts; ++i) {
        const std::uint32_t other = by_place[list[plan.list_capacity - 1 - i]];
        if (rank == kNoRank || other > rank) {
            ranks.push_back(other);
        }
    }
    std::sort(ranks.begin(), ranks.end());
    return ranks;
}

RunPlan tightened(RunPlan plan) {
    plan.window_capacity = plan.disks_by == DisksBy::groups ? gpu::kMinGroupWindows : 2;
    plan.table_capacity = 4;
    plan.list_capacity = 4;
    return plan;
}

bool decide_batch(DeviceRun& run) {
    gpu::ControlRec control = run.control();
    if (control.done != 0) {
        return false;
    }
    do {
        run.rounds(1);
        control = run.control();
        REQUIRE(control.overflow == 0);
    } while (control.undecided > 0 || control.slots_used > 0);
    return true;
}

namespace {

/// Returns how many are accepted on the device or in `states` alone, by their orders.
std::uint32_t wrongly_accepted(const DeviceRun& run, const std::vector<std::uint8_t>& states,
                               const std::vector<std::uint32_t>& by_place) {
    const gpu::ControlRec control = run.control();
    std::vector<std::uint32_t> found, wanted, wrong;
    for (const gpu::SampleRec& sample :
         run.read<gpu::SampleRec>(BufferRole::accepted, control.accepted - control.settled,
                                  control.settled * sizeof(gpu::SampleRec))) {
        found.push_back(sample.order);
    }
    const auto orders = run.read<std::uint32_t>(BufferRole::orders, by_place.size());
    for (std::uint32_t place = 0; place < by_place.size(); ++place) {
        if (states[by_place[place]] == ref::kAccepted) {
            wanted.push_back(orders[place]);
        }
    }
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    std::set_symmetric_difference(found.begin(), found.end(), wanted.begin(), wanted.end(),
                                  std::back_inserter(wrong));
    return static_cast<std::uint32_t>(wrong.size());
}

} // namespace

std::uint32_t wrong_states(const DeviceRun& run, const std::vector<std::uint8_t>& states,
                           const std::vector<std::uint32_t>& by_place) {
    const auto on_device = states_of(run, by_place.size());
    std::uint32_t wrong = 0;
    for (std::uint32_t place = 0; place < on_device.size(); ++place) {
        const std::uint8_t state = states[by_place[place]];
        wrong += on_device[place] != (state == ref::kIdle     ? PlaceState::idle
                                      : state == ref::kActive ? PlaceState::active
                                                              : PlaceState::decided);
    }
    return wrong + wrongly_accepted(run, states, by_place);
}

} // namespace geodisk::test
