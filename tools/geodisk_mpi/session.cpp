#include "session.hpp"

#include <optional>
#include <utility>

#include <geodisk/version.hpp>

#include "cut_surface.hpp"
#include "geodisk/sample_run.hpp"
#include "parts/sample_parts.hpp"
#include "program/command_text.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

Bytes to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

Error unlike(std::size_t process) {
    return Error{Status::invalid_argument,
                 "process " + std::to_string(process) +
                     " was started with other arguments, or another version of the program, than "
                     "process 0; start all alike"};
}

/// The device of a process, opened; its error as the first process is told of it.
Result<Done> open(RunDevice& device, ProgressLine& progress) {
    try {
        device.open(progress);
        return Done{};
    } catch (const UserError& error) {
        const Status status = error.code() == ExitCode::no_device ? Status::no_device
                              : error.code() == ExitCode::out_of_memory
                                  ? Status::out_of_device_memory
                              : error.code() == ExitCode::usage ? Status::invalid_argument
                                                                : Status::internal;
        return Error{status, error.what()};
    }
}

} // namespace

Session::Session()
    : exchange_(take(MpiExchange::create(MPI_COMM_WORLD, [] { return !is_interrupted(); }))) {}

Session::~Session() {
    if (is_first() && !is_interrupted()) {
        is_more(false);
    }
}

bool Session::is_more(bool first_has_more) {
    const Bytes word(1, static_cast<std::byte>(first_has_more ? 1 : 0));
    const auto heard = exchange_->scatter(std::vector<Bytes>(exchange_->size(), word));
    return heard && heard->front() == std::byte{1};
}

void Session::check_arguments(const std::vector<std::string>& arguments) {
    const Bytes own = to_bytes(command_text(GEODISK_VERSION_STRING, arguments));
    const auto all = take(exchange_->gather(own));
    std::optional<Error> error;
    for (std::size_t process = 0; process < all.size() && !error; ++process) {
        if (all[process] != own) {
            error = unlike(process);
        }
    }
    take(exchange_->check_all(error ? &*error : nullptr));
}

Result<SampleSet> Session::sample(Runner& runner, const SurfaceTask& surface,
                                  const ProgressCallback& progress) {
    is_more(true);
    if (auto well = exchange_->check_all(nullptr); !well) {
        return well.error();
    }
    const Cut cut = cut_surface;
    const WholeSurface whole{*surface.mesh, surface.params, cut};
    auto result = sample_parts(*exchange_, runner, &whole, progress);
    if (!result) {
        return result.error();
    }
    processes_ = std::move(result->processes);
    return std::move(result->set);
}

void Session::help(const SampleJob* job) {
    if (has_ended_) {
        return;
    }
    ProgressLine quiet(true);
    std::optional<RunDevice> device;
    if (job != nullptr) {
        device = device_for(*job);
    }
    const Error no_job{Status::internal, "its arguments are none"};
    while (is_more(false)) {
        const auto opened = device ? open(*device, quiet) : Result<Done>(no_job);
        if (exchange_->check_all(opened ? nullptr : &opened.error())) {
            // The first process tells of errors.
            (void)sample_parts(*exchange_, device->runner(), nullptr,
                               [](const Progress&) { return !is_interrupted(); });
        }
    }
    has_ended_ = true;
}

} // namespace geodisk::tools
