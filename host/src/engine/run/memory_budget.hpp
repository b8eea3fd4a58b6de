// Plans that fit the available memory.
#pragma once

#include <cstdint>

#include "engine/run/runner_impl.hpp"

namespace geodisk {

/// A plan, and the device bytes of a run with it, including staging.
struct Fitting {
    RunPlan plan;
    std::uint64_t bytes = 0;
    BufferRole largest = BufferRole::faces; ///< Largest of its buffers.
    std::uint64_t largest_bytes = 0;
    bool fits = false;
};

/// Returns the largest plan of at most `bytes`, with room for at least `samples`. It reduces the
/// stages drawn at once and the pool as needed, and keeps the fields that the caller set. If no
/// plan fits, it returns the smallest one. Errors: those of plan_run and workspace_needs.
Result<Fitting> fit_plan(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                         std::uint32_t samples = 0);

/// Returns fit_plan(), or an error if it does not fit: `out_of_device_memory` naming the minimum.
Result<Fitting> fit_within(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                           std::uint32_t samples = 0);

/// Returns the bytes that a domain uploads.
std::uint64_t upload_bytes(const Sampler& sampler, const Domain& domain);

} // namespace geodisk
