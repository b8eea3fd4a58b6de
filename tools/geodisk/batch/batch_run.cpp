#include "geodisk/batch/batch_run.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "geodisk/batch/batch_log.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/sample_run.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

/// Ends the batch, not just a mesh.
struct BatchEnd {
    UserError error;
};

/// A device that is lost is opened again by whoever borrows it next.
void open_again(RunDevice& device, ProgressLine& progress) {
    try {
        device.open(progress);
    } catch (const UserError& error) {
        throw BatchEnd{error};
    }
}

SampleResult sample_on(DevicePool& pool, const SampleJob& job, const MeshInput& mesh,
                       ProgressLine& progress) {
    const auto sample = [&](const DevicePool::Loan& loan) {
        open_again(loan.device(), progress);
        return sample_mesh(job, mesh, loan.device(), progress);
    };
    const auto sample_beside = [&] {
        try {
            return sample(pool.borrow());
        } catch (const UserError& error) {
            if (error.code() != ExitCode::out_of_memory || !pool.is_shared()) {
                throw;
            }
        }
        return sample(pool.borrow_whole()); // Where it has all memory.
    };
    try {
        return sample_beside();
    } catch (const DeviceLost&) {
        check_interrupted();
    }
    return sample_beside();
}

void make_folder_of(const Path& file) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) {
        fail_to_write(file, error.message());
    }
}

/// State that the threads share.
class BatchRun {
  public:
    BatchRun(std::span<const BatchItem* const> items, DevicePool& pool, LineLog& log,
             ProgressLine& progress)
        : items_(items), pool_(pool), log_(log), progress_(progress) {
        progress_.begin_stage("batch");
    }

    /// Does one mesh after the other until none is left, or the batch ends.
    void work() noexcept {
        try {
            for (const BatchItem* item; (item = next()) != nullptr;) {
                do_item(*item);
            }
        } catch (const BatchEnd& end) {
            stop(std::make_exception_ptr(end.error));
        } catch (...) {
            stop(std::current_exception());
        }
    }

    /// Rethrows what ended the batch.
    BatchTotals totals() const {
        if (error_) {
            std::rethrow_exception(error_);
        }
        BatchTotals totals = totals_;
        totals.seconds = watch_.seconds();
        return totals;
    }

  private:
    const BatchItem* next() {
        const std::scoped_lock lock(mutex_);
        return next_ < items_.size() ? items_[next_++] : nullptr;
    }

    void stop(std::exception_ptr error) {
        const std::scoped_lock lock(mutex_);
        error_ = error_ ? error_ : std::move(error);
        next_ = items_.size();
    }

    void do_item(const BatchItem& item) {
        BatchEntry entry;
        entry.mesh = item.job.mesh.mesh;
        entry.output = item.job.out.output;
        entry.command = item.command;
        const Stopwatch watch;
        try {
            if (!item.fault.empty()) {
                fail_usage(item.fault);
            }
            sample_item(item.job, entry, watch);
            return;
        } catch (const UserError& error) {
            entry.exit_code = static_cast<int>(error.code());
            entry.error = error.what();
        } catch (const std::bad_alloc&) {
            entry.exit_code = static_cast<int>(ExitCode::out_of_memory);
            entry.error = "out of memory";
        } catch (const std::exception& error) {
            entry.exit_code = static_cast<int>(ExitCode::internal);
            entry.error = error.what();
        }
        check_interrupted(); // A signal is no fault of the mesh.
        entry.seconds = watch.seconds();
        note(entry, nullptr);
    }

    /// Throws what a single run would.
    void sample_item(const SampleJob& job, BatchEntry& entry, const Stopwatch& watch) {
        ProgressLine none(true); // That of the batch is enough.
        const MeshInput mesh = load_silently(job.mesh, none, job.density, job.mask);
        for (const MeshWarning& warning : mesh.warnings) {
            entry.warnings.push_back(warning.message);
        }
        check_target(job, mesh);
        const SampleResult result = sample_on(pool_, job, mesh, none);
        for (const MeshWarning& warning : result.warnings) {
            entry.warnings.push_back(warning.message);
        }
        if (auto note = precision_note(job.out.target(), result.rows, mesh.dimension())) {
            entry.warnings.push_back(std::move(*note));
        }
        make_folder_of(job.out.output);
        AtomicFile file(job.out.output);
        write_sample_file(file, job, mesh, result, SampleReport(job, mesh, result));
        file.sync();
        entry.samples = result.rows.size();
        entry.min_distance = result.params.min_distance * mesh.distance_part;
        entry.device = result.done.device.name;
        entry.seconds = watch.seconds();
        note(entry, &file);
    }

    /// Makes the file appear and logs the mesh, both or, where the program is killed in between,
    /// the file alone, which is then made again.
    void note(const BatchEntry& entry, AtomicFile* file) {
        const std::scoped_lock lock(mutex_);
        const Uninterrupted both;
        if (file != nullptr) {
            check_interrupted();
            file->commit();
        }
        try {
            append_entry(log_, entry);
        } catch (const UserError& error) {
            throw BatchEnd{error};
        }
        (entry.is_ok() ? totals_.done : totals_.failed) += 1;
        totals_.samples += entry.samples;
        totals_.warned += std::size_t{!entry.warnings.empty()};
        if (!entry.is_ok()) {
            progress_.clear();
            print_failure(entry.mesh, entry.error);
        }
        show_progress();
    }

    void show_progress() {
        const std::size_t passed = totals_.done + totals_.failed;
        const double part = static_cast<double>(passed) / static_cast<double>(items_.size());
        std::string text = grouped(passed) + " of " + grouped(items_.size());
        if (totals_.failed > 0) {
            text += ", " + grouped(totals_.failed) + " failed";
        }
        progress_.update(part, text + ", " + seconds_text(watch_.seconds() * (1 - part) / part) +
                                   " left");
    }

    const std::span<const BatchItem* const> items_;
    DevicePool& pool_;
    LineLog& log_;
    ProgressLine& progress_;
    const Stopwatch watch_;
    std::mutex mutex_; ///< Guards all below, the log and the progress.
    std::size_t next_ = 0;
    BatchTotals totals_;
    std::exception_ptr error_;
};

} // namespace

BatchTotals run_batch(std::span<const BatchItem* const> items, int jobs, DevicePool& pool,
                      LineLog& log, ProgressLine& progress) {
    BatchRun run(items, pool, log, progress);
    {
        std::vector<std::jthread> others;
        const auto threads = std::min(static_cast<std::size_t>(jobs), items.size());
        for (std::size_t i = 1; i < threads; ++i) {
            others.emplace_back([&run] { run.work(); });
        }
        run.work();
    }
    progress.clear();
    return run.totals();
}

} // namespace geodisk::tools
