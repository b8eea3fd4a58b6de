// Checks that a frame can be used.
#pragma once

#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>

namespace geodisk {

/// Checks that a frame is one that frame_of() may give.
Result<Done> check_values(const JobFrame& frame);

/// Checks that a frame is for these parameters.
Result<Done> check_job(const JobFrame& frame, const SampleParams& params);

/// Returns true if a frame allows for an edited mesh: for its edges, and for paths of any length.
bool fits(const JobFrame& frame, const MeshStatistics& statistics);

/// Checks that a job on a mesh may run in a frame: the frame is for these parameters, and for a
/// mesh that this one may be a part of. Needs parameters that pool_size() accepts.
Result<Done> check_frame(const JobFrame& frame, const PreparedMesh& mesh,
                         const SampleParams& params);

} // namespace geodisk
