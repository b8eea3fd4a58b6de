#include "session.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <new>
#include <span>
#include <utility>

#include <geodisk/job_frame.hpp>
#include <geodisk/mpi.hpp>
#include <geodisk/version.hpp>

#include "program/command_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Ends all processes by an error of this one.
[[noreturn]] void abort_all(ExitCode code, const std::string& message) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    // In one piece, since others may write as well.
    const std::string line =
        "geodisk_mpi: " + (rank == 0 ? "" : "process " + std::to_string(rank) + ": ") + message +
        '\n';
    std::cerr << line << std::flush;
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    std::_Exit(static_cast<int>(code));
}

Processes all_processes() {
    return take(Processes::create(
        MPI_COMM_WORLD,
        {[] { return !is_interrupted(); },
         [](const Error& error) { abort_all(exit_code_of(error.status), error.message); }}));
}

} // namespace

Session::Session() : process_{all_processes()} {}

Session::~Session() {
    if (is_first() && !is_interrupted()) {
        try {
            together([&] { process_.messages.broadcast(Operations::kCount); });
        } catch (const UserError&) {
            // The others have ended by it as well.
        }
    }
}

void Session::check_arguments(const std::vector<std::string>& arguments) {
    together([&] {
        Messages& messages = process_.messages;
        const std::string own = command_text(GEODISK_VERSION_STRING, arguments);
        const auto of_first = messages.broadcast_all(std::span<const char>(own));
        const auto alike =
            messages.all_gather<std::uint8_t>(std::ranges::equal(own, of_first) ? 1 : 0);
        if (const auto other = std::ranges::find(alike, 0); other != alike.end()) {
            throw SharedError(ExitCode::usage,
                              "process " + std::to_string(other - alike.begin()) +
                                  " was started with other arguments, or another version of the "
                                  "program, than process 0; start all alike");
        }
    });
}

Result<SampleSet> Session::sample(Runner& runner, const RequestStep& step,
                                  const ProgressCallback& progress) {
    Checkpoints checkpoints;
    if (checkpoints_ != nullptr) {
        const std::uint64_t mesh = ranges() != nullptr ? ranges()->statistics().digest
                                                       : surface_digest(*step.surface, step.params);
        const JobFrame frame = take(ranges() != nullptr ? ranges()->frame(step.params)
                                                        : frame_of(*step.surface, step.params));
        checkpoints.from = checkpoints_->begin({mesh, job_digest(frame, step.params)});
        checkpoints.stages = checkpoints_->stages();
        checkpoints.save = [this](const Checkpoint& checkpoint) {
            return process_.messages.caught([&] { return checkpoints_->save(checkpoint); });
        };
    }
    auto result = call<sample_together>(
        SampleCall{runner, step, checkpoints_ != nullptr ? &checkpoints : nullptr, progress});
    if (!result) {
        Error error = result.error();
        if (ranges() != nullptr && error.status == Status::job_too_large) {
            error.message += ", or raise --parts";
        }
        return error;
    }
    processes_ = std::move(result->processes);
    return std::move(result->set);
}

void Session::end_all(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::bad_alloc&) {
        abort_all(ExitCode::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        abort_all(ExitCode::internal, error.what());
    }
}

void Session::help(const SampleJob* job) {
    process_.job = job;
    while (!has_ended_) {
        has_ended_ = true; // Unless there is more to do.
        try {
            together([&] {
                const std::uint8_t number = process_.messages.broadcast(Operations::kCount);
                has_ended_ = number == Operations::kCount;
                if (!has_ended_) {
                    Operations::help(number, process_);
                }
            });
        } catch (const UserError&) {
            // The first process tells of errors.
        }
    }
    process_.job = nullptr;
}

} // namespace geodisk::tools
