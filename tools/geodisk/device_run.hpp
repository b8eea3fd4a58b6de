// Runs on a device, for the commands that sample.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/request.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/device_log.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

/// Account of how a set of samples was made.
struct DeviceRun {
    DeviceReport device;
    Tuning tuning;                 ///< As used.
    double min_distance = 0;       ///< As used.
    std::uint32_t runs = 0;        ///< At this distance and those tried before.
    std::uint64_t cut = 0;         ///< Last samples of the run that an exact count left out.
    RunReport run;                 ///< With the seconds of all runs. Of all levels together.
    std::vector<std::size_t> ends; ///< Number of samples at the end of each level.
    /// 0 where that was done before; those of the stages after are in `run`.
    double open_seconds = 0, compile_seconds = 0;
    /// Shares of processes, where several sampled one surface.
    std::vector<ProcessReport> processes;
};

struct DeviceResult {
    RequestedSet found;
    DeviceRun done;
};

/// Samples a surface together with other processes.
class SurfaceSampler {
  public:
    virtual ~SurfaceSampler() = default;
    /// Gives the set that the runner alone gives for the step, which is of a surface.
    virtual Result<SampleSet> sample(Runner& runner, const RequestStep& step,
                                     const ProgressCallback& progress) = 0;
    /// Returns the shares of all processes in the last set.
    virtual const std::vector<ProcessReport>& processes() const = 0;
};

/// Returns the part of a run that is done, up to 1. The run should give about `expected` samples.
double part_done(const Progress& state, double expected);

/// Shows how far a search is, and what is accepted so far, called `found` ("pairs"). Warns once if
/// it takes long, and stops it on a signal. `progress` must outlive it.
ProgressCallback search_progress(ProgressLine& progress, const std::string& found);

/// The device was lost in a run, or has not answered.
class DeviceLost : public UserError {
  public:
    explicit DeviceLost(const std::string& message) : UserError(ExitCode::internal, message) {}
};

/// Throws UserError for an error of a run that --memory can help with, which was `bounded` by it,
/// and DeviceLost.
void check_run(const Error& error, bool bounded);

/// A device that is open, and the kernels compiled there.
struct OpenDevice {
    OpenDevice(Context opened, const RunnerOptions& tuned, std::shared_ptr<const Sampler> compiled)
        : context(std::move(opened)), options(tuned), sampler(std::move(compiled)) {}

    Context context;
    RunnerOptions options; ///< With the tuning that is kept for the device.
    std::shared_ptr<const Sampler> sampler;
    std::atomic<bool> is_lost = false;
};

/// A device that several RunDevice share, for runs side by side. One of them opens it.
struct SharedDevice {
    std::mutex mutex;
    std::shared_ptr<OpenDevice> open; ///< Null if it is not open.
};

/// A device for one run after another. Of one thread at a time.
class RunDevice {
  public:
    /// The device can draw as well, where `graphics` is set. Nothing is opened yet.
    RunDevice(DeviceOptions device, const RunnerOptions& runner, bool graphics = false,
              std::shared_ptr<SharedDevice> shared = std::make_shared<SharedDevice>());

    /// From now on, samples surfaces by this, which must outlive it; null for its runner alone.
    void sample_by(SurfaceSampler* sampler) { sampler_ = sampler; }
    bool has_sampler() const { return sampler_ != nullptr; }

    /// Opens the device and checks that it computes as it must, where that is not done or the
    /// device was lost since, also by a run beside. Throws UserError.
    void open(ProgressLine& progress);

    /// Begins to open the device on another thread and to compile pipelines there, of which
    /// `ahead` are those that jobs will probably need. The next open() waits for it and reports its
    /// errors. The device must not be shared.
    void begin_open(Ahead ahead);

    /// Opens the device where need be, compiles there what the request needs, and samples all of
    /// its steps. Throws UserError, DeviceLost among them.
    DeviceResult run(RequestRun request, ProgressLine& progress);

    /// Opens the device where need be, for a search. Returns the account of it without the run.
    DeviceRun begin_search(ProgressLine& progress);

    /// Throws UserError for an error of a run on this device, DeviceLost among them; after that,
    /// the device has to be opened again.
    void check(const Error& error);

    /// Frees what runs keep for those to come, so that something else has room.
    void release_memory();

    /// Opens the device where need be, and compiles there what the domain needs. The seconds of
    /// compiling that no run has told of. Throws UserError.
    double compile(const Domain& domain, ProgressLine& progress);

    // Members of an open device.
    const Context& context() const { return opened_->device->context; }
    Runner& runner() { return opened_->runner; }
    /// Its runner's, with the tuning that is kept for the device.
    const RunnerOptions& options() const { return opened_->device->options; }

  private:
    struct Opened {
        std::shared_ptr<OpenDevice> device;
        Runner runner;
    };
    /// A device just opened, and how long that took.
    struct Begun {
        std::shared_ptr<OpenDevice> device;
        double open_seconds, compile_seconds;
    };
    std::shared_ptr<OpenDevice> open_shared(ProgressLine& progress);
    /// Waits for begin_open().
    Begun finish_open(ProgressLine& progress);
    SampleSet sample(const RequestStep& step, ProgressLine& progress);

    DeviceOptions device_;
    RunnerOptions options_;
    bool graphics_;
    DeviceLog log_;
    std::shared_ptr<SharedDevice> shared_;
    std::optional<Opened> opened_;
    std::future<Begun> begun_; ///< Result of begin_open().
    SurfaceSampler* sampler_ = nullptr;
    double open_seconds_ = 0, compile_seconds_ = 0; ///< Seconds that no run has reported yet.
};

} // namespace geodisk::tools
