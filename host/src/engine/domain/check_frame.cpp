#include "engine/domain/check_frame.hpp"

#include <cmath>
#include <string>

#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// A distance must be known better than that.
constexpr double kLargestError = 0.5;

bool is_positive(double value) {
    return value > 0 && std::isfinite(value);
}

Error bad(const std::string& what) {
    return invalid("the job frame is damaged: " + what + "; make it again with frame_of()");
}

Error unlike(const std::string& what) {
    return invalid("the job frame is for another job: " + what);
}

} // namespace

Result<Done> check_values(const JobFrame& frame) {
    if (!is_positive(frame.min_distance)) {
        return bad("its minimum distance must be positive and finite");
    }
    if (!(frame.unit > 0 && frame.unit <= frame.min_distance)) {
        return bad("its unit must be positive and at most the minimum distance");
    }
    if (frame.radii_vary && frame.unit != frame.min_distance) {
        return bad("where radii vary, its unit must be the minimum distance");
    }
    if (!is_positive(frame.samples)) {
        return bad("its number of samples must be positive and finite");
    }
    if (!(frame.pool_ratio >= 1 && frame.pool_ratio <= kLargestRatio)) {
        return bad("its pool ratio must be 1 to " + number_text(kLargestRatio));
    }
    if (!(frame.longest_edge > 0 && frame.longest_edge <= kLongestEdge)) {
        return bad("its longest edge must be at most " + number_text(kLongestEdge) + " units");
    }
    if (!(frame.error_bound >= ErrorModel(frame).error_of(1) &&
          frame.error_bound <= kLargestError)) {
        return bad("its error bound must be that of a path, at most " + number_text(kLargestError));
    }
    return Done{};
}

Result<Done> check_job(const JobFrame& frame, const SampleParams& params) {
    GEODISK_TRY(check_values(frame));
    if (frame.min_distance != params.min_distance) {
        return unlike("its minimum distance is " + exact_text(frame.min_distance) + ", not " +
                      exact_text(params.min_distance));
    }
    if (frame.radii_vary != (params.radii != nullptr)) {
        return unlike(frame.radii_vary ? "its radii vary" : "its radii do not vary");
    }
    if (frame.pool_ratio != pool_ratio_of(params.pool_ratio, frame.samples)) {
        return unlike("its pool ratio is not that of these parameters, " +
                      exact_text(params.pool_ratio));
    }
    return Done{};
}

bool fits(const JobFrame& frame, const MeshStatistics& statistics) {
    return frame.unit == frame.min_distance &&
           statistics.longest_edge / frame.unit <= frame.longest_edge &&
           (statistics.nonmanifold_edges == 0 || !frame.splits_once);
}

Result<Done> check_frame(const JobFrame& frame, const PreparedMesh& mesh,
                         const SampleParams& params) {
    GEODISK_TRY(check_job(frame, params));
    const MeshStatistics& statistics = mesh.statistics();
    if (statistics.longest_edge / frame.unit > frame.longest_edge) {
        return unlike("its mesh has no edge as long as the longest one of this mesh, " +
                      number_text(statistics.longest_edge));
    }
    if (frame.splits_once && statistics.nonmanifold_edges != 0) {
        return unlike("its mesh has no edges of more than two faces, this one has");
    }
    if (frame.straight_faces && !(statistics.diagonal > 0)) {
        return unlike("its mesh has coordinates, this one is given by edge lengths");
    }
    // Within a part paths may be longer than across the whole.
    if (frame.unit < frame.min_distance && frame.unit < working_distance(mesh, params)) {
        return unlike("its unit, " + number_text(frame.unit) +
                      ", is shorter than paths of this mesh may be");
    }
    return Done{};
}

} // namespace geodisk
