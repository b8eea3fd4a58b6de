// The farthest-point order, within a run.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/farthest.hpp>

#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

/// Returns how many samples are chosen.
inline std::uint32_t chosen_of(std::span<const Sample> samples, const FarthestParams& params) {
    return params.count == 0 ? static_cast<std::uint32_t>(samples.size()) : params.count;
}

/// Orders samples as farthest_order() does, on a mesh that check_farthest_order() finds no fault
/// with. Mesh and samples must outlive it.
Task<Result<FarthestOrder>> order_samples(Runner::Impl& runner, const PreparedMesh& mesh,
                                          std::span<const Sample> samples, FarthestParams params);

} // namespace geodisk
