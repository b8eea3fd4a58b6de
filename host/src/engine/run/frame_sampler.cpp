#include "geodisk/frame_sampler.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/sampler_impl.hpp"
#include "engine/request/check_fields.hpp"
#include "engine/request/on_mesh.hpp"
#include "engine/run/frame_calls.hpp"
#include "engine/run/frame_growth.hpp"
#include "engine/run/frame_memory.hpp"
#include "engine/run/frame_run.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"

namespace geodisk {
namespace {

Result<Done> check_options(const FrameSamplerOptions& options) {
    if (options.dispatches == 0 || options.rounds == 0 || options.vertices_each == 0) {
        return invalid("FrameSamplerOptions::dispatches, rounds and vertices_each must not be 0");
    }
    return check_frame_options("FrameSamplerOptions", options);
}

/// Makes the one run of all requests.
Result<RequestRuns> one_run_of(std::span<const MeshRequest> requests) {
    if (requests.empty()) {
        return invalid("there are no requests");
    }
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const SampleRequest& request = requests[i].request;
        RequestFields fields = fields_of(request);
        fields.add(RequestField::frames);
        if (const auto checked = check_fields(fields); !checked) {
            return on_mesh(i, requests.size(), checked.error());
        }
        if (request.view == nullptr) {
            return on_mesh(i, requests.size(),
                           invalid("the request has no view, by which samples get their place"));
        }
    }
    auto runs = RequestRuns::create(requests);
    GEODISK_TRY(runs);
    if (runs->job()->first_faces().size() != requests.size() + 1) {
        return invalid("the requests share no run: disks of one have many more faces than those of "
                       "another, or they have darts, classes or a stop count, or are too many");
    }
    return runs;
}

} // namespace

struct FrameSampler::Impl {
    std::shared_ptr<const Sampler> sampler;
    std::optional<RequestRuns> runs; ///< Those of the requests, if there are any.
    const Domain& domain;
    FrameSamplerOptions options;
    FrameMesh mesh;
    std::optional<std::uint64_t> seed; ///< Seed that replaces the domain's.

    std::unique_ptr<FrameMemory> now;
    FrameCalls<std::unique_ptr<FrameMemory>> calls; ///< Calls of record_next().
    std::uint32_t ready = 0;
    bool is_complete = false;

    Impl(std::shared_ptr<const Sampler> with, const Domain& of, const FrameSamplerOptions& given)
        : sampler(std::move(with)), domain(of), options(given), calls(given.frames) {}
    Impl(std::shared_ptr<const Sampler> with, RequestRuns of, const FrameSamplerOptions& given)
        : sampler(std::move(with)), runs(std::move(of)), domain(*runs->job()), options(given),
          calls(given.frames) {}

    const Sampler::Impl& engine() const { return Sampler::Impl::of(*sampler); }

    /// Checks the options, copies the meshes, and allocates the first memory.
    Result<Done> prepare(std::span<const MeshView> meshes);
    /// Replaces the current memory by that of a new plan. Sampling restarts.
    Result<Done> replace(const RunPlan& plan);
    /// Records the next part; the command buffer of `lag` calls ago has completed.
    Result<bool> record_next(VkCommandBuffer commands, std::uint32_t lag);
    Result<Done> record_work(VkCommandBuffer commands, const Advice& advice);
    /// Returns the next step from the latest control record; enlarges memory if needed.
    Result<Advice> look(std::uint32_t lag);
};

Result<Done> FrameSampler::Impl::prepare(std::span<const MeshView> meshes) {
    if (!sampler) {
        return invalid("the sampler is null");
    }
    GEODISK_TRY(check_options(options));
    auto copied = FrameMesh::copy(domain, meshes);
    GEODISK_TRY(copied);
    mesh = std::move(*copied);
    const auto plan = sampler->plan_run(domain, options.pool_bytes);
    GEODISK_TRY(plan);
    return replace(*plan);
}

Result<Done> FrameSampler::Impl::replace(const RunPlan& plan) {
    auto made = FrameMemory::create(*sampler, domain, mesh, plan, options);
    GEODISK_TRY(made);
    if (now) {
        calls.retire(std::move(now));
    }
    now = std::move(*made);
    if (seed) {
        now->job().set_seed(*seed);
    }
    calls.begin_memory();
    is_complete = false;
    ready = 0;
    return Done{};
}

Result<Advice> FrameSampler::Impl::look(std::uint32_t lag) {
    gpu::ControlRec control{}; // Empty.
    if (calls.is_filled(lag)) {
        control = now->control(calls.place(lag));
    }
    const auto next = advance_or_grow(now->job(), control, options.pool_bytes, engine().report);
    GEODISK_TRY(next);
    const Advice& advice = next->advice;
    RunPlan plan = now->plan();
    if (next->outgrown) {
        plan = advice.plan;
    } else if (advice.next == Next::larger_samples) {
        plan.sample_capacity = std::max(plan.sample_capacity, advice.sample_capacity);
    } else {
        ready = advice.ready - std::min(advice.ready, Domain::Impl::of(domain).avoided);
        return advice;
    }
    GEODISK_TRY(replace(plan));
    return now->job().advance({});
}

Result<Done> FrameSampler::Impl::record_work(VkCommandBuffer commands, const Advice& advice) {
    Job& job = now->job();
    switch (advice.next) {
    case Next::begin:
        if (!sampler->record_begin(commands, job, options.dispatches)) {
            return Done{}; // No samples yet.
        }
        break;
    case Next::count:
        if (!sampler->record_count(commands, job, options.dispatches)) {
            return Done{};
        }
        break;
    case Next::larger_pool: // Within the same pool: fewer disks at a time, with more memory each.
        GEODISK_TRY(job.set_plan(advice.plan));
        sampler->record_rewind(commands, job);
        break;
    default:
        sampler->record_rounds(commands, job, options.rounds);
        break;
    }
    sampler->record_finish(commands, job);
    return now->placement().record(commands, job);
}

Result<bool> FrameSampler::Impl::record_next(VkCommandBuffer commands, std::uint32_t lag) {
    if (calls.free_unused(lag)) {
        now->free_staging();
    }
    if (is_complete) {
        calls.end_call();
        return true;
    }
    const auto advice = look(lag);
    GEODISK_TRY(advice);
    if (advice->next == Next::complete) {
        is_complete = true;
        calls.end_call();
        return true;
    }
    const DeviceTable& vk = engine().vk;
    const auto barrier = [&](SyncScope from, SyncScope to) {
        record_barrier(vk, commands, from.stages, from.access, to.stages, to.access);
    };
    barrier({options.readers.stages | kCopies.stages, kCopies.access}, Sampler::kFirstUse);
    if (!calls.is_uploaded()) {
        now->record_upload(vk, commands);
        calls.note_upload();
        barrier(kCopies, {Sampler::kFirstUse.stages | options.readers.stages,
                          Sampler::kFirstUse.access | options.readers.access});
    }
    GEODISK_TRY(record_work(commands, *advice));
    barrier(Sampler::kLastUse,
            {kCopies.stages | options.readers.stages, kCopies.access | options.readers.access});
    now->record_control(vk, commands, calls.place());
    barrier_transfer_to_host(vk, commands);
    calls.end_call();
    return false;
}

Result<FrameSampler> FrameSampler::create(std::shared_ptr<const Sampler> sampler,
                                          const Domain& domain, std::span<const MeshView> meshes,
                                          const FrameSamplerOptions& options) noexcept {
    return guarded([&]() -> Result<FrameSampler> {
        auto impl = std::make_unique<Impl>(std::move(sampler), domain, options);
        GEODISK_TRY(impl->prepare(meshes));
        return FrameSampler(std::move(impl));
    });
}

Result<FrameSampler> FrameSampler::create(std::shared_ptr<const Sampler> sampler,
                                          std::span<const MeshRequest> requests,
                                          const FrameSamplerOptions& options) noexcept {
    return guarded([&]() -> Result<FrameSampler> {
        auto runs = one_run_of(requests);
        GEODISK_TRY(runs);
        std::vector<MeshView> meshes;
        for (const MeshRequest& one : requests) {
            meshes.push_back(*one.request.view);
        }
        auto impl = std::make_unique<Impl>(std::move(sampler), std::move(*runs), options);
        GEODISK_TRY(impl->prepare(meshes));
        return FrameSampler(std::move(impl));
    });
}

FrameSampler::FrameSampler(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
FrameSampler::FrameSampler(FrameSampler&&) noexcept = default;
FrameSampler& FrameSampler::operator=(FrameSampler&&) noexcept = default;
FrameSampler::~FrameSampler() = default;

Result<bool> FrameSampler::record(VkCommandBuffer commands) noexcept {
    return guarded([&]() -> Result<bool> {
        if (commands == VK_NULL_HANDLE) {
            return invalid("the command buffer is null");
        }
        return impl_->record_next(commands, impl_->options.frames);
    });
}

Result<Done> FrameSampler::sample_and_wait(Runner& runner,
                                           const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<Done> {
        return run_frames(*impl_, runner, progress, [&] {
            const auto all = static_cast<std::uint32_t>(impl_->domain.stages().candidates());
            return Progress{0, all, impl_->ready, 0, 0};
        });
    });
}

FrameSamples FrameSampler::samples() const noexcept {
    FrameSamples samples = impl_->now->samples();
    samples.ready = impl_->ready;
    samples.is_complete = impl_->is_complete;
    return samples;
}

void FrameSampler::set_seed(std::uint64_t seed) noexcept {
    impl_->seed = seed;
    impl_->now->job().set_seed(seed);
    impl_->is_complete = false;
    impl_->ready = 0;
}

std::uint64_t FrameSampler::device_bytes() const noexcept {
    std::uint64_t bytes = impl_->now->device_bytes();
    impl_->calls.for_retired([&](const auto& old) { bytes += old->device_bytes(); });
    return bytes;
}

} // namespace geodisk
