// What Sampler and Job hold; shared by the files that implement them.
#pragma once

#include <array>
#include <cstdint>

#include <geodisk/sampler.hpp>

#include "engine/kernel_table.hpp"
#include "push.h"
#include "vk/dispatch.hpp"

namespace geodisk {

struct Sampler::Impl {
    DeviceRefs device;
    DeviceReport report;
    DeviceTable vk;
    Tuning tuning; ///< All chosen.
    bool native_rounding = false;
    std::uint32_t counted_lanes = 0; ///< Of a subgroup, 0 unless trips are counted.
    bool count_calls = false;
    Domain domain = Domain::surface;
    std::uint32_t dimension = 0; ///< Of boxes and space.
    bool takes_curves = false;   ///< Instead of straight lines in space.
    bool adaptive = false;
    std::array<VkDescriptorSetLayout, kKernels> set_layouts{};
    std::array<VkPipelineLayout, kKernels> layouts{};
    std::array<VkPipeline, kKernels> pipelines{};
    /// The device may be using these objects and those of the jobs for ever: destroy none.
    bool abandoned = false;

    /// As Sampler::create, with the kernels of a domain; the rest is as in the members.
    static Result<Sampler> create_for(Domain domain, std::uint32_t dimension,
                                      const DeviceRefs& device, const SamplerOptions& options,
                                      bool takes_curves = false);
    static const Impl& of(const Sampler& sampler) { return *sampler.impl_; }
    ~Impl();
    bool has(std::size_t kernel) const {
        return kernel_info(static_cast<Kernel>(kernel)).serves(domain);
    }
    /// Of the two variants of the kernels, which.
    bool reads_texels() const { return tuning.reads == Reads::texels; }
    /// Dispatches of count_calls per round: as for resolve, the next round goes on.
    std::uint32_t count_passes() const { return count_calls ? 2 : 0; }
    /// Whether the kernels are those for the radii of a run.
    Result<Done> check_radii(const SampleParams& params) const;
    Result<Done> create_pipelines();
    Result<Done> create_pipeline(Kernel kernel);
};

/// A descriptor set of a job: a kernel over the workspace, or a scan kernel over another buffer.
enum class SetRole : std::uint32_t { workspace, cell_scan, start_scan, bucket_scan };
inline constexpr std::size_t kSetRoles = 4;

class StageClock;

struct Job::Impl {
    const Sampler::Impl* sampler = nullptr;
    StageClock* clock = nullptr; ///< Where recording marks the stages, if anywhere.
    VkDescriptorPool descriptor_pool = VK_NULL_HANDLE;
    std::array<std::array<VkDescriptorSet, kKernels>, kSetRoles> sets{};
    Workspace workspace{};
    /// Of the workspace's buffers that some kernel reads as texels.
    std::array<VkBufferView, kBufferRoles> views{};
    std::uint32_t most_slots = 0; ///< What the slot and control buffers hold.
    std::uint32_t most_steps = 0; ///< Steps that a dispatch of detect may safely take.
    Stages stages;
    double samples_per_measure = 0; ///< Expected, per unit of area or volume.
    RunPlan plan;
    gpu::Push push{};

    /// What a domain tells of a job besides its push block.
    struct OfJob {
        Stages stages;
        double samples_per_measure;
        std::uint32_t most_steps;
    };
    /// Writes the descriptor sets of a workspace that is large enough. `push` is what neither the
    /// plan nor the stages tell.
    static Result<Job> open(const Sampler::Impl& sampler, const RunPlan& plan,
                            const Workspace& workspace, const gpu::Push& push, const OfJob& of);
    void begin_stages(std::uint32_t first, std::uint32_t count);
    static Impl& of(Job& job) { return *job.impl_; }
    static const Impl& of(const Job& job) { return *job.impl_; }
    ~Impl();
    Result<Done> write_sets();
    Result<VkBufferView> create_view(std::size_t buffer, const BufferRange& range) const;
    void destroy_view(VkBufferView view) const;
    /// Binds a buffer wherever kernels use it.
    void write_buffer(std::size_t buffer) const;
    Result<Done> replace_buffer(std::size_t buffer, const BufferRange& range);
    void apply_plan(const RunPlan& new_plan);
    /// Counts the candidates of lower order into ControlRec::below; none may be active.
    void record_count(VkCommandBuffer commands, std::uint32_t end_order) const;
    /// Sets out the first batch anew, after a change of the push block.
    void record_restart(VkCommandBuffer commands) const;
};

/// Work groups for `count` invocations, folded over two dimensions where one is not enough.
struct Groups {
    std::uint32_t x, y;
};
constexpr Groups groups_for(std::uint64_t count, std::uint32_t local_size) {
    const std::uint64_t groups = (count + local_size - 1) / local_size;
    const std::uint64_t rows = (groups + 65534) / 65535;
    return {static_cast<std::uint32_t>(rows == 0 ? 0 : (groups + rows - 1) / rows),
            static_cast<std::uint32_t>(rows)};
}

} // namespace geodisk
