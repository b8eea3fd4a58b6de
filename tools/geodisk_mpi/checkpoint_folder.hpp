// The folder of --checkpoint: a file for each surface that a command samples, in their order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <geodisk/checkpoint.hpp>

#include "checkpoint_file.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
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

    /// Begins the next surface. Returns where it begins and how it is saved; valid until the next
    /// call. Throws UserError, as read_checkpoint() does.
    const Checkpoints& begin(const JobDigests& job);

    /// Throws what saving threw, once all processes have ended by it.
    void check() const;

    /// Removes all checkpoints, once their result is written.
    void remove();

  private:
    Path path(std::uint32_t number) const;
    Result<Done> save(const Checkpoint& checkpoint);

    Path folder_;
    bool resumes_, is_quiet_;
    std::uint32_t number_ = 0; ///< Number of the current surface, from 1.
    JobDigests job_;
    Checkpoint last_;
    Checkpoints checkpoints_;
    std::optional<UserError> failure_;
};

} // namespace geodisk::tools
