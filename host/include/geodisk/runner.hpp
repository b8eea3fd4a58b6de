// Runner: samples a domain on a lent device and queue, from upload to result. It allocates, submits
// and waits; for full control over those, use Sampler.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/call_histogram.hpp>
#include <geodisk/device.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>

namespace geodisk {

/// An accepted candidate.
struct Sample {
    std::uint32_t face; ///< Index of its triangle in the caller's mesh.
    float weights[3];   ///< Of the triangle's corners in order; they sum to exactly 1.
};

/// The parts of a run on the device.
enum class Stage : std::uint32_t {
    count,   ///< How many candidates each face has.
    bin,     ///< And how many of them each cell of a large one.
    draw,    ///< The candidates.
    select,  ///< Finds the next batch and readies its slots.
    detect,  ///< Geodesic disks.
    resolve, ///< Decides the batch.
    gather,  ///< Puts the samples in order.
};
/// Of Stage.
inline constexpr std::size_t kStages = 7;
/// By Stage.
using StageSeconds = std::array<double, kStages>;

/// Name of a stage as spelled above.
GEODISK_API const char* to_string(Stage stage) noexcept;

/// Wall time of the parts of a run, in seconds.
struct RunSeconds {
    double compile = 0; ///< Pipelines that no run before has needed.
    double upload = 0;
    double sample = 0;
    double readback = 0;
};

/// How a run went.
struct RunReport {
    std::uint32_t candidates = 0;     ///< Decided: all, or up to the last sample of a count.
    std::uint32_t chunks = 0;         ///< Parts in which they were drawn, of a stage or more each.
    std::uint32_t iterations = 0;     ///< Batches of disks.
    std::uint32_t dispatches = 0;     ///< Recorded, empty ones and clears of memory
                                      ///< included.
    std::uint32_t disks = 0;          ///< Geodesic disks computed, more than samples; those of
                                      ///< samples anew with every chunk.
    std::uint32_t regrown = 0;        ///< Times a batch was repeated with more memory.
    std::uint64_t windows = 0;        ///< Windows and vertex events of all disks, or rows of cells
                                      ///< where distances are straight; what else concerns
                                      ///< windows, chains and vertices is 0 there.
    std::uint64_t tested = 0;         ///< Candidate distances computed in all disks.
    std::uint32_t most_waiting = 0;   ///< Most windows, or vertex events, waiting in one disk.
    std::uint32_t longest_chain = 0;  ///< Most edge crossings of a window of a sample's disk.
    std::uint32_t most_vertices = 0;  ///< Reached by one disk.
    std::uint32_t most_conflicts = 0; ///< Listed by one disk.
    CallHistogram calls;              ///< Empty without SamplerOptions::count_calls.
    /// Trips of the main loop of detect, each a window or corner, by all lanes; and as many as it
    /// would be if each did what the busiest of its subgroup did in the same dispatch, as all are
    /// held up by. 0 without SamplerOptions::count_trips.
    std::uint64_t trips = 0, lane_trips = 0;
    double guard = 0;               ///< Conflicts were tested against min_distance * (1 + guard).
    std::uint64_t device_bytes = 0; ///< Memory allocated on the device.
    std::uint64_t uploaded = 0; ///< Bytes; of meshes only the lengths where the run before was of
                                ///< the same ones.
    RunPlan plan;               ///< As it stood at the end.
    RunSeconds seconds;
    StageSeconds stages{}; ///< Device time, 0 without RunnerOptions::time_stages.
};

/// In dart-throwing order.
struct SampleSet {
    std::vector<Sample> samples; ///< Of a surface.
    std::vector<double> points;  ///< Of a box: Domain::dimension() coordinates of each sample.
    RunReport report;
};

/// How far a run is.
struct Progress {
    std::uint32_t decided; ///< Candidates decided or being worked on, of `candidates`, about.
    std::uint32_t candidates;
    std::uint32_t accepted;
    std::uint32_t disks;   ///< Complete.
    std::uint64_t windows; ///< Of those disks; with many for each, disks take long.
};

/// What a Runner may take, how long it waits, and what it tells.
struct RunnerOptions {
    SamplerOptions sampler;
    /// Most bytes that a run takes on the device, staging included; 0 for no bound of the caller's.
    /// Fewer stages at once and a smaller pool make do with less; no choice changes the samples.
    /// Where memory is short without a bound, the run is tried with half as much before it is an
    /// error.
    std::uint64_t device_bytes = 0;
    /// Most bytes of the pool, which holds disks in progress and lists of conflicts; bounded by one
    /// binding of the device.
    std::uint64_t pool_bytes = std::uint64_t{256} << 20;
    /// Non-zero fields replace what the runner would choose. For tuning and tests: no choice
    /// changes the samples, but `error_bound`, and with it the ties.
    RunPlan plan;
    /// Measures the device time of each stage by timestamps, where the queue has them.
    bool time_stages = false;
    /// That a submission is to take, so that no watchdog bites and progress and cancellation stay
    /// prompt: the first is tiny, and the others follow what those before took. 0 chooses 0.02, and
    /// 0.1 on a CPU.
    double submission_seconds = 0;
    /// A submission that is waited for longer counts as hung; time in which the process is stopped
    /// does not count. 0 chooses 120, and 600 on a CPU.
    double stall_seconds = 0;
};

/// Called after every submission, also while a mesh is uploaded and candidates are drawn. Returns
/// false to stop the run with `cancelled`.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Not thread-safe; several runners may share a device, and a queue through QueueRef's lock.
class GEODISK_API Runner {
  public:
    /// Makes a Sampler and checks on the device that arithmetic rounds as decisions need.
    /// Errors: as Sampler::create; `device_lacks` when the check fails; `invalid_argument` for
    /// seconds that are no time.
    static Result<Runner> create(const DeviceRefs& device, const QueueRef& queue,
                                 const RunnerOptions& options = {}) noexcept;
    /// The same with a Sampler that other runners may share, which has compiled its pipelines, and
    /// on whose device arithmetic is checked once; RunnerOptions::sampler is not looked at. A
    /// runner per thread costs a command pool and memory of its own.
    static Result<Runner> create(std::shared_ptr<const Sampler> sampler, const QueueRef& queue,
                                 const RunnerOptions& options = {}) noexcept;
    Runner(Runner&&) noexcept;
    Runner& operator=(Runner&&) noexcept;
    ~Runner();

    /// Returns the set that sequential dart throwing over the same candidates returns, whatever
    /// device, driver or plan. What overflows is enlarged and the batch repeated; a run whose
    /// window chains outgrow the guard is repeated with a wider one. Candidates that do not fit a
    /// binding or the device's memory, or may not be needed, are drawn chunk by chunk.
    ///
    /// Errors: `job_too_large`, `workspace_too_small` and `invalid_argument` as Sampler's
    /// functions; `mesh_rejected` as Job::advance; `out_of_device_memory`, `device_lost`,
    /// `cancelled`. After `device_lost` the runner refuses all further work; when a submission was
    /// given up as hung, what it uses is never freed.
    Result<SampleSet> sample_and_wait(const Domain& domain,
                                      const ProgressCallback& progress = {}) noexcept;
    /// The same of Domain::surface(mesh, params), and its errors.
    Result<SampleSet> sample_and_wait(const PreparedMesh& mesh, const SampleParams& params,
                                      const ProgressCallback& progress = {}) noexcept;

    // The same without waiting, for one run at a time. sample_and_wait is refused meanwhile.

    /// Begins a run; the domain must outlive it. Errors: `invalid_argument` while one is in
    /// progress; all others come from poll().
    Result<Done> start(const Domain& domain, const ProgressCallback& progress = {}) noexcept;
    /// Goes on with the run where the device is done with what was submitted last: records and
    /// submits what comes next. Else waits for that, but no longer than `patience`. The samples
    /// once the run is complete, else nothing. Errors: `invalid_argument` where none is in
    /// progress; as sample_and_wait, upon which none is any more.
    Result<std::optional<SampleSet>> poll(std::chrono::milliseconds patience = {}) noexcept;
    /// Of the submission in flight, to be waited for with others of the caller, by vkWaitForFences
    /// alone; null where there is none.
    VkFence fence() const noexcept;
    /// How far the run is.
    Progress progress() const noexcept;
    /// Ends the run, if one is in progress, and waits for the submission in flight.
    void cancel() noexcept;

    /// Frees the device memory that runs keep for those to come, of which an error frees it too;
    /// not while one is in progress.
    void release_memory() noexcept;

    const Sampler& sampler() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Runner(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
