// The processes of a run: the first one reads, asks the others for help, and writes or reports.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "checkpoint_folder.hpp"
#include "geodisk/device_run.hpp"
#include "operations.hpp"
#include "process.hpp"
#include "program/interrupt.hpp"

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

    bool is_first() const { return process_.messages.is_first(); }

    /// Throws UserError(usage) on all processes unless all have the same program and arguments.
    void check_arguments(const std::vector<std::string>& arguments);

    // On the first process.

    /// Does an operation by all processes. Throws UserError.
    template <auto kWork, class Given>
    decltype(auto) call(const Given& given) {
        return together([&]() -> decltype(auto) {
            process_.messages.broadcast(Operations::number<kWork>());
            return kWork(process_, &given);
        });
    }

    /// Returns the surface that was read in ranges, or null.
    const SharedSurface* ranges() const { return process_.surface ? &*process_.surface : nullptr; }

    /// Samples by all processes.
    Result<SampleSet> sample(Runner& runner, const RequestStep& step,
                             const ProgressCallback& progress) override;
    const std::vector<ProcessReport>& processes() const override { return processes_; }
    /// From now on, saves checkpoints there, if it is not null. It must outlive all samples.
    void save_in(CheckpointFolder* folder) { checkpoints_ = folder; }

    /// Helps the first process until it has no more work, on the others. `job` says how to sample;
    /// it is null where nothing is sampled, or the arguments are none.
    void help(const SampleJob* job);

  private:
    /// Does what all processes do together. What it throws but SharedError, the others never learn
    /// of: that ends all of them, with one message.
    template <class Body>
    decltype(auto) together(const Body& body) {
        try {
            return body();
        } catch (const SharedError&) {
            check_interrupted();
            throw;
        } catch (...) {
            end_all(std::current_exception());
        }
    }
    [[noreturn]] static void end_all(const std::exception_ptr& failure);

    Process process_;
    std::vector<ProcessReport> processes_;
    CheckpointFolder* checkpoints_ = nullptr;
    bool has_ended_ = false;
};

} // namespace geodisk::tools
