#include "geodisk/job_frame.hpp"

#include <algorithm>
#include <cmath>

#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Disks from so many faces on take vertex events by distance. The rule must not look at the device:
// with the order of work the longest window chain may change, and with it the guard.
constexpr double kHeapFaces = 1u << 14;

Result<JobFrame> frame_in(const PreparedMesh& mesh, const SampleParams& params, const Areas& areas,
                          CandidateSource source) {
    Stages stages = stages_of(mesh, params, areas.taken);
    stages.source = source;
    GEODISK_TRY(check_candidates(mesh, params, stages));
    const MeshStatistics& statistics = mesh.statistics();
    const double full = expected_count(areas.whole, params.min_distance);
    JobFrame frame;
    frame.min_distance = params.min_distance;
    frame.unit = working_distance(mesh, params);
    frame.samples = stages.samples;
    frame.pool_ratio = stages.ratio;
    frame.longest_edge = statistics.longest_edge / frame.unit;
    frame.radii_vary = params.radii != nullptr;
    // No disk covers more than all faces.
    frame.nearest_first =
        2.0 * static_cast<double>(statistics.triangles) / std::max(2.0, full) >= kHeapFaces;
    frame.splits_once = statistics.nonmanifold_edges == 0;
    frame.straight_faces = statistics.diagonal > 0;
    frame.error_bound = ErrorModel(frame).error_of(guessed_chain(mesh, params.min_distance));
    return frame;
}

} // namespace

Result<JobFrame> frame_with(const PreparedMesh& mesh, const SampleParams& params,
                            const Areas& areas) {
    return frame_in(mesh, params, areas, source_of(params.darts));
}

Result<JobFrame> frame_of_disks(const PreparedMesh& mesh, const SampleParams& params) {
    GEODISK_TRY(check_params(mesh, params));
    return frame_in(mesh, params, {whole_area(mesh, params), effective_area(mesh, params)},
                    CandidateSource::targets);
}

bool decide_alike(const JobFrame& a, const JobFrame& b) noexcept {
    const auto deciding = [](JobFrame frame) {
        frame.samples = 0; // Stages of a pool follow from its ratio alone.
        frame.longest_edge = std::ceil(frame.longest_edge); // As ErrorModel takes it.
        return frame;
    };
    return deciding(a) == deciding(b);
}

Result<JobFrame> frame_of(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return guarded([&]() -> Result<JobFrame> {
        GEODISK_TRY(check_params(mesh, params));
        return frame_with(mesh, params, {whole_area(mesh, params), effective_area(mesh, params)});
    });
}

Result<JobFrame> frame_of(const PreparedMesh& mesh, const SampleParams& params,
                          const PreparedMesh& split_from) noexcept {
    auto frame = frame_of(mesh, params);
    SampleParams plain;
    plain.min_distance = params.min_distance;
    auto whole = frame ? frame_of(split_from, plain) : frame;
    if (!whole) {
        return whole;
    }
    frame->longest_edge =
        std::max(frame->longest_edge, whole->longest_edge * whole->unit / frame->unit);
    // A step is 2^-16 of the edges of the smallest parts, where radii change fourfold at most.
    constexpr double kOfRadii = 6 * 0x1p-16;
    frame->error_bound = 2 * std::max(frame->error_bound, whole->error_bound) +
                         (params.radii != nullptr ? kOfRadii : 0);
    return frame;
}

} // namespace geodisk
