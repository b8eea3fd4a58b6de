#include "checkpoint_folder.hpp"

#include <filesystem>
#include <iostream>

#include "files/output/output_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kGroup = "Checkpoints";

bool is_there(const Path& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

} // namespace

void add_checkpoint_options(Command command, CheckpointOptions& options) {
    const Option folder =
        command.add_option("--checkpoint", options.folder, "DIR",
                           "Save in this folder what is decided, stage by stage", kGroup);
    command
        .add_option("--checkpoint-stages", options.stages, "N",
                    "Stages from one checkpoint to the next (default 1, at most 64)", kGroup)
        .takes_range(1, 64)
        .needs(folder);
    command
        .add_flag("--resume", options.resumes,
                  "Go on from the last checkpoint in the folder, by any number of processes",
                  kGroup)
        .needs(folder);
}

CheckpointFolder::CheckpointFolder(const CheckpointOptions& options, bool is_quiet)
    : folder_(options.folder), stages_(options.stages), resumes_(options.resumes),
      is_quiet_(is_quiet) {
    if (resumes_ && !is_there(path(1))) {
        fail_usage("--resume: " + options.folder +
                   " has no checkpoint; leave --resume out to begin");
    }
    if (!resumes_ && is_there(path(1))) {
        fail_usage(
            "--checkpoint: " + options.folder +
            " has checkpoints of another run; add --resume to go on with it, or remove them");
    }
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) {
        fail_output(options.folder + ": cannot be made: " + error.message());
    }
    check_writable(path(1));
}

Path CheckpointFolder::path(std::uint32_t number) const {
    return folder_ / Path("geodisk-" + std::to_string(number) + ".checkpoint");
}

const Checkpoint* CheckpointFolder::begin(const JobDigests& job) {
    ++number_;
    job_ = job;
    if (!resumes_ || !is_there(path(number_))) {
        return nullptr;
    }
    last_ = read_checkpoint(path(number_), job_);
    if (!is_quiet_) {
        std::cerr << "going on from " << grouped(last_.samples.size()) << " samples of "
                  << (last_.first_stage == kNoStage ? "all stages"
                                                    : counted(last_.first_stage, "stage", "stages"))
                  << '\n';
    }
    return &last_;
}

Done CheckpointFolder::save(const Checkpoint& checkpoint) const {
    write_checkpoint(path(number_), job_, checkpoint);
    return {};
}

void CheckpointFolder::remove() {
    std::error_code ignored;
    for (std::uint32_t number = number_; number > 0; --number) {
        std::filesystem::remove(path(number), ignored);
    }
}

} // namespace geodisk::tools
