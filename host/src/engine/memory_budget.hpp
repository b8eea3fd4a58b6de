// Plans that keep to the memory there is.
#pragma once

#include <cstdint>

#include "engine/runner_impl.hpp"

namespace geodisk {

/// The plan for a run of at most so many bytes on the device, staging included: with fewer stages
/// at once and a smaller pool where they are too large otherwise, and with what the caller wants.
/// Errors: `out_of_device_memory` naming the least bytes, as plan_run and workspace_needs.
Result<RunPlan> plan_within(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes);

/// Bytes that a domain uploads.
std::uint64_t upload_bytes(const Sampler& sampler, const Domain& domain);

/// Bytes of a run with such needs, staging included.
std::uint64_t bytes_of(const Sampler& sampler, const Domain& domain, const WorkspaceNeeds& needs);

} // namespace geodisk
