// The folder of --checkpoint: a file for each surface that a command samples, in their order.
#pragma once

#include <cstdint>
#include <string>

#include <geodisk/checkpoint.hpp>
#include <geodisk/status.hpp>

#include "checkpoint_file.hpp"
#include "program/command.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct CheckpointOptions {
    std::string folder;       ///< "" for no checkpoints.
    std::uint32_t stages = 1; ///< Stages from one to the next.
    bool resumes = false;
};

void add_checkpoint_options(Command command, CheckpointOptions& options);

/// Keeps the checkpoints of a command. A search for a count samples a surface several times; each
/// has a file, so that none is sampled again.
class CheckpointFolder {
  public:
    /// Makes the folder where it is not there. Throws UserError(usage) for checkpoints that are
    /// there but not to be resumed, or the other way round, and UserError(bad_output).
    CheckpointFolder(const CheckpointOptions& options, bool is_quiet);

    /// Begins the next surface. Returns the checkpoint to continue from, or null; valid until the
    /// next call. Throws UserError, as read_checkpoint() does.
    const Checkpoint* begin(const JobDigests& job);
    /// Saves a checkpoint of the surface. Throws UserError(bad_output).
    Done save(const Checkpoint& checkpoint) const;
    /// Returns the number of stages from one checkpoint to the next.
    std::uint32_t stages() const { return stages_; }

    /// Removes all checkpoints, once their result is written.
    void remove();

  private:
    Path path(std::uint32_t number) const;

    Path folder_;
    std::uint32_t stages_;
    bool resumes_, is_quiet_;
    std::uint32_t number_ = 0; ///< Number of the current surface, from 1.
    JobDigests job_;
    Checkpoint last_; ///< Checkpoint to continue from.
};

} // namespace geodisk::tools
