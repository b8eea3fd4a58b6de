// NeighbourMemory and ListMemory: buffers of a FrameNeighbours. The work of a part, and the lists.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/frame_neighbours.hpp>
#include <geodisk/sampler.hpp>

#include "engine/neighbours/neighbour_kernels.hpp"
#include "engine/run/frame_buffers.hpp"
#include "records.h"
#include "samples.h"
#include "vk/buffer.hpp"

namespace geodisk {

/// Input of the kernels for all sources and targets.
struct NeighbourInputs {
    std::vector<gpu::SampleRec> sources; ///< As the device takes existing samples.
    std::vector<float> limits;           ///< Maximum distance of neighbours, a float per source.
    /// If targets have other numbers than their own: where those of each begin, and the end; then
    /// the numbers.
    std::vector<std::uint32_t> names;
};

/// Values that the host reads from the device.
struct NeighbourTold {
    gpu::ControlRec control;
    std::array<std::uint32_t, 4> head; ///< Head of the hits: their number, the room, the first row.
    std::uint32_t entries;             ///< Entries of the current part.
    std::uint32_t longest;             ///< Entries of a source of it, at most.
    std::uint32_t pairs;               ///< Up to the end of the part.
    std::uint32_t spare;
};

/// The lists, which readers use. Movable.
class ListMemory {
  public:
    /// Allocates lists of so many sources with room for so many pairs.
    static Result<ListMemory> create(const Sampler& sampler, std::uint32_t sources,
                                     std::uint32_t pairs);

    VkBuffer buffer() const { return buffer_.handle(); }
    const BufferRange& offsets() const { return offsets_; }
    const BufferRange& targets() const { return targets_; }
    const BufferRange& distances() const { return distances_; }
    std::uint32_t pairs() const { return pairs_; }
    VkDeviceSize bytes() const { return buffer_.size(); }

    /// Records that all are empty. A barrier to and from transfers is the caller's.
    void record_clear(const DeviceTable& vk, VkCommandBuffer commands) const;
    /// Records a copy of the lists of all sources, with so many pairs, from smaller ones.
    void record_copy(const DeviceTable& vk, VkCommandBuffer commands, const ListMemory& from,
                     std::uint32_t pairs) const;

  private:
    DeviceBuffer buffer_;
    BufferRange offsets_, targets_, distances_;
    std::uint32_t pairs_ = 0;
};

/// Not movable, since the job's commands refer to it. Destroy it when none of them is pending.
class NeighbourMemory {
  public:
    /// Allocates memory for jobs like this one, of at most its sources, and stages all uploads.
    static Result<std::unique_ptr<NeighbourMemory>>
    create(const Sampler& sampler, const Domain& domain, const RunPlan& plan, std::uint32_t room,
           const NeighbourInputs& inputs, std::uint32_t frames);

    Job& job() { return *job_; }
    const RunPlan& plan() const { return plan_; }
    std::uint32_t room() const { return room_; } ///< For hits, and for entries.
    std::uint32_t max_sources() const { return max_sources_; }
    /// Word of the rows where the longest one's length is.
    std::uint32_t longest_word() const { return max_sources_ + 2; }
    /// Ranges of the kernels, but for the lists.
    const NeighbourRanges& ranges() const { return ranges_; }
    std::uint64_t device_bytes() const { return buffer_.size(); }

    /// Records the uploads, once.
    void record_upload(const DeviceTable& vk, VkCommandBuffer commands);
    /// Frees the staging memory, after the uploads have completed.
    void free_staging() { uploads_.free(); }
    /// Records that the job has no hits yet, and its sources: so many from this one on.
    void record_part(const DeviceTable& vk, VkCommandBuffer commands, std::uint32_t first,
                     std::uint32_t sources) const;
    /// Records that no source has entries.
    void record_clear_rows(const DeviceTable& vk, VkCommandBuffer commands) const;

    /// Records copies to the host, to place `turn`, for this part.
    void record_told(const DeviceTable& vk, VkCommandBuffer commands, const ListMemory& lists,
                     std::uint32_t first, std::uint32_t sources, std::uint32_t turn) const;
    NeighbourTold told(std::uint32_t turn) const;

  private:
    Result<Done> allocate(const Sampler& sampler, const Domain& domain,
                          const NeighbourInputs& inputs, std::uint32_t frames);
    Result<Done> stage(const Sampler& sampler, const Domain& domain, const NeighbourInputs& inputs);
    const BufferRange& range(BufferRole role) const {
        return workspace_[static_cast<std::size_t>(role)];
    }

    DeviceBuffer buffer_, told_;
    FrameUploads uploads_;
    Workspace workspace_;
    WorkspaceLayout layout_;
    NeighbourRanges ranges_;
    BufferRange sources_;
    RunPlan plan_;
    std::uint32_t room_ = 0;
    std::uint32_t max_sources_ = 0;
    std::optional<Job> job_; // Declared last: destroyed before the buffers.
};

} // namespace geodisk
