#include "engine/domain/stages.hpp"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "engine/domain/classes.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/tolerances.hpp"

namespace geodisk {
namespace {

constexpr double kMaxDartsOfStage = 0x1p23;
constexpr double kMaxDartsPerSample = 640;
// Candidates of a small face, in the mean over all candidates. By measurement.
constexpr double kMaxInSmallFace = 24;

} // namespace

std::uint32_t Stages::pool_stages() const noexcept {
    if (max_stages != 0) {
        return max_stages;
    }
    return static_cast<std::uint32_t>(
        std::clamp(std::ceil(ratio / kStageRatio), 1.0, double{kMaxPoolStages}));
}

double Stages::per_sample(std::uint32_t stage) const noexcept {
    if (!is_counted()) {
        return ratio / pool_stages();
    }
    double per_sample = kStageRatio;
    const double whole = of_whole > 0 ? of_whole : samples;
    const double most = std::min(kMaxDartsPerSample, kMaxDartsOfStage / whole);
    while (per_sample >
           most) { // By powers of two, so that an edit of the mesh hardly ever changes it.
        per_sample /= 2;
    }
    for (std::uint32_t s = 0; s < stage && 2 * per_sample <= most; ++s) {
        per_sample *= 2;
    }
    return std::max(per_sample, kMinPool / whole);
}

std::uint32_t Stages::left(std::uint32_t done, std::uint64_t drawn) const noexcept {
    if (is_counted()) {
        return drawn < darts ? 1 : 0;
    }
    return pool_stages() - std::min(done, pool_stages());
}

std::uint64_t Stages::still_wanted(std::uint64_t drawn) const noexcept {
    return is_counted() ? darts - std::min<std::uint64_t>(drawn, darts) : ~std::uint64_t{0};
}

double Stages::expected_at_once(std::uint32_t stages) const noexcept {
    if (!is_counted()) {
        return std::min(stages * expected(0), pool());
    }
    // The last that there may be is the largest.
    double last = 0, all = 0;
    for (std::uint32_t s = 0; all < 2.0 * darts && s < gpu::kMaxDartStages; ++s) {
        last = expected(s);
        all += last;
    }
    return last;
}

double pool_ratio_of(double asked, double samples) {
    return std::max(asked, kMinPool / samples);
}

Stages stages_of(const PreparedMesh& mesh, const SampleParams& params) {
    return stages_of(mesh, params, effective_area(mesh, params));
}

Stages stages_of(const PreparedMesh& mesh, const SampleParams& params, double area) {
    // A distance beyond all those of the mesh is as good as one just beyond.
    const double samples = expected_count(area, working_distance(mesh, params));
    return {samples, pool_ratio_of(params.pool_ratio, samples), params.darts};
}

Stages stages_in(const JobFrame& frame, const SampleParams& params) {
    return {frame.samples, frame.pool_ratio, params.darts};
}

Stages stages_in(const JobFrame& frame, const PreparedMesh& mesh, const SampleParams& params) {
    Stages stages{expected_count(effective_area(mesh, params), frame.unit), frame.pool_ratio,
                  params.darts};
    stages.of_whole = frame.samples;
    return stages;
}

double samples_per_area() noexcept {
    return expected_count(1, 1);
}

float stage_intensity(const Stages& stages, std::uint32_t stage, double density) {
    return static_cast<float>(stages.per_sample(stage) * (samples_per_area() * density));
}

double expected_in_face(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t face,
                        double per_area) {
    if (!takes_samples(params, face)) {
        return 0;
    }
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    const double density =
        params.radii != nullptr ? params.radii->densities()[face] : class_density(params);
    return per_area * 0.5 * edge.length * edge.apex_y * density;
}

void FaceCrowding::add(const PreparedMesh& mesh, const SampleParams& params, const Stages& stages) {
    const double per_area = stages.candidates() / effective_area(mesh, params);
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const double expected = expected_in_face(mesh, params, face, per_area);
        sum_ += expected;
        squares_ += expected * expected;
    }
}

bool FaceCrowding::is_small() const noexcept {
    return squares_ <= kMaxInSmallFace * sum_;
}

bool has_small_faces(const PreparedMesh& mesh, const SampleParams& params) {
    FaceCrowding crowding;
    crowding.add(mesh, params, stages_of(mesh, params));
    return crowding.is_small();
}

} // namespace geodisk
