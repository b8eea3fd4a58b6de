// Plans that keep to the memory there is.
#pragma once

#include <cstdint>

#include "engine/run/runner_impl.hpp"

namespace geodisk {

/// A plan, and the bytes on the device that a run takes with it, staging included.
struct Fitting {
    RunPlan plan;
    std::uint64_t bytes = 0;
    BufferRole largest = BufferRole::faces; ///< Of its buffers.
    std::uint64_t largest_bytes = 0;
    bool fits = false;
};

/// The largest plan of at most so many bytes, with room for so many samples at least: with fewer
/// stages at once and a smaller pool where they are too large otherwise, and with what the caller
/// wants; or the least plan, if that does not fit. Errors: as plan_run and workspace_needs.
Result<Fitting> fit_plan(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                         std::uint32_t samples = 0);

/// The same, but an error where it does not fit: `out_of_device_memory` naming the least bytes.
Result<Fitting> fit_within(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                           std::uint32_t samples = 0);

/// Bytes that a domain uploads.
std::uint64_t upload_bytes(const Sampler& sampler, const Domain& domain);

} // namespace geodisk
