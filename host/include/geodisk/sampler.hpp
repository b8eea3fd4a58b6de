// Sampler: records a sampling job into the caller's command buffers. It allocates no memory,
// submits nothing and waits for nothing.
//
// Steps of a job on a Domain:
//   1. plan_run             chooses how many candidates are active at a time, how many invocations
//                           compute their disks, and the memory of each
//   2. workspace_needs      returns the sizes of the buffers, which the caller allocates
//   3. write_upload         writes the data to upload before the first use
//   4. make_job             writes descriptor sets and records nothing
//   5. record_begin         draws the candidates of the first stages, in one command buffer or in
//                           parts
//   6. record_rounds        records a fixed number of rounds; those without work are empty
//                           dispatches. Submit, copy gpu::ControlRec from the control buffer, and
//                           follow the advice of Job::advance
//   7. record_finish        writes a gpu::SampleRec per accepted candidate, in dart order, at any
//                           time and in parts as in 5. The first ControlRec::ready of them are
//                           final
// Experimental.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/kernel_report.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>

namespace geodisk {

/// How shaders divide and take roots. Both ways return the correctly rounded result.
enum class Rounding : std::uint32_t {
    automatic, ///< Native if the device is known to round correctly, else emulated.
    native,
    emulated,
};

/// Order in which a disk takes vertices where shortest paths may bend. Both find the same disks;
/// their windows, and so ControlRec::longest_chain, may differ.
enum class Events : std::uint32_t {
    automatic, ///< Nearest first if disks are expected to cover 2^14 faces or more, else oldest.
    nearest,   ///< Nearest first, from a heap: fewer windows on large disks.
    oldest,    ///< Oldest first, from a ring.
};

/// How shaders read buffers that they do not write. Both ways return the same bits.
enum class Reads : std::uint32_t {
    automatic, ///< Texel buffers if they are known to be faster (llvmpipe), else storage buffers.
    storage,
    texels,
};

/// Returns "auto", "storage" or "texels".
GEODISK_API const char* to_string(Reads reads) noexcept;

/// Settings for a device. None changes the samples. 0 and `automatic` choose by the device's type
/// and limits.
struct Tuning {
    /// Invocations per work group of kernels over candidates and samples; a power of two up to the
    /// device's limit.
    std::uint32_t local_size = 0;
    /// Invocations per work group of kernels over slots and lanes, likewise.
    std::uint32_t slot_local_size = 0;
    /// Lanes whose rows alternate in the pool, a power of two up to kMaxPoolBlock. 1 keeps the
    /// rows of a lane together; the size of a subgroup lets its lanes read side by side.
    std::uint32_t pool_block = 0;
    /// Target number of batches (paper section 5.3, N/T). More batches compute fewer disks in vain;
    /// fewer batches take fewer dispatches.
    std::uint32_t batches = 0;
    Reads reads = Reads::automatic;
    /// Invocations that compute a disk together (DisksBy::groups); a power of two, as the sizes.
    std::uint32_t group_lanes = 0;
};
/// Maximum of Tuning::pool_block.
inline constexpr std::uint32_t kMaxPoolBlock = 128;

/// Returns `tuning` with every field that is set in `wanted` replaced.
GEODISK_API Tuning overridden(Tuning tuning, const Tuning& wanted) noexcept;

/// Returns `wanted` with every other field chosen for a device. Errors: `invalid_argument` for an
/// impossible size or pool block; `device_lacks` for Reads::texels if the device's texel buffers
/// are too small.
GEODISK_API Result<Tuning> chosen_tuning(const Tuning& wanted, const DeviceReport& report) noexcept;

/// Jobs whose pipelines Sampler::create() compiles besides those that all jobs share.
enum class Ahead : std::uint8_t {
    nothing,       ///< Others are compiled by Sampler::prepare() or make_job().
    surface,       ///< Those of most surfaces, sampled by geodesic distance.
    varying_radii, ///< The same, with radii that vary.
};

/// How pipelines are made, and what they count.
struct SamplerOptions {
    Tuning tuning;
    Rounding rounding = Rounding::automatic;
    Events events = Events::automatic;
    /// Counts in gpu::ControlRec how long lanes of detect wait for others of their subgroup; takes
    /// a little time.
    bool count_trips = false;
    /// Lets create() compile before a domain is known, for example while a mesh is read.
    Ahead ahead = Ahead::nothing;
    /// Threads that compile pipelines; by default only the calling thread. With more of them,
    /// DeviceRefs::host_allocator is called on several threads at once, and
    /// DeviceRefs::pipeline_cache must not be externally synchronized.
    ThreadOptions threads{.max_threads = 1};
};

/// Buffers of a job, in the order of the bindings in shaders/shared/bindings.h.
enum class BufferRole : std::uint32_t {
    faces,
    fans,
    cells,
    weights,
    orders,
    starts,
    pool,
    control,
    list,
    sums,
    samples,
    accepted,
    buckets,
    constants,
    // Other names of these buffers for distances through space.
    corners = faces, ///< Corners of a surface.
    axes = fans,     ///< Axes of the grid.
    points = weights,
};
/// Number of roles.
inline constexpr std::size_t kBufferRoles = 14;

/// Returns the first name of a role, for messages.
GEODISK_API const char* to_string(BufferRole role) noexcept;

/// A range of a caller's buffer, bound as storage, texel or uniform buffer. `offset` is a multiple
/// of the device's minStorageBufferOffsetAlignment, minTexelBufferOffsetAlignment and
/// minUniformBufferOffsetAlignment.
struct BufferRange {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    friend bool operator==(const BufferRange&, const BufferRange&) = default;
};

/// Memory of one job. The caller owns it. Ranges must not overlap while the job runs. Create the
/// buffers with `kWorkspaceUsage`.
using Workspace = std::array<BufferRange, kBufferRoles>;
/// Usage of the buffers of a Workspace.
inline constexpr VkBufferUsageFlags kWorkspaceUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

/// Minimum bytes of each buffer. Leave out buffers that need none.
struct WorkspaceNeeds {
    std::array<VkDeviceSize, kBufferRoles> bytes{};
    GEODISK_API VkDeviceSize total() const noexcept;
};

/// A whole workspace in one buffer: where each of its ranges begins.
struct WorkspaceLayout {
    std::array<VkDeviceSize, kBufferRoles> offsets{}; ///< Bytes from the start of the layout.
    WorkspaceNeeds needs;                             ///< What it was made for.
    VkDeviceSize alignment = 1; ///< What the start of the layout must be a multiple of, in bytes.
    VkDeviceSize bytes = 0;     ///< Size of the layout.

    /// Returns the ranges where the layout begins `offset` bytes into `buffer`, a multiple of
    /// `alignment`.
    GEODISK_API Workspace in(VkBuffer buffer, VkDeviceSize offset = 0) const noexcept;
};

/// Who computes a disk. The samples are the same.
enum class DisksBy : std::uint32_t {
    automatic,
    lanes,  ///< An invocation. Best for small disks, since a device then computes many at a time.
    groups, ///< The invocations of a work group together, in waves. SwiftShader does not end
            ///< compiling the kernel for it; `automatic` never chooses it there.
};

/// How a job is divided into work. Only `error_bound` can change the samples, and only if a
/// distance lies within the guard of the minimum.
struct RunPlan {
    std::uint32_t slots = 0;           ///< Candidates active at a time, at least kMinSlots.
    std::uint32_t batch = 0;           ///< Of them, active at a time until a disk turns out much
                                       ///< larger than the others; 0 for all.
    std::uint32_t lanes = 0;           ///< Invocations that compute their disks, one after another;
                                       ///< or work groups, as `disks_by` says.
    std::uint32_t window_capacity = 0; ///< Maximum of waiting windows in a lane, and of vertex
                                       ///< events; a power of two, at least 2, or 4 by
                                       ///< groups.
    std::uint32_t table_capacity = 0;  ///< Rows of a lane's vertex table, at most half full; a
                                       ///< power of two.
    std::uint32_t list_capacity = 0;   ///< Conflicts per slot, a multiple of 4.
    std::uint32_t step_budget = 0;     ///< Steps of a lane per dispatch, each gpu::kTripsPerStep
                                       ///< windows or corners; limited by the device.
    std::uint32_t detect_passes = 0;   ///< Dispatches of detect per round.
    std::uint32_t sample_capacity = 0; ///< Samples the buffers hold; more than slots.
    std::uint32_t pool_block = 0;      ///< Sampler::tuning's, or 1 if the pool does not hold one
                                       ///< block of such lanes. Kernels for 1 are compiled when a
                                       ///< job first needs them.
    std::uint32_t stages = 0;          ///< Stages whose candidates are drawn at once; 1 for darts.
    std::uint32_t idle_capacity = 0;   ///< Places in the list of candidates that come next;
                                       ///< at most 2^23.
    bool trims = false; ///< Disks of very many windows trim them, and windows that cross very many
                        ///< edges do not come back to a face. Takes 129 KiB more per lane and
                        ///< kernels that are compiled when a job first needs them.
    DisksBy disks_by = DisksBy::automatic; ///< A plan has chosen. For `groups` the kernel is
                                           ///< compiled when a job first needs it.
    std::uint32_t large_groups = 0; ///< Where lanes compute disks: work groups for the few with
                                    ///< very many windows. 0 until there is one: then Advice::plan
                                    ///< has some, and the kernel of groups is compiled.
    std::uint32_t large_window_capacity = 0; ///< Of one of them, as window_capacity of a lane.
    std::uint32_t large_table_capacity = 0;  ///< Of one of them, as table_capacity of a lane.
    std::uint32_t large_after = 0; ///< Windows and events after which a lane leaves a disk to them.
    std::uint32_t dispatch_items = 0; ///< Maximum of faces, candidates, samples or words per
                                      ///< dispatch; at least one work group is done.
    /// Bound on the rounding error of a distance, as a fraction of the minimum distance (at most
    /// 0.5). On surfaces the guard is this rounded up to a power of two, and paths over more edges
    /// than usual widen both for themselves (host/docs/precision.md).
    double error_bound = 0;

    /// Returns the candidates active at a time until a disk turns out much larger than the others.
    GEODISK_API std::uint32_t batch_slots() const noexcept;
    /// Returns the size of a lane's slice of the pool, in rows of 16 bytes.
    GEODISK_API std::uint32_t lane_rows() const noexcept;
    /// Returns the size of the slice of a work group for large disks, in rows of 16 bytes.
    GEODISK_API std::uint32_t large_rows() const noexcept;
    /// Returns the first row of the slices of work groups for large disks, behind those of all
    /// blocks of lanes.
    GEODISK_API std::uint64_t first_large_row() const noexcept;
    /// Returns the first row of the lists, behind all slices.
    GEODISK_API std::uint64_t first_list_row() const noexcept;
    /// Returns the bytes of all slices and lists.
    GEODISK_API std::uint64_t pool_bytes() const noexcept;
};

/// Sets no limit to a recording.
inline constexpr std::uint32_t kAllDispatches = ~std::uint32_t{0};

/// Minimum of slots. So many candidates never share one priority.
inline constexpr std::uint32_t kMinSlots = 8;

/// Pipeline stages and accesses of the first commands that touch the workspace, to which earlier
/// writes must be made visible, or of the last ones, which readers must wait for.
struct SyncScope {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
};

/// Next step of a job. The numbers are those of geodisk_next, whose GEODISK_START_OVER only C has.
enum class Next : std::uint32_t {
    begin,          ///< record_begin(): for the first stages, for more, or for the rest of it.
    go_on,          ///< record_rounds(). Also the answer to a copy that is too old.
    finish,         ///< record_finish(), or the rest of it: all candidates of these stages are
                    ///< decided.
    larger_pool,    ///< Job::set_plan() with Advice::plan, then record_rewind().
    larger_samples, ///< Job::set_samples() with Advice::sample_capacity, then record_rewind().
    complete = 6,   ///< The samples are complete, Advice::ready of them.
    count,          ///< record_count(), or the rest of it: an exact number of darts is thrown.
    paused,         ///< All candidates below Job::set_end_order() are decided, and the first
                    ///< Advice::ready samples are theirs. Set another order to go on.
};

/// Returns the name of a step as spelled above.
GEODISK_API const char* to_string(Next next) noexcept;

/// Answer of Job::advance.
struct Advice {
    Next next = Next::go_on;
    /// Plan of the job, or the one to continue with. Its pool_bytes() is the size of the pool.
    RunPlan plan;
    std::uint32_t sample_capacity = 0; ///< Enough to continue, and half as many again.
    /// Number of samples that are in order and final, as far as the host knows. Grows until the
    /// next seed or domain.
    std::uint32_t ready = 0;
    /// With Next::complete, number of candidates up to the last one that takes part. 0 for a run
    /// that stopped at SampleParams::stop_count: record_count() counts them, and the next copy of
    /// the control record gives the number.
    std::uint64_t candidates = 0;
};

/// Job::set_end_order() without an end.
inline constexpr std::uint64_t kAllOrders = ~std::uint64_t{0};

namespace gpu {
struct ControlRec;
struct SampleRec;
} // namespace gpu

class Job;

/// Pipelines of a device, for jobs of all domains. Any number of threads may use one.
class GEODISK_API Sampler {
  public:
    /// Compiles the pipelines that all domains share, on the caller's device.
    /// Errors: `device_lacks` with every reason; those of chosen_tuning(); those of Vulkan.
    static Result<Sampler> create(const DeviceRefs& device,
                                  const SamplerOptions& options = {}) noexcept;
    Sampler(Sampler&&) noexcept;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();

    const DeviceReport& report() const noexcept;
    /// Returns the tuning in use, every field chosen.
    const Tuning& tuning() const noexcept;

    /// Compiles the pipelines that jobs of the domain need besides, if they are not compiled yet;
    /// otherwise make_job() does. Errors: those of Vulkan.
    Result<Done> prepare(const Domain& domain) const noexcept;

    /// Compiles the kernels of all domains, if they are not compiled yet, and returns the driver's
    /// statistics of each. Errors: `invalid_argument` unless DeviceRefs::pipeline_statistics is
    /// set; those of Vulkan.
    Result<std::vector<KernelReport>> report_kernels() const noexcept;

    /// Returns a plan for this device with a pool of at most `pool_bytes` and one binding. In a
    /// small pool, slices for large disks begin smaller, and lanes replace work groups. Errors:
    /// `workspace_too_small` if not even one lane fits.
    Result<RunPlan> plan_run(const Domain& domain, std::uint64_t pool_bytes) const noexcept;

    /// Returns the buffer sizes of the plan, large enough for `regrowths` more: each doubles the
    /// capacities of disks and adds half as many samples. Errors: `job_too_large` if a buffer
    /// exceeds a binding of the device, naming buffer, candidates and bytes; `workspace_too_small`
    /// if a regrowth does.
    Result<WorkspaceNeeds> workspace_needs(const Domain& domain, const RunPlan& plan,
                                           std::uint32_t regrowths = 0) const noexcept;

    /// Lays out all buffers one after the other in a single one, aligned for the device.
    WorkspaceLayout lay_out(const WorkspaceNeeds& needs) const noexcept;

    /// Returns the bytes to upload into a buffer; 0 if it needs none.
    std::size_t upload_size(const Domain& domain, BufferRole role) const noexcept;
    /// Returns how many of them, from the first on, depend on the meshes alone. They need no second
    /// upload for other distances, seeds or radii on the same meshes.
    std::size_t mesh_bytes(const Domain& domain, BufferRole role) const noexcept;
    /// Writes the bytes to upload from byte `from` on, 0 or mesh_bytes(). `out` must have exactly
    /// their size. Errors: `invalid_argument` for a buffer that needs none, or another size;
    /// `out_of_host_memory`.
    Result<Done> write_upload(const Domain& domain, const RunPlan& plan, BufferRole role,
                              std::span<std::byte> out, std::size_t from = 0) const noexcept;

    /// Writes descriptor sets for a workspace. The job keeps no reference to the domain; the
    /// Sampler must outlive it. Errors: `invalid_argument` for a plan out of the ranges of RunPlan,
    /// or a workspace that overlaps or is not aligned; `workspace_too_small`; those of
    /// workspace_needs() and Vulkan.
    Result<Job> make_job(const Domain& domain, const RunPlan& plan,
                         const Workspace& workspace) const noexcept;

    /// @name Recording
    /// The command buffer must be in the recording state, outside a render pass, on a queue family
    /// with compute. Each call changes the compute pipeline, descriptor set 0 and push constants.
    /// It begins and ends with its own barriers among the job's buffers.
    ///
    /// The rounds of later stages begin with the disks of all earlier samples, which reject
    /// candidates. The result is the same as for all stages at once.
    ///
    /// record_finish() may be recorded between any rounds, any number of times. Samples that it has
    /// put in order stay where they are; later calls append.
    ///
    /// No dispatch grows with the mesh or the candidates: RunPlan::dispatch_items limits dispatches
    /// over these, RunPlan::step_budget and lanes those of disks. record_begin(),
    /// record_count() and record_finish() record at most `dispatches`, including clears, from where
    /// the last call stopped, and return true when everything is recorded. The next call of any
    /// kind records the rest first. A round is 2 dispatches and RunPlan::detect_passes.
    /// @{

    /// Draws the candidates of the next stages. Returns true when everything is recorded.
    bool record_begin(VkCommandBuffer commands, Job& job,
                      std::uint32_t dispatches = kAllDispatches) const noexcept;
    /// Counts candidates, where Next::count asks for it or a run has stopped at a count. Records
    /// nothing otherwise. Returns true when everything is recorded.
    bool record_count(VkCommandBuffer commands, Job& job,
                      std::uint32_t dispatches = kAllDispatches) const noexcept;
    /// Records this many rounds; those without work are empty dispatches.
    void record_rounds(VkCommandBuffer commands, Job& job, std::uint32_t rounds) const noexcept;
    // The parts of a round one by one, for commands of your own between them. Always record all
    // three, in this order.

    /// Records the first part of a round: lists the candidates that come next, or puts them into
    /// slots.
    void record_select(VkCommandBuffer commands, Job& job) const noexcept;
    /// Records the second part: computes their disks.
    void record_detect(VkCommandBuffer commands, Job& job) const noexcept;
    /// Records the third part: decides them once all of these disks are complete.
    void record_resolve(VkCommandBuffer commands, Job& job) const noexcept;
    /// Restarts the batch in progress, after Job::set_plan() or set_samples(). Record it only where
    /// Job::advance() asks for it: no candidate of the batch is decided then. A batch that is
    /// decided in part would accept candidates too close to its samples.
    void record_rewind(VkCommandBuffer commands, Job& job) const noexcept;
    /// Writes the samples so far in order, as gpu::SampleRec. Returns true when everything is
    /// recorded.
    bool record_finish(VkCommandBuffer commands, Job& job,
                       std::uint32_t dispatches = kAllDispatches) const noexcept;
    /// @}

    /// First use of the workspace by a job: earlier writes must be visible to it.
    static constexpr SyncScope kFirstUse{
        VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
    /// Last use of the workspace by a job: readers of the results must wait for it.
    static constexpr SyncScope kLastUse{VK_PIPELINE_STAGE_TRANSFER_BIT |
                                            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                        VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT};

    struct Impl; ///< Internal.

  private:
    friend class Runner;
    explicit Sampler(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// A workspace prepared for one sampling job. Movable. Record in one thread at a time. Its command
/// buffers must run one after the other, and it must outlive their execution.
class GEODISK_API Job {
  public:
    Job(Job&&) noexcept;
    Job& operator=(Job&&) noexcept;
    ~Job();

    const RunPlan& plan() const noexcept;
    /// Makes this a job of another domain, in the same workspace, whose buffers must be unchanged.
    /// Allocates nothing for a domain of the same kind. Upload the data of write_upload() for that
    /// domain, and create a Placement again. No command buffer of the job may be pending. Errors:
    /// those of make_job(); after an error it can only be renewed again.
    Result<Done> renew(const Domain& domain, const RunPlan& plan) noexcept;
    /// Restarts with another seed; uploaded data and existing samples stay.
    void set_seed(std::uint64_t seed) noexcept;
    /// Decides only the candidates of lower order: the number of their stage times 2^28, plus their
    /// priority. advance() then says Next::paused; set a higher order, or kAllOrders, to go on. Any
    /// sequence of orders gives the same samples. Holds for what is recorded next, until the run
    /// restarts. Candidates that earlier rounds decide stay decided.
    void set_end_order(std::uint64_t order) noexcept;
    /// Restarts with samples that are settled, instead of SampleParams::existing: they come before
    /// all candidates, reject those closer than the minimum distance, and are the first samples of
    /// the run, in this order. Distances among them are not checked. Write them to the start of the
    /// samples buffer before record_begin(); geodisk leaves them there. They count towards
    /// SampleParams::stop_count, and hold for other seeds, until renew(). In a box they must be
    /// samples of the same box and seed.
    /// Errors: `invalid_argument`, naming the sample, for a face that does not exist, or weights
    /// that are not multiples of 2^-24 with a sum of at most 1; for more samples than
    /// RunPlan::sample_capacity; for a class that there is not.
    Result<Done> set_existing(std::span<const gpu::SampleRec> samples) noexcept;
    /// Returns the next step, from a copy of the control record that the host has read. Copies from
    /// before the last record_begin(), record_count() or record_rewind() are ignored with
    /// Next::go_on, so several frames may be in flight; the same copy may be given twice. Sets the
    /// job to its next stages if Next::begin follows others. `pool_bytes` limits a larger pool; 0
    /// keeps to the workspace.
    ///
    /// Errors: `mesh_rejected` if the mesh exceeds single precision, naming the face of a candidate
    /// (numbered through all surfaces); `invalid_argument` if no candidate was drawn because the
    /// data of write_upload() was not uploaded; `internal` if the control record is corrupt;
    /// `workspace_too_small` if not even one disk fits, naming its bytes; `job_too_large` if no
    /// binding holds the samples.
    Result<Advice> advance(const gpu::ControlRec& control, std::uint64_t pool_bytes = 0) noexcept;
    /// Replaces the plan for rounds recorded from now on. It may have no more slots than the job
    /// was made with, must have the same stages and error_bound, and its pool must fit the
    /// workspace's.
    Result<Done> set_plan(const RunPlan& plan) noexcept;
    /// Replaces the plan and the pool. No command buffer of the job may be pending.
    Result<Done> set_plan(const RunPlan& plan, const BufferRange& pool) noexcept;
    /// Replaces the buffers of the samples by larger ones, after Next::larger_samples: samples,
    /// accepted and buckets, with the sizes of sample_bytes(). RunPlan::sample_capacity becomes
    /// `capacity`. Copy the contents of samples and accepted, then record a rewind. No command
    /// buffer of the job may be pending.
    Result<Done> set_samples(std::uint32_t capacity, const BufferRange& samples,
                             const BufferRange& accepted, const BufferRange& buckets) noexcept;
    /// Returns the bytes of samples, accepted and buckets for this many samples.
    std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity) const noexcept;

    struct Impl; ///< Internal.

  private:
    friend class Sampler;
    explicit Job(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
