#include "engine/run/first_parts.hpp"

#include <algorithm>
#include <cmath>

#include "bindings.h"

namespace geodisk {
namespace {

// Bytes of all buffers of a run, per byte of the mesh and the candidates.
constexpr double kAllBuffers = 3;
// The weights of a candidate.
constexpr double kCandidateBytes = 8;
// Candidates of a stage, beyond which the host would need too much memory.
constexpr double kMostCandidates = 0x1p27;
// Least side of a part, per side with its margins: with less, most work would be done twice or
// more.
constexpr double kLeastSide = 0.4;
// Mean size of a part, of the largest one's.
constexpr double kMeanPart = 0.85;

// Maximum of a part, where the whole is too large for other reasons.
constexpr double kLargestPart = 0.5;

/// Returns the part of a surface, or less, that the device holds; 1 if it holds the mesh, and the
/// caller does not limit its memory.
double held_part(const Runner::Impl& runner, const Domain::Impl& of) {
    const auto bound = static_cast<double>(runner.engine().report.limits.max_storage_buffer_range);
    const auto allowed = static_cast<double>(runner.options.device_bytes);
    const auto held = [&](double largest, double all) {
        const double part = std::min(1.0, bound / largest);
        return allowed > 0 ? std::min(part, allowed / (kAllBuffers * all)) : part;
    };
    const auto faces = static_cast<double>(of.upload_size(BufferRole::faces));
    const auto fans = static_cast<double>(of.upload_size(BufferRole::fans));
    const double candidates = kCandidateBytes * of.stages.expected_at_once(1);
    if (allowed == 0 && held(std::max(faces, fans), faces + fans) == 1) {
        return 1;
    }
    return std::min(held(std::max({faces, fans, candidates}), faces + fans + candidates),
                    kLargestPart);
}

} // namespace

bool is_too_large(const Error& error) {
    // A mesh may leave too little room for disks.
    return error.status == Status::job_too_large || error.status == Status::out_of_device_memory ||
           error.status == Status::workspace_too_small;
}

double reach_with(double of_samples, std::span<const KeepOut> avoid) {
    double reach = of_samples;
    for (const KeepOut& avoided : avoid) {
        reach = std::max(reach, avoided.radius);
    }
    return reach;
}

std::uint32_t first_parts(const Runner::Impl& runner, const Domain::Impl& of,
                          const PreparedMesh& mesh, double reach) {
    if (of.stages.expected_at_once(1) > kMostCandidates) {
        return 0;
    }
    // A part is about a square, with a margin of two reaches on each side.
    const double margins = 4 * reach / std::sqrt(mesh.statistics().area);
    const double part = held_part(runner, of);
    const double largest = std::sqrt(part);
    const bool is_worth_it = part < 1 && largest - margins > kLeastSide * largest;
    const double side = std::sqrt(kMeanPart) * largest - margins;
    const double parts = std::max(2.0, std::ceil(1 / (side * side)));
    return is_worth_it && parts <= mesh.face_count() ? static_cast<std::uint32_t>(parts) : 0;
}

} // namespace geodisk
