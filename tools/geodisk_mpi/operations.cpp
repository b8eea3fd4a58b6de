#include "operations.hpp"

#include <utility>

#include <geodisk/mpi.hpp>
#include <geodisk/params.hpp>

#include "geodisk/outputs/progress.hpp"
#include "geodisk/sample_run.hpp"
#include "messages.hpp"
#include "ply_range.hpp"
#include "process.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/path.hpp"

namespace geodisk::tools {
namespace {

/// Returns what a job takes from a mesh file that all read in ranges; nothing without a job.
RangeWants wants_of(const SampleJob* job) {
    return job != nullptr
               ? RangeWants{job->density.source(), job->mask.mask_rules(), !job->min_distance}
               : RangeWants();
}

/// Opens the device of a process other than the first one. Throws UserError.
Done open_own_device(Process& process) {
    if (process.job == nullptr) {
        throw UserError(ExitCode::internal, "its arguments are none");
    }
    if (!process.device) {
        process.device = device_for(*process.job);
    }
    ProgressLine quiet(true);
    process.device->open(quiet);
    return {};
}

} // namespace

std::optional<std::string> read_ranges(Process& process, const ReadCall* call) {
    const SampleJob* const job = call != nullptr ? &call->job : process.job;
    const Path path(job != nullptr ? job->mesh.mesh : "");
    const RangeWants wants = wants_of(job);
    const std::uint32_t parts = process.messages.broadcast(
        call != nullptr ? process.all.parts_for(ply_faces(path), call->parts) : 0);
    auto surface = process.all.read_ranges(
        parts, [&](Exchange& exchange) { return read_ply_range(exchange, path, wants); });
    if (!surface && surface.error().status == Status::mesh_rejected) {
        return surface.error().message;
    }
    process.surface = Messages::known(std::move(surface), [&](const Error& error) {
        if (error.status == Status::invalid_argument) {
            fail_input(path, error.message);
        }
        take(Result<Done>(error));
    });
    return std::nullopt;
}

Done forget_ranges(Process& process, const Done*) {
    process.surface.reset();
    return {};
}

Result<SharedSamples> sample_together(Process& process, const SampleCall* call) {
    process.messages.agree([&] { return call != nullptr ? Done{} : open_own_device(process); });
    Runner& runner = call != nullptr ? call->runner : process.device->runner();
    const Checkpoints* const checkpoints = call != nullptr ? call->checkpoints : nullptr;
    const ProgressCallback progress =
        call != nullptr ? call->progress : [](const Progress&) { return !is_interrupted(); };
    const SampleParams* const params = call != nullptr ? &call->step.params : nullptr;
    auto result =
        process.surface
            ? process.surface->sample(runner,
                                      process.messages.broadcast(
                                          params != nullptr ? numbers_of(*params) : SampleParams()),
                                      checkpoints, progress)
            : process.all.sample(runner, call != nullptr ? call->step.surface : nullptr, params,
                                 checkpoints, progress);
    process.messages.check_own(result);
    return result;
}

} // namespace geodisk::tools
