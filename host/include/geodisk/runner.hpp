// Runner: samples a domain on a lent device and queue, from upload to result. It allocates, submits
// and waits; for full control over those, use Sampler.
// Stable.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/device.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/threads.hpp>

namespace geodisk {

/// Parts of a run on the device.
enum class Stage : std::uint32_t {
    count,   ///< Counts the candidates of each face.
    bin,     ///< Counts those of each cell of a large face.
    draw,    ///< Draws the candidates.
    select,  ///< Finds the next batch and prepares its slots.
    detect,  ///< Computes geodesic disks.
    resolve, ///< Decides the batch.
    gather,  ///< Puts the samples in order.
};
/// Number of stages.
inline constexpr std::size_t kStages = 7;
/// Seconds, indexed by Stage.
using StageSeconds = std::array<double, kStages>;

/// Returns the name of a stage as spelled above.
GEODISK_API const char* to_string(Stage stage) noexcept;

/// Wall time of the parts of a run, in seconds.
struct RunSeconds {
    double compile = 0; ///< Pipelines that no run before has needed.
    double upload = 0;
    double sample = 0;
    double readback = 0;
};

/// How a maximal set was completed (SampleParams::maximal).
struct MaximalReport {
    std::uint32_t rounds = 0; ///< Rounds in which darts were thrown into gaps.
    std::uint64_t cells = 0;  ///< Parts of faces that were tested.
    std::uint64_t darts = 0;  ///< Darts that hit a gap.
    /// True if every point of the surface is covered: nearer to a sample than `largest_gap`. False
    /// if there is a gap too small for single precision; no dart hits it.
    bool certified = false;
    /// Bound on the distance from any point to the nearest sample, in mesh units: the minimum
    /// distance and twice the guard, or more if not certified. If radii vary, the bound on the
    /// excess over r(p) + r(q), plus the minimum distance. 0 unless the set is maximal.
    double largest_gap = 0;
};

/// Statistics of a run. For a maximal set, summed over all its jobs.
struct RunReport {
    std::uint32_t candidates = 0;    ///< Candidates decided: all, or up to the last sample of a
                                     ///< count.
    std::uint32_t chunks = 0;        ///< Parts in which they were drawn, one or more stages each.
    std::uint32_t batches = 0;       ///< Batches of disks.
    std::uint32_t dispatches = 0;    ///< Dispatches recorded, including empty ones and clears.
    std::uint32_t disks = 0;         ///< Geodesic disks computed, more than samples. Each chunk
                                     ///< computes those of earlier samples again.
    std::uint32_t regrown = 0;       ///< Batches repeated with more memory.
    std::uint32_t starts = 0;        ///< Times the run began: again with less memory on the device,
                                     ///< or with more room for samples. `seconds` count them all.
    std::uint64_t windows = 0;       ///< Windows and vertex events of all disks, or rows of cells
                                     ///< for straight distances. Other figures of windows, chains
                                     ///< and vertices are 0 then.
    std::uint64_t tested = 0;        ///< Candidate distances computed in all disks.
    std::uint32_t max_waiting = 0;   ///< Maximum of windows, or vertex events, waiting in a disk.
    std::uint32_t longest_chain = 0; ///< Maximum of edges crossed by a window of a sample's disk.
    std::uint32_t max_vertices = 0;  ///< Maximum of vertices reached by a disk.
    std::uint32_t max_conflicts = 0; ///< Maximum of conflicts listed by a disk.
    /// Trips of the main loop of detect in all lanes; a trip takes one window or corner. And their
    /// number if every lane took as many as the busiest lane of its subgroup, which all wait for.
    /// 0 without SamplerOptions::count_trips.
    std::uint64_t trips = 0, lane_trips = 0;
    double guard = 0; ///< Conflicts were tested against at most min_distance * (1 + guard).
    std::uint64_t device_bytes = 0; ///< Memory allocated on the device, in bytes.
    std::uint64_t uploaded = 0;     ///< Bytes uploaded. A mesh that is on the device already counts
                                    ///< with its lengths only.
    RunPlan plan;                   ///< Plan at the end of the run.
    RunSeconds seconds;
    StageSeconds stages{}; ///< Device time, 0 without RunnerOptions::time_stages.
    MaximalReport maximal;

    /// Adds the work of another run: numbers and seconds are summed, maxima kept. `starts`, `plan`
    /// and `maximal` stay.
    GEODISK_API void add(const RunReport& other) noexcept;
};

/// Samples in dart-throwing order.
struct SampleSet {
    std::vector<Sample> samples; ///< Samples of a surface.
    std::vector<double> points;  ///< Domain::dimension() coordinates per sample of a box.
    RunReport report;
    std::size_t existing = 0; ///< Number of existing samples (SampleParams::existing): the first.
    std::vector<std::uint8_t> classes; ///< Class of each sample (SampleParams::class_factors).
};

/// How far a run is.
struct Progress {
    std::uint32_t decided;    ///< Candidates decided or in work, approximately.
    std::uint32_t candidates; ///< All candidates.
    std::uint32_t accepted;   ///< Samples so far.
    std::uint32_t disks;      ///< Complete disks.
    std::uint64_t windows;    ///< Windows of those disks. Disks of many windows take long.
};

/// Limits of a Runner: memory and time.
struct RunnerOptions {
    SamplerOptions sampler;
    /// Maximum bytes of a run on the device, including staging; 0 for no limit. The runner meets it
    /// by fewer stages at once and a smaller pool. It does not change the samples. Without a limit,
    /// a run that is out of memory is retried with half as much.
    std::uint64_t device_bytes = 0;
    /// Maximum bytes of the pool, which holds disks in progress and lists of conflicts. The range
    /// of one binding limits it as well.
    std::uint64_t pool_bytes = std::uint64_t{256} << 20;
    /// Plan whose non-zero fields replace the runner's choice. For tuning and tests: none changes
    /// the samples, except `error_bound`, which decides ties.
    RunPlan plan;
    /// Threads that write the data to upload.
    ThreadOptions threads;
    /// Measures the device time of each stage by timestamps, if the queue has them.
    bool time_stages = false;
    /// Target length of one submission in seconds; keeps GPU watchdogs quiet, progress and
    /// cancellation prompt. The first submission of a runner is tiny, later ones follow the times
    /// measured, also those of earlier runs. 0 chooses 0.02, or 0.1 on a CPU.
    double submission_seconds = 0;
    /// Seconds after which a submission counts as hung. Time in which the process is stopped does
    /// not count. 0 chooses 120, or 600 on a CPU.
    double stall_seconds = 0;
};

/// Called after every submission, including those that upload and draw candidates. Returns false
/// to stop the run with `cancelled`.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Not thread-safe; several runners may share a device, and a queue through QueueRef's lock.
class GEODISK_API Runner {
  public:
    /// Makes a Sampler and checks on the device that arithmetic rounds as decisions need.
    /// Errors: as Sampler::create; `device_lacks` when the check fails; `invalid_argument` for
    /// seconds that are negative or not finite.
    static Result<Runner> create(const DeviceRefs& device, const QueueRef& queue,
                                 const RunnerOptions& options = {}) noexcept;
    /// Uses a Sampler that other runners may share. It keeps its compiled pipelines, and arithmetic
    /// is checked once per Sampler. Ignores RunnerOptions::sampler. Each further runner costs a
    /// command pool and its own memory.
    static Result<Runner> create(std::shared_ptr<const Sampler> sampler, const QueueRef& queue,
                                 const RunnerOptions& options = {}) noexcept;
    Runner(Runner&&) noexcept;
    Runner& operator=(Runner&&) noexcept;
    ~Runner();

    /// Returns the set of sequential dart throwing over the same candidates, on every device,
    /// driver and plan. A buffer that overflows is enlarged and the batch repeated. Candidates are
    /// drawn in chunks if they do not fit a binding or the device's memory, or may not be needed.
    ///
    /// A surface whose mesh does not fit is sampled in parts, one after another, each by a thread
    /// of its own that mostly waits. Callbacks come from this thread all the same. Not with
    /// shares of classes, by distances through space, and where parts would need the whole mesh
    /// around them.
    ///
    /// Errors: `job_too_large`, `workspace_too_small` and `invalid_argument` as Sampler's
    /// functions; `mesh_rejected` as Job::advance; `out_of_device_memory`, `device_lost`,
    /// `cancelled`. After `device_lost` the runner refuses all further work. Objects of a
    /// submission that hangs are never freed.
    Result<SampleSet> sample_and_wait(const Domain& domain,
                                      const ProgressCallback& progress = {}) noexcept;
    /// Samples Domain::surface(mesh, params). Errors: those of both.
    Result<SampleSet> sample_and_wait(const PreparedMesh& mesh, const SampleParams& params,
                                      const ProgressCallback& progress = {}) noexcept;

    // Without waiting, one run or search at a time. sample_and_wait() is refused meanwhile.

    /// Begins a run; the domain must outlive it. Errors: `invalid_argument` if one is in progress;
    /// all others come from poll().
    Result<Done> start(const Domain& domain, const ProgressCallback& progress = {}) noexcept;
    /// Waits for the latest submission, at most for `patience`. Once it has ended, records and
    /// submits the next one. Returns the samples when the run is complete, else nothing. Errors:
    /// `invalid_argument` if no run is in progress; otherwise as sample_and_wait(), and the run has
    /// then ended.
    Result<std::optional<SampleSet>> poll(std::chrono::milliseconds patience = {}) noexcept;
    /// Returns the fence of the submission in flight, or null. Pass it to vkWaitForFences only, for
    /// example with fences of your own.
    VkFence fence() const noexcept;
    /// Returns how far the run or search is.
    Progress progress() const noexcept;
    /// Ends the run or search, if one is in progress, and waits for the submission in flight.
    void cancel() noexcept;

    /// Frees the device memory that is kept for later runs; not while one is in progress. An error
    /// of a run frees it as well.
    void release_memory() noexcept;

    const Sampler& sampler() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Runner(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
