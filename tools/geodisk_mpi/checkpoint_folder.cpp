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
    : folder_(options.folder), resumes_(options.resumes), is_quiet_(is_quiet) {
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
    checkpoints_.stages = options.stages;
}

Path CheckpointFolder::path(std::uint32_t number) const {
    return folder_ / Path("geodisk-" + std::to_string(number) + ".checkpoint");
}

const Checkpoints& CheckpointFolder::begin(const JobDigests& job) {
    ++number_;
    job_ = job;
    checkpoints_.save = [this](const Checkpoint& checkpoint) { return save(checkpoint); };
    checkpoints_.from = nullptr;
    if (resumes_ && is_there(path(number_))) {
        last_ = read_checkpoint(path(number_), job_);
        checkpoints_.from = &last_;
        if (!is_quiet_) {
            std::cerr << "going on from " << grouped(last_.samples.size()) << " samples of "
                      << (last_.first_stage == kNoStage
                              ? "all stages"
                              : counted(last_.first_stage, "stage", "stages"))
                      << '\n';
        }
    }
    return checkpoints_;
}

Result<Done> CheckpointFolder::save(const Checkpoint& checkpoint) {
    try {
        write_checkpoint(path(number_), job_, checkpoint);
        return Done{};
    } catch (const UserError& error) {
        failure_ = error;
        return Error{Status::internal, error.what()};
    }
}

void CheckpointFolder::check() const {
    if (failure_) {
        throw *failure_;
    }
}

void CheckpointFolder::remove() {
    std::error_code ignored;
    for (std::uint32_t number = number_; number > 0; --number) {
        std::filesystem::remove(path(number), ignored);
    }
}

} // namespace geodisk::tools
