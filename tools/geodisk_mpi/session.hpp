// The processes of a run: the first one reads, asks the others for help, and writes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/options/sample_options.hpp"
#include "mpi_exchange.hpp"

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

    /// Samples by all processes, on the first one.
    Result<SampleSet> sample(Runner& runner, const SurfaceTask& surface,
                             const ProgressCallback& progress) override;
    const std::vector<ProcessReport>& processes() const override { return processes_; }

    /// Helps the first process until it has no more work, on the others. `job` says how; it is null
    /// where the arguments are none.
    void help(const SampleJob* job);

  private:
    /// Tells the others whether there is more to do, or hears of it.
    bool is_more(bool first_has_more);

    std::unique_ptr<MpiExchange> exchange_;
    std::vector<ProcessReport> processes_;
    bool has_ended_ = false;
};

} // namespace geodisk::tools
