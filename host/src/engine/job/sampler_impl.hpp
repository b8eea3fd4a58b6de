// Members of Sampler and Job; shared by the files that implement them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include <geodisk/sampler.hpp>

#include "engine/domain/tolerances.hpp"
#include "engine/job/order_cut.hpp"
#include "engine/job/pool_plan.hpp"
#include "engine/kernels/pipelines.hpp"
#include "push.h"
#include "records.h"
#include "vk/dispatch.hpp"

namespace geodisk {

struct Sampler::Impl {
    DeviceRefs device;
    DeviceReport report;
    DeviceTable vk;
    KernelChoices choices;
    Events events;
    mutable Pipelines pipelines; ///< Compiled on first use.
    /// The device may be using the pipelines and what jobs hold for ever: destroy none.
    std::atomic<bool> abandoned = false;
    /// True if its arithmetic was found to be as decisions need it.
    mutable std::atomic<bool> rounds_well = false;

    Impl(const DeviceRefs& refs, DeviceReport of_device, const DeviceTable& table,
         const KernelChoices& chosen, const SamplerOptions& options)
        : device(refs), report(std::move(of_device)), vk(table), choices(chosen),
          events(options.events), pipelines(device, vk, choices, options.threads) {}

    static const Impl& of(const Sampler& sampler) { return *sampler.impl_; }
    void abandon() {
        abandoned = true;
        pipelines.abandon();
    }
    /// Returns what SamplerOptions::ahead asks for.
    std::optional<KernelVariant> variant_ahead(Ahead ahead) const;
    /// Returns the variant of the kernels for a domain.
    KernelVariant variant_for(const Domain& domain) const;
    /// Returns true if the kernels are those that read texels, of the two variants.
    bool reads_texels() const { return choices.tuning.reads == Reads::texels; }
};

/// Work groups of a dispatch: Vulkan promises no more.
inline constexpr std::uint32_t kMaxGroups = 65535;

/// A descriptor set of a job: a kernel over the workspace, or a scan kernel over another buffer.
enum class SetRole : std::uint32_t { workspace, cell_scan, start_scan, bucket_scan };
inline constexpr std::size_t kSetRoles = 4;

class StageClock;

/// Position in a sequence of dispatches that is recorded in parts.
struct Cursor {
    std::uint32_t step = 0; ///< Passes recorded.
    std::uint64_t done = 0; ///< Work groups or bytes recorded of the current pass.
    bool is_at_start() const { return step == 0 && done == 0; }
};

/// Numbers that no two jobs of the process have, nor what they begin: memory of one may become
/// another's, and a copy of the control record there is then to tell nothing.
std::uint32_t next_number() noexcept;

struct Job::Impl {
    const Sampler::Impl* sampler = nullptr;
    std::uint32_t number = 0;    ///< Value of next_number(); each domain gets a new one.
    StageClock* clock = nullptr; ///< Clock on which recording marks the stages; null for none.
    VkDescriptorPool descriptor_pool = VK_NULL_HANDLE;
    std::array<std::array<VkDescriptorSet, kKernels>, kSetRoles> sets{};
    std::optional<DomainKind> sets_for; ///< Once they are allocated and bound.
    Workspace workspace{};
    /// Views of the workspace's buffers that some kernel reads as texels.
    std::array<VkBufferView, kBufferRoles> views{};
    const KernelPipelines* own_pipelines = nullptr; ///< Besides those that all jobs have.
    KernelVariant variant;
    std::uint32_t max_slots = 0; ///< Slots that the slot and control buffers hold.
    std::uint32_t max_lanes = 0; ///< Lanes of the first plan.
    // As Domain::Impl has them.
    bool has_lane_per_slot = false;
    Stages stages;
    double samples_per_measure = 0;
    ErrorModel error;
    RunPlan plan;
    gpu::JobRec constants{}; ///< On the device once record_begin() is recorded.
    /// True unless all faces have one cell: the table of cells is then that of starts.
    bool has_cells() const { return constants.cells != 0; }
    gpu::Push push{};
    Cursor begun, finished, counted; ///< Positions in record_begin, record_finish, record_count.
    std::uint32_t generation = 0;    ///< See ControlRec.
    bool is_begin_due = true;        ///< record_begin() of the stages at hand.
    std::uint32_t existing = 0;      ///< Samples that are settled from the start,
    std::uint32_t avoided = 0;       ///< of which so many, the first, are points to avoid.
    std::uint32_t classes = 0;       ///< Domain::Impl::classes.
    bool has_shares = false;         ///< Domain::Impl::has_shares.
    std::uint64_t thrown = 0;        ///< Candidates of the stages before.
    /// Lowest order, of these stages, that does not take part. Unknown while the exact number of
    /// darts is still to be found: none is decided until then.
    std::uint32_t chunk_end = 0;
    bool awaits_cut = false;
    std::optional<OrderCut> cut;
    std::uint64_t end_order = kAllOrders; ///< Order given to Job::set_end_order().
    bool is_pool_divided = true;          ///< By a plan, since the pool was cleared.
    bool is_end_changed = false;          ///< Rounds recorded next go on to another push.end_order.
    bool is_count_due = false;            ///< record_count().
    bool is_stop_counted = false;         ///< It has counted up to the last sample.
    std::uint64_t dispatches = 0;         ///< Recorded, empty ones included.
    std::uint32_t ready = 0;              ///< Samples known to be in order and final.

    bool has(std::size_t kernel) const {
        return kernel_info(static_cast<Kernel>(kernel)).serves(variant.domain);
    }
    VkPipeline pipeline(std::size_t kernel) const {
        const VkPipeline own = (*own_pipelines)[kernel];
        return own != VK_NULL_HANDLE ? own : sampler->pipelines.common()[kernel];
    }
    void begin_stages(std::uint32_t first, std::uint32_t count);
    void begin_first_stages();
    void set_seed(std::uint64_t seed);
    /// Restarts with other existing samples, so many, of which the first ones are points to avoid.
    /// They are written to the samples buffer before record_begin().
    void restart(std::uint32_t settled, std::uint32_t of_avoided) {
        existing = settled;
        avoided = of_avoided;
        begin_first_stages();
    }
    /// Sets the end of the orders to decide, for what is recorded next.
    void apply_end();
    /// Returns true if all stages from this one on are to wait.
    bool waits_for(std::uint64_t stage) const { return end_order <= stage << gpu::kPriorityBits; }
    /// Candidates of the stages at hand that take part.
    std::uint64_t darts(const gpu::ControlRec& control) const {
        return cut ? cut->count() : control.drawn;
    }
    /// Candidates decided so far, approximately.
    double decided(const gpu::ControlRec& control) const;
    /// Candidates up to the last that takes part, once all are decided; 0 if not known.
    std::uint64_t candidates(const gpu::ControlRec& control) const;
    /// Stages to draw next, where all of those at hand are decided.
    std::uint32_t stages_left(const gpu::ControlRec& control) const;
    Result<Advice> advance(const gpu::ControlRec& control, std::uint64_t pool_bytes,
                           LastResort last = LastResort::lanes);
    /// Finds the end of an exact number of darts by the count of an earlier record_count().
    void find_cut(const gpu::ControlRec& control);
    static Impl& of(Job& job) { return *job.impl_; }
    static const Impl& of(const Job& job) { return *job.impl_; }
    ~Impl();
    /// Sets it out for a domain in a workspace. Of buffers that are as they were, and kernels of
    /// the same kind of domain, nothing is written anew.
    Result<Done> set_out(const Domain& of, const RunPlan& new_plan, const Workspace& ranges);
    std::span<const KernelBinding> bindings_of(std::size_t kernel) const;
    Result<Done> allocate_sets();
    Result<Done> bind(const Workspace& ranges, bool all);
    Result<VkBufferView> create_view(std::size_t buffer, const BufferRange& range) const;
    void destroy_view(VkBufferView view) const;
    /// Binds a buffer wherever kernels use it.
    void write_buffer(std::size_t buffer) const;
    Result<Done> replace_buffer(std::size_t buffer, const BufferRange& range);
    /// Compiles those that it lacks.
    Result<Done> choose_kernels(KernelVariant wanted, const RunPlan& for_plan);
    void apply_plan(const RunPlan& new_plan);
    /// Returns the push block of work groups for large disks.
    gpu::Push large_push() const;
};

} // namespace geodisk
