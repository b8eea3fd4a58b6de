// One job of a recording engine, in a workspace that it cuts out of its buffer.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "records.h"
#include "support/meshes.hpp"
#include "workshop.hpp"

namespace geodisk::test {

inline constexpr BufferRole kUploaded[] = {BufferRole::faces, BufferRole::fans};

struct Task {
    PreparedMesh mesh;
    SampleParams params;
    Points wanted;

    Domain domain() const { return expect(Domain::surface(mesh, params)); }
};

inline Task task(const Sampler& sampler, const char* shape, int resolution, double count) {
    PreparedMesh mesh = prepared(builtin(shape, resolution));
    const SampleParams params = params_for(mesh, count);
    const Domain domain = expect(Domain::surface(mesh, params));
    const RunPlan plan = expect(sampler.plan_run(domain, Workshop::kPoolBytes));
    auto wanted = float_set(mesh, params, plan.error_bound);
    return {std::move(mesh), params, std::move(wanted)};
}

/// One job of the engine, a few rounds a frame.
class EngineJob {
  public:
    /// With all candidates at once, or those of so many stages.
    EngineJob(Workshop& workshop, const Sampler& sampler, const Task& task,
              std::uint32_t stages = 0)
        : EngineJob(workshop, sampler, task.domain(), stages) {
        wanted_ = task.wanted;
    }
    /// Makes the job of any domain.
    EngineJob(Workshop& workshop, const Sampler& sampler, Domain domain, std::uint32_t stages = 0)
        : workshop_(workshop), sampler_(sampler), domain_(std::move(domain)),
          plan_(expect(sampler.plan_run(domain_, Workshop::kPoolBytes))) {
        plan_.stages = stages != 0 ? stages : plan_.stages;
        const WorkspaceNeeds needs = expect(sampler.workspace_needs(domain_, plan_));
        workspace_ = workshop.cut(needs);
        job_.emplace(expect(sampler.make_job(domain_, plan_, workspace_)));
    }

    /// Through staging, in the frame's command buffer; or zeros, as of an engine that forgets to.
    void record_upload(VkCommandBuffer commands, bool as_zeros = false) {
        std::size_t staged = 0;
        for (const BufferRole role : kUploaded) {
            const std::size_t size = sampler_.upload_size(domain_, role);
            if (size == 0) {
                continue;
            }
            const auto bytes = workshop_.upload_bytes().subspan(staged, size);
            if (as_zeros) {
                std::memset(bytes.data(), 0, size);
            } else {
                expect(sampler_.write_upload(domain_, plan_, role, bytes));
            }
            workshop_.record_upload(commands, range(role), staged, size);
            staged += size;
        }
        workshop_.barrier(commands, Workshop::kUploaded, Sampler::kFirstUse);
    }

    void record_first(VkCommandBuffer commands) {
        record_upload(commands);
        sampler_.record_begin(commands, *job_);
    }

    /// As little as one may in a frame.
    void record_next(VkCommandBuffer commands, const Advice& advice) {
        switch (advice.next) {
        case Next::begin:
            sampler_.record_begin(commands, *job_, 3);
            return;
        case Next::go_on:
            if (!is_begun()) {
                sampler_.record_begin(commands, *job_, 3);
            } else {
                sampler_.record_rounds(commands, *job_, 3);
            }
            return;
        case Next::count:
            sampler_.record_count(commands, *job_, 3);
            return;
        case Next::finish:
            sampler_.record_finish(commands, *job_, 3);
            return;
        case Next::larger_pool:
            expect(job_->set_plan(advice.plan));
            sampler_.record_rewind(commands, *job_);
            return;
        default:
            throw std::runtime_error(to_string(advice.next));
        }
    }

    void record_rounds(VkCommandBuffer commands, std::uint32_t rounds) {
        sampler_.record_rounds(commands, *job_, rounds);
        record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
    }

    void record_last(VkCommandBuffer commands) {
        sampler_.record_finish(commands, *job_);
        record_read(commands, BufferRole::samples, range(BufferRole::samples).size);
    }

    /// The engine's own copy to where the host can read.
    void record_read(VkCommandBuffer commands, BufferRole role, VkDeviceSize size) {
        workshop_.barrier(commands, Sampler::kLastUse, Workshop::kCopied);
        workshop_.record_download(commands, range(role), size);
        workshop_.barrier(commands, Workshop::kCopied, Sampler::kFirstUse);
    }

    gpu::ControlRec control() const {
        gpu::ControlRec control;
        std::memcpy(&control, workshop_.download_bytes().data(), sizeof control);
        return control;
    }

    std::vector<gpu::SampleRec> samples(std::uint32_t accepted) const {
        std::vector<gpu::SampleRec> samples(accepted);
        std::memcpy(samples.data(), workshop_.download_bytes().data(),
                    accepted * sizeof samples[0]);
        return samples;
    }

    void check_samples(std::uint32_t accepted) const {
        Points points;
        for (const gpu::SampleRec& sample : samples(accepted)) {
            points.push_back({sample.face, sample.weight1, sample.weight2});
        }
        CHECK(points == wanted_);
    }

    /// Frames until the samples are there, as many as are returned. The host sees what the device
    /// reports `lag` frames later, as with so many frames in flight.
    std::uint32_t run_frames(std::size_t lag = 0) {
        std::vector<gpu::ControlRec> reports(lag + 1);
        for (std::uint32_t frame = 0; frame < 10'000; ++frame) {
            const gpu::ControlRec seen = reports[frame];
            const Advice advice = expect(job_->advance(seen));
            if (advice.next == Next::complete) {
                workshop_.frame(0, [&](VkCommandBuffer commands) {
                    record_read(commands, BufferRole::samples, range(BufferRole::samples).size);
                });
                return seen.ready;
            }
            workshop_.frame(frame, [&](VkCommandBuffer commands) {
                if (frame == 0) {
                    record_upload(commands);
                }
                record_next(commands, advice);
                record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
            });
            reports.push_back(control());
        }
        throw std::runtime_error("the rounds lead nowhere");
    }

    void run(std::size_t lag = 0) { check_samples(run_frames(lag)); }

    /// Returns true if a begin is recorded to its end.
    bool is_begun() const { return Job::Impl::of(*job_).begun.is_at_start(); }
    Job& job() { return *job_; }
    const Domain& domain() const { return domain_; }
    const Workspace& workspace() const { return workspace_; }
    const RunPlan& plan() const { return plan_; }

  private:
    const BufferRange& range(BufferRole role) const {
        return workspace_[static_cast<std::size_t>(role)];
    }

    Workshop& workshop_;
    const Sampler& sampler_;
    Domain domain_;
    Points wanted_;
    RunPlan plan_;
    Workspace workspace_;
    std::optional<Job> job_;
};

inline Context validated_context() {
    ContextOptions options;
    options.validation = true;
    return expect(Context::create(options));
}

inline void check_silent(const Context& context) {
    CHECK(expect(context.validation_messages()) == std::vector<std::string>{});
}

} // namespace geodisk::test
