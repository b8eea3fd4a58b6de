// Checkpoint: what all processes have agreed upon that sample a surface together, to go on from
// later. Experimental.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// The weight 1, in the units of candidates.
inline constexpr std::uint32_t kOneWeight = 1u << 24;

/// A candidate of the host: a point of a face.
struct ListedCandidate {
    std::uint32_t face;
    std::uint32_t weight1, weight2; ///< Weights of the second and third corner, of kOneWeight.

    friend bool operator==(const ListedCandidate&, const ListedCandidate&) = default;
};

/// A candidate and its place in dart order: by stage, then priority, then by face and weights.
struct DrawnCandidate {
    std::uint32_t stage, priority; ///< The priority has gpu::kPriorityBits.
    ListedCandidate point;

    friend bool operator==(const DrawnCandidate&, const DrawnCandidate&) = default;
};

/// Candidates of a surface, whose faces are numbered in the whole.
using Darts = std::vector<DrawnCandidate>;

/// Samples of the stages that are decided, of all processes.
struct Checkpoint {
    /// First stage that is not decided; kNoStage if all are.
    std::uint32_t first_stage = 0;
    /// Candidates of all processes in the stages before. Of a job that is done, those up to the
    /// last sample.
    std::uint64_t candidates = 0;
    Darts samples; ///< In dart order, without those that were given.
};
/// Stage of a checkpoint in which all are decided.
inline constexpr std::uint32_t kNoStage = std::numeric_limits<std::uint32_t>::max();

/// Saves a checkpoint. An error ends the work of all processes.
using SaveCheckpoint = std::function<Result<Done>(const Checkpoint& checkpoint)>;

/// Start of a job and the way it is saved, known to the first process alone.
struct Checkpoints {
    const Checkpoint* from = nullptr; ///< Checkpoint to continue from; null to begin.
    SaveCheckpoint save;              ///< Null if it is not saved.
    std::uint32_t stages = 1;         ///< Stages from one checkpoint to the next, at least 1.
};

/// Returns a digest of a mesh with the radii and the mask of a job, the same however its faces are
/// divided among processes.
GEODISK_API std::uint64_t surface_digest(const PreparedMesh& mesh, const SampleParams& params);

} // namespace geodisk
