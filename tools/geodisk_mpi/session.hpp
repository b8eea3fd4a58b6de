// The processes of a run: the first one reads, asks the others for help, and writes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/options/sample_options.hpp"
#include "mpi_exchange.hpp"
#include "parts/ranges/ranged_surface.hpp"
#include "program/path.hpp"

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

    /// Reads a mesh file by all processes, each a range of it; from then on sample() samples that
    /// surface. Returns the reason if the first process has to read the whole. Throws
    /// UserError(bad_input) if the file changes meanwhile.
    std::optional<std::string> read_ranges(const Path& path);
    /// Returns the surface that was read in ranges, or null.
    const RangedSurface* ranges() const { return surface_ ? &*surface_ : nullptr; }
    /// Frees it.
    void forget_ranges() { surface_.reset(); }
    /// Returns the corners of its faces, in ascending order: nine coordinates each.
    std::vector<double> corners(const std::vector<std::uint32_t>& faces);

    /// Samples by all processes.
    Result<SampleSet> sample(Runner& runner, const SurfaceTask& surface,
                             const ProgressCallback& progress) override;
    const std::vector<ProcessReport>& processes() const override { return processes_; }

    /// Helps the first process until it has no more work, on the others. `job` says how; it is null
    /// where the arguments are none.
    void help(const SampleJob* job);

  private:
    /// What the others are to do.
    enum class Task : std::uint8_t { nothing, read, sample_whole, sample_ranges, corners };

    /// Tells the others what to do, or hears of it.
    Task next(Task of_first);
    void help_to_read(const Path& path);
    void help_to_sample(RunDevice* device, bool has_ranges);

    std::unique_ptr<MpiExchange> exchange_;
    std::optional<RangedSurface> surface_;
    std::vector<ProcessReport> processes_;
    bool has_ended_ = false;
};

} // namespace geodisk::tools
