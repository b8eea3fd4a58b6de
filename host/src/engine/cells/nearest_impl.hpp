// NearestSamples::Impl, and how it is made within a run.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <geodisk/nearest.hpp>
#include <geodisk/threads.hpp>

#include "engine/cells/lit_samples.hpp"
#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

struct NearestSamples::Impl {
    std::unique_ptr<LitSamples> samples;
    const PreparedMesh* mesh;
    ThreadOptions threads;
    RunReport report;
    double error;

    /// Does what NearestSamples::create() does, within a run of a runner. `whole` gets the
    /// progress.
    static Task<Result<NearestSamples>> find(Runner::Impl& runner, const PreparedMesh& mesh,
                                             std::span<const Sample> samples,
                                             std::uint64_t max_records, WholeProgress whole = {});
};

} // namespace geodisk
