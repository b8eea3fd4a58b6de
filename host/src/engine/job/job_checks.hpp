// Checks of what callers give a job: plans, buffers and samples.
#pragma once

#include <span>

#include <geodisk/sampler.hpp>

#include "engine/job/sampler_impl.hpp"

namespace geodisk {

/// Checks what the shaders rely on without looking.
Result<Done> check_plan(const RunPlan& plan, const Tuning& tuning);
/// Checks a plan for a job that exists, with a pool of so many bytes.
Result<Done> check_plan(const RunPlan& plan, const Job::Impl& job, VkDeviceSize pool);

/// Checks all buffers of a workspace.
Result<Done> check_workspace(const Workspace& workspace, const WorkspaceNeeds& needs,
                             const Domain::Impl& of, const Sampler::Impl& sampler);
/// Checks a range that replaces one of a workspace in use.
Result<Done> check_replacement(const Workspace& workspace, std::size_t role, VkDeviceSize needed,
                               const Sampler::Impl& sampler);

/// Makes the error for more existing samples than the plan has room for.
Error too_many_existing(std::size_t samples, const RunPlan& plan);
/// Checks that existing samples are of the job's domain, and that there is room for them.
Result<Done> check_existing_records(std::span<const gpu::SampleRec> samples, const Job::Impl& job);

} // namespace geodisk
