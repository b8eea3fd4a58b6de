// Sampler: records a sampling job into the caller's command buffers. It allocates no memory,
// submits nothing and waits for nothing.
//
// How a job of a Domain goes:
//   1. plan_run             how many candidates are active at a time, how many invocations compute
//                           their disks, and how much memory each gets
//   2. workspace_needs      sizes of the buffers; the caller allocates them
//   3. write_upload         what to upload before the first use
//   4. make_job             writes descriptor sets; nothing is recorded yet
//   5. record_begin         draws the candidates of the first stages; whole, or some dispatches in
//                           one command buffer and the rest in later ones
//   6. record_rounds        a fixed number of rounds; those after the last cost empty dispatches.
//                           Submit, copy gpu::ControlRec from the control buffer, and do what
//                           Job::advance makes of it
//   7. record_finish        at any time, and in parts as 5: gpu::SampleRec per accepted candidate,
//                           in dart order. ControlRec::ready of them are final: the first of all
//                           that will be accepted
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

namespace geodisk {

/// How shaders divide and take roots. Both ways return the correctly rounded result.
enum class Rounding : std::uint32_t {
    automatic, ///< Native where the device is known to round correctly, else emulated.
    native,
    emulated,
};

/// In which order a disk takes the vertices that shortest paths may bend at. Both find the same
/// disks; their windows, and so ControlRec::longest_chain, may differ.
enum class Events : std::uint32_t {
    automatic, ///< The nearest first where disks are expected to cover 2^14 faces or more, else the
               ///< oldest.
    nearest,   ///< From a heap, which makes fewer windows on large disks.
    oldest,    ///< From a ring.
};

/// How shaders read what they do not write. Both ways return the same bits.
enum class Reads : std::uint32_t {
    automatic, ///< Texel buffers where they are known to be faster (llvmpipe), else storage
               ///< buffers.
    storage,
    texels,
};

/// "auto", "storage" or "texels".
GEODISK_API const char* to_string(Reads reads) noexcept;

/// What suits a device best. No choice changes the samples; 0 and `automatic` choose by the
/// device's type and limits.
struct Tuning {
    /// Invocations per work group of the kernels per candidate and per sample; a power of two up to
    /// the device's limit.
    std::uint32_t local_size = 0;
    /// The same for the kernels per slot and per lane.
    std::uint32_t slot_local_size = 0;
    /// Lanes whose rows alternate in the pool, a power of two up to kMostPoolBlock: 1 keeps the
    /// rows of a lane together, the subgroup's size lets a subgroup read side by side.
    std::uint32_t pool_block = 0;
    /// Batches to aim at, of equal numbers of slots. More of them leave fewer disks that are
    /// computed in vain, fewer are larger and cost fewer dispatches (paper section 5.3, N/T).
    std::uint32_t batches = 0;
    Reads reads = Reads::automatic;
};
/// For Tuning::pool_block.
inline constexpr std::uint32_t kMostPoolBlock = 128;

/// `tuning` with all that `wanted` does not leave open in place of its own.
GEODISK_API Tuning overridden(Tuning tuning, const Tuning& wanted) noexcept;

/// `wanted` with all that it leaves open chosen for a device. Errors: `invalid_argument` for a size
/// or a pool block that cannot be, `device_lacks` for Reads::texels on a device whose texel buffers
/// are too small.
GEODISK_API Result<Tuning> chosen_tuning(const Tuning& wanted, const DeviceReport& report) noexcept;

/// How pipelines are made, and what they count besides.
struct SamplerOptions {
    Tuning tuning;
    Rounding rounding = Rounding::automatic;
    Events events = Events::automatic;
    /// Counts in gpu::ControlRec how long lanes of detect wait for others of their subgroup; takes
    /// a little time.
    bool count_trips = false;
    /// Counts what RunReport::calls tells, which takes dispatches of its own. Does not change the
    /// samples.
    bool count_calls = false;
};

/// The buffers of a job, in the order of the bindings in shaders/shared/bindings.h.
enum class BufferRole : std::uint32_t {
    faces,
    fans,
    keys,
    cells,
    states,
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
    // The same buffers where distances go through space.
    corners = faces, ///< Of a surface.
    axes = fans,     ///< Of the grid.
    points = weights,
};
/// Of BufferRole.
inline constexpr std::size_t kBufferRoles = 15;

/// Name of a role as spelled first, for messages.
GEODISK_API const char* to_string(BufferRole role) noexcept;

/// A range of a caller's buffer, bound as storage and texel buffer: `offset` a multiple of the
/// device's minStorageBufferOffsetAlignment and minTexelBufferOffsetAlignment.
struct BufferRange {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    friend bool operator==(const BufferRange&, const BufferRange&) = default;
};

/// The memory of one job. Owned by the caller; ranges must not overlap while the job runs. Create
/// the buffers with `kWorkspaceUsage`.
using Workspace = std::array<BufferRange, kBufferRoles>;
/// What the buffers of a Workspace are used for.
inline constexpr VkBufferUsageFlags kWorkspaceUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
    VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
    VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

/// Bytes each buffer needs at least; one that needs none may be left out.
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

/// How a job is cut into work. Nothing but `error_bound` bears on which samples come out, and that
/// only where a distance is within the guard of the minimum.
struct RunPlan {
    std::uint32_t slots = 0;           ///< Candidates active at a time, at least kLeastSlots.
    std::uint32_t lanes = 0;           ///< Invocations that compute their disks, one after another.
    std::uint32_t window_capacity = 0; ///< Windows waiting in a lane, and vertex events; a power of
                                       ///< two.
    std::uint32_t table_capacity = 0;  ///< Rows of a lane's vertex table, used by half; a power of
                                       ///< two.
    std::uint32_t list_capacity = 0;   ///< Conflicts per slot, a multiple of 4.
    std::uint32_t step_budget = 0;     ///< Steps of a lane per dispatch, each gpu::kTripsPerStep
                                       ///< windows or corners; cut to what the device can take.
    std::uint32_t detect_passes = 0;   ///< Dispatches of detect per round.
    std::uint32_t sample_capacity = 0; ///< Samples the buffers hold; more than slots.
    std::uint32_t pool_block = 0;      ///< As Sampler::tuning has it, or 1 where not even one
                                       ///< block of such lanes fits the pool: by kernels of their
                                       ///< own, compiled when a job first needs them.
    std::uint32_t stages = 0;          ///< Stages whose candidates are drawn at once; 1 of darts.
    std::uint32_t idle_capacity = 0;   ///< Places in the list of candidates that come next;
                                       ///< at most 2^23.
    bool trims = false; ///< Disks that make very many windows trim them, and windows that
                        ///< cross very many edges come back to no face: by kernels of
                        ///< their own, compiled when a job first needs them, and with
                        ///< 129 KiB more for each lane.
    std::uint32_t dispatch_items = 0; ///< Faces, candidates, samples or words that a dispatch goes
                                      ///< through at most, but at least one work group of them.
    /// Of what rounding does to a distance, in minimum distances, at most 1/2. The guard is that,
    /// of surfaces rounded up to a power of two (host/docs/precision.md).
    double error_bound = 0;

    /// A lane's slice of the pool, in rows of 16 bytes.
    GEODISK_API std::uint32_t lane_rows() const noexcept;
    /// The first row of the lists: behind the slices of all lanes, up to a whole block of them.
    GEODISK_API std::uint64_t first_list_row() const noexcept;
    /// The slices of all lanes and the lists of all slots.
    GEODISK_API std::uint64_t pool_bytes() const noexcept;
};

/// Bounds no recording.
inline constexpr std::uint32_t kAllDispatches = ~std::uint32_t{0};

/// As many candidates never share one priority.
inline constexpr std::uint32_t kLeastSlots = 8;

/// Stages and accesses of the first commands that touch the workspace (the caller's earlier writes
/// must be made visible to them) and of the last ones (to be waited for before reading).
struct SyncScope {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
};

/// What comes next for a job.
enum class Next : std::uint32_t {
    begin,          ///< record_begin: the first stages, more of them, or what is left of it.
    go_on,          ///< record_rounds; or the control record is older than what was recorded last.
    finish,         ///< record_finish, or what is left of it: all candidates of these stages are
                    ///< decided.
    larger_pool,    ///< Job::set_plan with Advice::plan, then record_rewind.
    larger_samples, ///< Job::set_samples with Advice::sample_capacity, then record_rewind.
    start_over,     ///< A new job, of Advice::plan: the guard was made for shorter window chains.
    complete,       ///< The samples are there, the first Advice::ready.
};

/// Name of it as spelled above.
GEODISK_API const char* to_string(Next next) noexcept;

/// What Job::advance says.
struct Advice {
    Next next = Next::go_on;
    /// The job's, or the one to go on with. Its pool_bytes() tell how large the pool must be.
    RunPlan plan;
    std::uint32_t sample_capacity = 0; ///< The least that goes on, and half as many again.
    /// Number of samples in order and final, as far as the host knows; grows until the next seed or
    /// domain.
    std::uint32_t ready = 0;
};

namespace gpu {
struct ControlRec;
}

class Job;

/// The pipelines of a device, for jobs of all domains. Any number of threads may use one.
class GEODISK_API Sampler {
  public:
    /// Compiles the pipelines that all domains share on the lent device.
    /// Errors: `device_lacks` with every reason; as chosen_tuning(); or as Vulkan fails.
    static Result<Sampler> create(const DeviceRefs& device,
                                  const SamplerOptions& options = {}) noexcept;
    Sampler(Sampler&&) noexcept;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();

    const DeviceReport& report() const noexcept;
    /// As given, with what was left to choose.
    const Tuning& tuning() const noexcept;

    /// Compiles what jobs of the domain need beyond what `create` compiled, unless it was before;
    /// else make_job does. Errors: as Vulkan fails.
    Result<Done> prepare(const Domain& domain) const noexcept;

    /// Compiles the kernels of all domains, unless they were before, and tells what the driver says
    /// of each. Errors: `invalid_argument` unless DeviceRefs::pipeline_statistics is set; as Vulkan
    /// fails.
    Result<std::vector<KernelReport>> report_kernels() const noexcept;

    /// A plan for this device whose pool is at most `pool_bytes` (and one binding) large.
    /// Errors: `workspace_too_small` if not even one lane fits.
    Result<RunPlan> plan_run(const Domain& domain, std::uint64_t pool_bytes) const noexcept;

    /// The plan after an overflow: the capacities named by `overflow` (gpu::kOverflow* bits)
    /// doubled, slots and lanes fewer if the pool would grow past `pool_bytes`. Errors:
    /// `workspace_too_small` naming the bytes one lane and one list of conflicts take.
    Result<RunPlan> grow_plan(const RunPlan& plan, std::uint32_t overflow,
                              std::uint64_t pool_bytes) const noexcept;

    /// The plan to start over with where ControlRec::longest_chain came out too long for
    /// `error_bound`, which is larger then; else the same plan.
    RunPlan widen_plan(const Domain& domain, RunPlan plan,
                       std::uint32_t longest_chain) const noexcept;

    /// Buffers for the plan that do as well for the plans of so many regrowths, each with
    /// capacities of disks twice as large, and half as many samples again. Errors: `job_too_large`
    /// when a buffer would exceed what the device can bind, naming buffer, candidates and bytes; as
    /// grow_plan() for regrowths that no pool holds.
    Result<WorkspaceNeeds> workspace_needs(const Domain& domain, const RunPlan& plan,
                                           std::uint32_t regrowths = 0) const noexcept;

    /// Lays out all buffers one after the other in a single one, each aligned as the device asks.
    WorkspaceLayout lay_out(const WorkspaceNeeds& needs) const noexcept;

    /// Bytes that the caller is to upload into a buffer; 0 for buffers that need none.
    std::size_t upload_size(const Domain& domain, BufferRole role) const noexcept;
    /// The first of them, which follow from the meshes alone: where they were uploaded for other
    /// distances, seeds or radii on the same meshes, they stay as they are.
    std::size_t mesh_bytes(const Domain& domain, BufferRole role) const noexcept;
    /// Writes them, or those behind mesh_bytes() where `from` is that: `out` must hold exactly as
    /// many. Errors: `invalid_argument` for a buffer that needs none, or for another size;
    /// `out_of_host_memory`.
    Result<Done> write_upload(const Domain& domain, const RunPlan& plan, BufferRole role,
                              std::span<std::byte> out, std::size_t from = 0) const noexcept;

    /// Writes descriptor sets for a workspace. The job keeps no reference to the domain; the
    /// Sampler must outlive it. Errors: `invalid_argument` for a plan that is not as RunPlan asks,
    /// or a workspace that overlaps or is off alignment; `workspace_too_small`; as
    /// workspace_needs(); as Vulkan fails.
    Result<Job> make_job(const Domain& domain, const RunPlan& plan,
                         const Workspace& workspace) const noexcept;

    /// @name Recording
    /// The command buffer must be in the recording state, outside a render pass, on a
    /// family with compute. Each call leaves compute pipeline, descriptor set 0 and push constants
    /// changed, and begins and ends with its own barriers among the job's buffers.
    ///
    /// The rounds of later stages begin with the disks of all samples so far, which reject the
    /// candidates. The samples are those of all stages at once.
    ///
    /// record_finish may be recorded between any rounds, and as often as is liked: what it leaves
    /// is put in order once and stays, and the rest grows.
    ///
    /// No dispatch grows with the mesh or the candidates: RunPlan::dispatch_items bounds those that
    /// go through them, RunPlan::step_budget and lanes those of disks. record_begin and
    /// record_finish record at most `dispatches` of theirs, clears of memory included, from where
    /// the call before stopped, and return whether those were the last. What they have left is
    /// recorded first by whatever call comes next. A round is 2 dispatches and
    /// RunPlan::detect_passes, and 2 more with SamplerOptions::count_calls.
    /// @{

    /// Draws the candidates of the next stages. Whether that was all of it.
    bool record_begin(VkCommandBuffer commands, Job& job,
                      std::uint32_t dispatches = kAllDispatches) const noexcept;
    /// So many rounds; those behind the last one that has work cost empty dispatches.
    void record_rounds(VkCommandBuffer commands, Job& job, std::uint32_t rounds) const noexcept;
    /// Begins the batch in progress anew, with what Job::set_plan or set_samples changed.
    void record_rewind(VkCommandBuffer commands, Job& job) const noexcept;
    /// Puts what is decided so far in order, as gpu::SampleRec. Whether that was all of it.
    bool record_finish(VkCommandBuffer commands, Job& job,
                       std::uint32_t dispatches = kAllDispatches) const noexcept;
    /// @}

    /// How a job first touches its workspace: what was written there before must be visible to it.
    static constexpr SyncScope kFirstUse{
        VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
    /// And last: what reads the results must wait for it.
    static constexpr SyncScope kLastUse{VK_PIPELINE_STAGE_TRANSFER_BIT |
                                            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                        VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT};

    struct Impl; ///< Internal.

  private:
    friend class Runner;
    explicit Sampler(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// A workspace made ready for one sampling job. Movable. One recording thread at a time; its
/// command buffers must run one after the other, and it must outlive their execution.
class GEODISK_API Job {
  public:
    Job(Job&&) noexcept;
    Job& operator=(Job&&) noexcept;
    ~Job();

    const RunPlan& plan() const noexcept;
    /// Makes it one of another domain, in the same workspace, whose buffers must still be what they
    /// were; nothing is allocated if it is of the same kind. What write_upload() gives for that
    /// domain is to be uploaded, and a Placement is to be made anew. No command buffer of the job
    /// may be pending. Errors: as make_job(); after one it can only be renewed again.
    Result<Done> renew(const Domain& domain, const RunPlan& plan) noexcept;
    /// Begins anew with another seed; what was uploaded stays.
    void set_seed(std::uint64_t seed) noexcept;
    /// Tells what comes next, by a copy of the control record that the host has read. Copies of
    /// before the last record_begin or record_rewind say nothing, so that several frames may be in
    /// flight; the same copy may be given twice. Sets the job to its next stages where Next::begin
    /// comes after others. A larger pool is one of at most `pool_bytes`, or 0 for as much as the
    /// workspace has.
    ///
    /// Errors: `mesh_rejected` where the mesh defeats single precision, naming the face of a
    /// candidate (of several surfaces numbered on from one to the next); `invalid_argument` where
    /// no candidate was drawn, as what write_upload() gives was not uploaded; `internal` where the
    /// device defeats its control record; `workspace_too_small` as grow_plan(); `job_too_large`
    /// where no binding holds the samples.
    Result<Advice> advance(const gpu::ControlRec& control, std::uint64_t pool_bytes = 0) noexcept;
    /// Replaces the plan, for rounds recorded from now on. Its slots must not be more than the job
    /// was made with, its stages and error_bound the same, and its pool must fit the workspace's.
    Result<Done> set_plan(const RunPlan& plan) noexcept;
    /// The same with another pool. No command buffer of the job may be pending.
    Result<Done> set_plan(const RunPlan& plan, const BufferRange& pool) noexcept;
    /// The stages to begin next: `count` of them from `first` on. A new job has the first of all,
    /// as many as RunPlan::stages. They must follow each other, each finished by record_finish
    /// before the next begins; from stage 0 a run starts anew. Errors: `invalid_argument` for more
    /// than RunPlan::stages, none, or numbers beyond 32 bits.
    Result<Done> set_stages(std::uint32_t first, std::uint32_t count) noexcept;
    /// Other buffers for the samples, where ControlRec::accepted and the plan's slots together are
    /// more than RunPlan::sample_capacity, which becomes `capacity`: samples, accepted and buckets,
    /// as large as sample_bytes() tells. The caller copies what samples and accepted hold, then
    /// records rewind. No command buffer of the job may be pending.
    Result<Done> set_samples(std::uint32_t capacity, const BufferRange& samples,
                             const BufferRange& accepted, const BufferRange& buckets) noexcept;
    /// Bytes that samples, accepted and buckets take for so many samples.
    std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity) const noexcept;

    struct Impl; ///< Internal.

  private:
    friend class Sampler;
    explicit Job(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
