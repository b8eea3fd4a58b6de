// NeighbourKernels: puts the hits of a job in lists, on the device.
//
// The hits of a part of the sources come in no order, several to a neighbour. They become entries
// in rows, one row per source; rows are sorted by merging; of each number the shortest stays, and
// all that stay are appended to the lists of the caller. Each pass is a dispatch, or several where
// one would be too large; a barrier among the kernels' buffers follows each.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <geodisk/sampler.hpp>

#include "engine/job/sampler_impl.hpp"
#include "push.h"

namespace geodisk {

/// The buffers of the kernels, see shaders/shared/bindings.h. They may be ranges of one.
struct NeighbourRanges {
    BufferRange hits, names, limits, rows, entries, sorted, sums; ///< Buffers of a part.
    BufferRange offsets, targets, distances;                      ///< Buffers of the caller.
};

/// Destroy it when no command that it recorded is pending. The sampler must outlive it.
class NeighbourKernels {
  public:
    /// Compiles the kernels, if they are not compiled yet. Errors: those of Vulkan.
    static Result<std::unique_ptr<NeighbourKernels>> create(const Sampler::Impl& sampler,
                                                            const NeighbourRanges& ranges);
    NeighbourKernels(const NeighbourKernels&) = delete;
    NeighbourKernels& operator=(const NeighbourKernels&) = delete;
    ~NeighbourKernels();

    /// Makes entries of `push.count` hits. Rows must be all 0 before.
    void record_entries(VkCommandBuffer commands, const gpu::NeighbourPush& push) const;
    /// Merges runs of `push.width` entries, or copies: from the entries, or `back` to them.
    void record_merge(VkCommandBuffer commands, const gpu::NeighbourPush& push, bool back) const;
    /// Drops entries that are not the shortest of their number.
    void record_mark(VkCommandBuffer commands, const gpu::NeighbourPush& push) const;
    /// Chooses the entries that stay. What is sorted is lost.
    void record_keep(VkCommandBuffer commands, const gpu::NeighbourPush& push) const;
    /// Appends those to the lists.
    void record_write(VkCommandBuffer commands, const gpu::NeighbourPush& push) const;

  private:
    /// Buffers that a set has in place of the rows (for scans), and of entries and sorted.
    enum class Role : std::uint32_t { forward, back, places };

    NeighbourKernels(const Sampler::Impl& sampler, const NeighbourRanges& ranges)
        : sampler_(sampler), ranges_(ranges) {}
    Result<Done> make_views();
    Result<Done> make_sets();
    const BufferRange& range_of(Role role, std::uint32_t binding) const;
    VkPipeline pipeline(Kernel kernel) const;
    /// A pass over `count` items, `per_group` to a work group.
    template <class Push>
    void pass(VkCommandBuffer commands, Kernel kernel, Role role, std::uint32_t count,
              std::uint32_t per_group, Push push) const;
    void pass(VkCommandBuffer commands, Kernel kernel, Role role, std::uint32_t count,
              const gpu::NeighbourPush& push) const;
    /// Exclusive scan of the rows or places.
    void scan(VkCommandBuffer commands, Role role, std::uint32_t count) const;

    const Sampler::Impl& sampler_;
    NeighbourRanges ranges_;
    const KernelPipelines* pipelines_ = nullptr;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::map<std::tuple<Role, Kernel>, VkDescriptorSet> sets_;
    std::vector<std::pair<BufferRange, VkBufferView>>
        views_; ///< Views of ranges that are read as texels.
};

} // namespace geodisk
