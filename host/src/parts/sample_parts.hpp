// Samples one surface by several processes: the steps that all take, whatever carries messages.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "parts/checkpoint.hpp"
#include "parts/ranges/ranged_surface.hpp"

namespace geodisk {

/// Returns the process of each face, each with one at least.
using Cut = std::function<Result<std::vector<std::uint32_t>>(
    const PreparedMesh& mesh, const SampleParams& params, std::uint32_t processes)>;

/// Candidates that all processes draw at a time, about; a stage at least.
inline constexpr double kMaxAtOnce = 0x1p26;

/// A surface to sample.
struct WholeSurface {
    const PreparedMesh& mesh;
    const SampleParams& params;
    const Cut& cut;
    double max_candidates = kMaxAtOnce;
    const Checkpoints* checkpoints = nullptr; ///< Null for a job without any.
    const JobFrame* frame = nullptr;          ///< Null for that of the mesh.
    /// Candidates, decided in this order, in place of those that faces draw; empty for the latter.
    std::span<const ListedCandidate> list{};
    bool is_checked = false; ///< The caller knows that the job can be divided.
    /// All parts are of one process, each of which passes it. So none holds its mesh for long.
    bool is_shared = false;
};

/// Samples a surface together with the other processes; all call it. `whole` is null on all but the
/// first one, unless it is shared. Errors, the same on all processes: `invalid_argument` for more
/// processes than faces, and for classes and maximal sets; those of frame_of() and
/// Runner::sample_and_wait(). Throws std::bad_alloc.
GEODISK_API Result<SharedSamples> sample_parts(Exchange& exchange, Runner& runner,
                                               const WholeSurface* whole,
                                               const ProgressCallback& progress = {});

/// Samples a surface that no process holds whole; all call it with the same parameters, of seed,
/// distance and candidates alone. `checkpoints` is null on all but the first process, or for a job
/// without any. Errors, the same on all: `mesh_rejected` for a job that needs the whole; those of
/// sample_parts(). Throws std::bad_alloc.
GEODISK_API Result<SharedSamples>
sample_ranges(Exchange& exchange, Runner& runner, const RangedSurface& surface,
              const SampleParams& params, const Checkpoints* checkpoints = nullptr,
              const ProgressCallback& progress = {}, double max_candidates = kMaxAtOnce);

} // namespace geodisk
