// Checkpoints as files, which name the mesh and the job that they are of.
#pragma once

#include <cstdint>

#include <geodisk/checkpoint.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/params.hpp>

#include "program/path.hpp"

namespace geodisk::tools {

/// Digests of the job of a checkpoint. They are equal only if all that the samples depend on is
/// equal.
struct JobDigests {
    std::uint64_t mesh = 0;    ///< surface_digest().
    std::uint64_t options = 0; ///< job_digest().
};

/// Returns the digest of parameters in the frame of a job; without radii and masks.
std::uint64_t job_digest(const JobFrame& frame, const SampleParams& params);

/// Writes a checkpoint, in place of one that is there, whole or not at all. Throws
/// UserError(bad_output).
void write_checkpoint(const Path& path, const JobDigests& job, const Checkpoint& checkpoint);

/// Reads a checkpoint of a job. Throws UserError(bad_input) that names the file, if it is damaged,
/// or of another version, mesh or job.
Checkpoint read_checkpoint(const Path& path, const JobDigests& job);

} // namespace geodisk::tools
