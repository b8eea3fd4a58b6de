#include "session.hpp"

#include <cstdlib>
#include <cstring>
#include <iostream>
#include <optional>
#include <utility>

#include <geodisk/checkpoint.hpp>
#include <geodisk/fields.hpp>
#include <geodisk/version.hpp>

#include "cut_surface.hpp"
#include "files/output/output_target.hpp"
#include "geodisk/sample_run.hpp"
#include "parts/sample_parts.hpp"
#include "ply_range.hpp"
#include "program/command_text.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "shared_pairs.hpp"
#include "status_of.hpp"

namespace geodisk::tools {
namespace {

Bytes to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

bool goes_on() {
    return !is_interrupted();
}

Error unlike(std::size_t process) {
    return Error{Status::invalid_argument,
                 "process " + std::to_string(process) +
                     " was started with other arguments, or another version of the program, than "
                     "process 0; start all alike"};
}

/// Opens the device of a process. Returns its error as the first process is told of it.
Result<Done> open_device(RunDevice& device, ProgressLine& progress) {
    return caught([&]() -> Result<Done> {
        device.open(progress);
        return Done{};
    });
}

/// Returns what the first process says.
template <class Record>
Result<Record> all_hear(Exchange& exchange, const Record& of_first) {
    Bytes word(sizeof of_first);
    std::memcpy(word.data(), &of_first, sizeof of_first);
    const auto heard = exchange.scatter(std::vector<Bytes>(exchange.size(), word));
    if (!heard) {
        return heard.error();
    }
    Record record = of_first;
    std::memcpy(&record, heard->data(), sizeof record);
    return record;
}

/// Returns what a job takes from a mesh file that all read in ranges; nothing without a job.
RangeWants wants_of(const SampleJob* job) {
    return job != nullptr
               ? RangeWants{job->density.source(), job->mask.mask_rules(), !job->min_distance}
               : RangeWants();
}

} // namespace

Session::Session() : exchange_(take(MpiExchange::create(MPI_COMM_WORLD, goes_on))) {}

Session::~Session() {
    if (is_first() && !is_interrupted()) {
        next(Task::nothing);
    }
}

Session::Task Session::next(Task of_first) {
    const auto heard = together([&] { return all_hear(*exchange_, of_first); });
    return heard ? *heard : Task::nothing;
}

void Session::check_arguments(const std::vector<std::string>& arguments) {
    auto alike = together([&]() -> Result<Done> {
        const Bytes own = to_bytes(command_text(GEODISK_VERSION_STRING, arguments));
        const auto all = exchange_->gather(own);
        if (!all) {
            return all.error();
        }
        std::optional<Error> error;
        for (std::size_t process = 0; process < all->size() && !error; ++process) {
            if ((*all)[process] != own) {
                error = unlike(process);
            }
        }
        return exchange_->check_all(error ? &*error : nullptr);
    });
    check_interrupted();
    take(std::move(alike));
}

Result<Done> Session::read_together(const Path& path, const RangeWants& wants,
                                    std::uint32_t of_first) {
    const auto parts = all_hear(*exchange_, of_first);
    if (!parts) {
        return parts.error();
    }
    auto ranges = RangedParts::read(
        MPI_COMM_WORLD, goes_on, [this](const std::exception_ptr& failure) { fail(failure); },
        *parts, path, wants);
    if (!ranges) {
        return ranges.error();
    }
    ranges_ = std::move(*ranges);
    return Done{};
}

std::optional<std::string> Session::read_ranges(const SampleJob& job, std::uint32_t parts) {
    const Path path(job.mesh.mesh);
    next(Task::read);
    auto well = together([&] {
        return read_together(path, wants_of(&job),
                             parts_of_process(ply_faces(path), exchange_->size(), parts));
    });
    if (well) {
        return std::nullopt;
    }
    const Error& error = well.error();
    if (error.status == Status::mesh_rejected) {
        return error.message;
    }
    if (error.status == Status::invalid_argument) {
        fail_input(path, error.message);
    }
    check_interrupted();
    take(std::move(well));
    return std::nullopt;
}

void Session::forget_ranges() {
    next(Task::forget);
    ranges_.reset();
}

Result<Done> Session::make_rows_together(std::span<const Sample> samples, double min_distance,
                                         bool divides) {
    auto rows = RangedRows::make(*exchange_, *ranges_, samples, min_distance, divides);
    if (!rows) {
        return rows.error();
    }
    rows_ = std::move(*rows);
    return Done{};
}

RangedRows& Session::make_rows(std::span<const Sample> samples, double min_distance, bool divides) {
    next(Task::make_rows);
    auto made = together([&] { return make_rows_together(samples, min_distance, divides); });
    check_interrupted();
    take(std::move(made));
    return *rows_;
}

RowFormat Session::row_format(const SampleTarget& target) const {
    const bool is_float_enough = float_is_enough(rows_->box(), 3);
    SampleLayout layout = layout_in(target.format, 3, is_float_enough);
    layout.has_radius = rows_->radii().do_vary();
    return {target, layout};
}

void Session::write_rows(AtomicFile& file, const SampleTarget& target, const SampleHeader& header) {
    const RowFormat format = row_format(target);
    file.write(format.head(header, rows_->count()));
    const std::filesystem::path shared = file.share();
    next(Task::write_rows);
    std::exception_ptr failure; // Of the file alone.
    auto written = together([&]() -> Result<Done> {
        try {
            return rows_->write(*exchange_, format, &file, shared);
        } catch (const UserError&) {
            failure = std::current_exception();
            return Done{};
        }
    });
    check_interrupted();
    if (failure) {
        std::rethrow_exception(failure);
    }
    if (!written) {
        fail_to_write(target.path, written.error().message);
    }
}

Result<SampleSet> Session::sample(Runner& runner, const RequestStep& step,
                                  const ProgressCallback& progress) {
    const Checkpoints* checkpoints = nullptr;
    if (checkpoints_ != nullptr) {
        const std::uint64_t mesh =
            ranges_ ? ranges()->statistics().digest : surface_digest(*step.surface, step.params);
        const JobFrame frame =
            take(ranges_ ? ranges()->frame(step.params) : frame_of(*step.surface, step.params));
        checkpoints = &checkpoints_->begin({mesh, job_digest(frame, step.params)});
    }
    next(ranges_ ? Task::sample_ranges : Task::sample_whole);
    auto result = together([&]() -> Result<SharedSamples> {
        if (auto well = exchange_->check_all(nullptr); !well) {
            return well.error();
        }
        if (ranges_) {
            const auto job = all_hear(*exchange_, numbers_of(step.params));
            return job ? ranges_->sample(runner, *job, checkpoints, progress)
                       : Result<SharedSamples>(job.error());
        }
        const Cut cut = cut_surface;
        WholeSurface whole{*step.surface, step.params, cut};
        whole.checkpoints = checkpoints;
        return sample_parts(*exchange_, runner, &whole, progress);
    });
    if (!result) {
        if (checkpoints_ != nullptr) {
            checkpoints_->check();
        }
        Error error = result.error();
        if (ranges_ && error.status == Status::job_too_large) {
            error.message += ", or raise --parts";
        }
        return error;
    }
    processes_ = std::move(result->processes);
    return std::move(result->set);
}

std::vector<NotedPair> Session::note(const PairSearch& search, ProgressLine& progress) {
    next(Task::note);
    auto noted = together([&] { return note_together(*exchange_, &search, progress); });
    check_interrupted();
    return take(std::move(noted));
}

void Session::fail(const std::exception_ptr& failure) const {
    try {
        std::rethrow_exception(failure);
    } catch (const std::bad_alloc&) {
        abort(ExitCode::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        abort(ExitCode::internal, error.what());
    }
}

void Session::abort(ExitCode code, const std::string& message) const {
    const std::uint32_t rank = exchange_->rank();
    // In one piece, since others may write as well.
    const std::string line =
        "geodisk_mpi: " + (rank == 0 ? "" : "process " + std::to_string(rank) + ": ") + message +
        '\n';
    std::cerr << line << std::flush;
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    std::_Exit(static_cast<int>(code));
}

void Session::help_to_sample(RunDevice* device, bool has_ranges) {
    ProgressLine quiet(true);
    const Error no_job{Status::internal, "its arguments are none"};
    const auto opened = device != nullptr ? open_device(*device, quiet) : Result<Done>(no_job);
    if (!exchange_->check_all(opened ? nullptr : &opened.error())) {
        return; // The first process tells of errors.
    }
    const ProgressCallback progress = [](const Progress&) { return goes_on(); };
    if (!has_ranges) {
        (void)sample_parts(*exchange_, device->runner(), nullptr, progress);
    } else if (const auto job = all_hear(*exchange_, SampleParams())) {
        (void)ranges_->sample(device->runner(), *job, nullptr, progress);
    }
}

void Session::do_task(Task task, const SampleJob* job, RunDevice* device) {
    ProgressLine quiet(true);
    switch (task) {
    case Task::read:
        (void)read_together(job != nullptr ? Path(job->mesh.mesh) : Path(), wants_of(job), 0);
        break;
    case Task::forget:
        ranges_.reset();
        break;
    case Task::make_rows:
        (void)make_rows_together({}, 0, false);
        break;
    case Task::write_rows:
        (void)rows_->write(*exchange_, row_format(job->out.target()), nullptr, {});
        break;
    case Task::note:
        (void)note_together(*exchange_, nullptr, quiet);
        break;
    default:
        help_to_sample(device, task == Task::sample_ranges);
    }
}

void Session::help(const SampleJob* job) {
    if (has_ended_) {
        return;
    }
    std::optional<RunDevice> device;
    if (job != nullptr) {
        device = device_for(*job);
    }
    for (Task task = next(Task::nothing); task != Task::nothing; task = next(Task::nothing)) {
        together([&] { do_task(task, job, device ? &*device : nullptr); });
    }
    has_ended_ = true;
}

} // namespace geodisk::tools
