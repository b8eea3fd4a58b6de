// The processes of a run: the first one reads, asks the others for help, and writes or reports.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checkpoint_folder.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/options/sample_options.hpp"
#include "mpi_exchange.hpp"
#include "program/failure.hpp"
#include "program/path.hpp"
#include "ranged_parts.hpp"
#include "ranged_rows.hpp"

namespace geodisk::tools {

/// All processes of MPI_COMM_WORLD. When that of the first process ends, the others are told that
/// there is nothing more to do.
class Session : public SurfaceSampler {
  public:
    /// Throws UserError(internal).
    Session();
    ~Session() override;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    bool is_first() const { return exchange_->rank() == 0; }

    /// Throws UserError(usage) on all processes unless all have the same program and arguments.
    void check_arguments(const std::vector<std::string>& arguments);

    // On the first process.

    /// Reads the mesh file of a job by all processes, each a range of it; from then on sample()
    /// samples that surface. Each process has so many parts of it, or as parts_of_process() chooses
    /// for 0. Returns the reason if the first process has to read the whole. Throws
    /// UserError(bad_input) if the file changes meanwhile.
    std::optional<std::string> read_ranges(const SampleJob& job, std::uint32_t parts);
    /// Returns the surface that was read in ranges, or null.
    const RangedSurface* ranges() const { return ranges_ ? &ranges_->surface() : nullptr; }
    /// Frees it, on all processes.
    void forget_ranges();
    /// Makes the rows of samples on it, of a job with such a distance. Each process gets some of
    /// them if it `divides`.
    RangedRows& make_rows(std::span<const Sample> samples, double min_distance, bool divides);
    /// Writes divided rows by all processes. Throws UserError(bad_output).
    void write_rows(AtomicFile& file, const SampleTarget& target, const SampleHeader& header);

    /// Samples by all processes.
    Result<SampleSet> sample(Runner& runner, const RequestStep& step,
                             const ProgressCallback& progress) override;
    const std::vector<ProcessReport>& processes() const override { return processes_; }
    /// From now on, saves checkpoints there, if it is not null. It must outlive all samples.
    void save_in(CheckpointFolder* folder) { checkpoints_ = folder; }

    /// Does what note_pairs() does, by all processes, on the first one. Throws UserError.
    std::vector<NotedPair> note(const PairSearch& search, ProgressLine& progress);

    /// Helps the first process until it has no more work, on the others. `job` says how to sample;
    /// it is null where nothing is sampled, or the arguments are none.
    void help(const SampleJob* job);

  private:
    /// Task for the other processes.
    enum class Task : std::uint8_t {
        nothing,
        read,
        forget,
        sample_whole,
        sample_ranges,
        make_rows,
        write_rows,
        note
    };

    /// Tells the others what to do, or hears of it.
    Task next(Task of_first);
    void do_task(Task task, const SampleJob* job, RunDevice* device);
    /// Reads ranges; the first process says how many parts each has.
    Result<Done> read_together(const Path& path, const RangeWants& wants, std::uint32_t of_first);
    void help_to_sample(RunDevice* device, bool has_ranges);
    Result<Done> make_rows_together(std::span<const Sample> samples, double min_distance,
                                    bool divides);
    RowFormat row_format(const SampleTarget& target) const;

    /// Does what all processes do together. What it throws, the others never hear of: that ends all
    /// of them, with one message.
    template <class Body>
    auto together(const Body& body) const {
        try {
            return body();
        } catch (...) {
            fail(std::current_exception());
        }
    }
    [[noreturn]] void fail(const std::exception_ptr& failure) const;
    [[noreturn]] void abort(ExitCode code, const std::string& message) const;

    std::unique_ptr<MpiExchange> exchange_;
    std::optional<RangedParts> ranges_;
    std::optional<RangedRows> rows_;
    std::vector<ProcessReport> processes_;
    CheckpointFolder* checkpoints_ = nullptr;
    bool has_ended_ = false;
};

} // namespace geodisk::tools
