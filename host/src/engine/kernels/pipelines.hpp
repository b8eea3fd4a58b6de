// The pipelines of a device, compiled when a job first needs them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/sampler.hpp>
#include <geodisk/threads.hpp>

#include "engine/kernels/kernel_table.hpp"
#include "vk/dispatch.hpp"

namespace geodisk {

/// Null where a job has no use for the kernel.
using KernelPipelines = std::array<VkPipeline, kKernels>;

/// Specialization of the kernels of all jobs.
struct KernelChoices {
    Tuning tuning; ///< All chosen.
    bool native_rounding = false;
    std::uint32_t counted_lanes = 0; ///< Lanes of a subgroup; 0 unless trips are counted.
};

/// Any number of threads may use it at a time.
class Pipelines {
  public:
    /// Compiles on as many threads as the options allow.
    Pipelines(const DeviceRefs& device, const DeviceTable& vk, const KernelChoices& choices,
              const ThreadOptions& threads)
        : device_(device), vk_(vk), choices_(choices), threads_(threads) {}
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;
    ~Pipelines();

    /// Makes the layouts of all kernels and compiles those that every domain has, and at the same
    /// time those of a job if `ahead` is set.
    Result<Done> create(const std::optional<KernelVariant>& ahead);
    /// Those of a job, compiled unless they were before. They stay where they are.
    Result<const KernelPipelines*> of(const KernelVariant& variant);
    const KernelPipelines& common() const { return common_; }

    /// Returns what a kernel binds on this device.
    const KernelInterface& interface_of(Kernel kernel) const {
        return geodisk::interface_of(kernel, reads_texels());
    }
    VkDescriptorSetLayout set_layout(std::size_t kernel) const { return set_layouts_[kernel]; }
    VkPipelineLayout layout(std::size_t kernel) const { return layouts_[kernel]; }
    /// The device may be using them for ever: destroy none.
    void abandon() { abandoned_ = true; }

  private:
    bool reads_texels() const { return choices_.tuning.reads == Reads::texels; }
    struct Specialization {
        std::uint32_t constant, value;
    };
    std::vector<Specialization> specializations(const KernelVariant& variant) const;
    Result<Done> create_layout(std::size_t kernel);
    Result<VkPipeline> compile(Kernel kernel, const KernelVariant& variant) const;
    /// Finds or compiles the kernels that serve these domains alone, for all sets at the same time.
    Result<Done> compile_all(std::span<const std::pair<KernelVariant, KernelPipelines*>> sets);
    /// Destroys those that no job has: a failed call keeps none.
    void drop_unused();

    DeviceRefs device_;
    const DeviceTable& vk_;
    KernelChoices choices_;
    ThreadOptions threads_;
    std::array<VkDescriptorSetLayout, kKernels> set_layouts_{};
    std::array<VkPipelineLayout, kKernels> layouts_{};
    KernelPipelines common_{};
    std::mutex mutex_;                                                ///< Guards the members below.
    std::map<std::pair<Kernel, KernelVariant>, VkPipeline> compiled_; ///< KernelVariant::of.
    std::map<KernelVariant, KernelPipelines> own_;                    ///< Out of those.
    std::atomic<bool> abandoned_ = false;
};

} // namespace geodisk
