// FrameNeighbours: finds neighbours in the frames of an engine and leaves them on the device.
//
// It allocates one buffer for its work and one for the lists, records a bounded amount of work into
// the caller's command buffers, and returns where the lists are. A compute shader of the engine can
// go on with them; the host reads a few words only.
// Experimental.
#pragma once

#include <cstdint>
#include <memory>

#include <vulkan/vulkan_core.h>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// How a FrameNeighbours divides its work and who reads its lists.
struct FrameNeighbourOptions {
    /// Memory for disks in progress, in bytes. With more memory, a wide device computes more disks
    /// at once.
    std::uint64_t pool_bytes = std::uint64_t{16} << 20;
    /// Memory for the paths that the disks of some sources find, 16 bytes each. Sources are taken
    /// in parts that probably fit. Three times as much is allocated.
    std::uint64_t record_bytes = std::uint64_t{16} << 20;
    /// Maximum of command buffers in flight, 1 to 16, including the one that record() is called
    /// for.
    std::uint32_t frames = 2;
    /// Maximum of passes that one record() uses to put neighbours in lists, or to begin a part.
    std::uint32_t dispatches = 16;
    /// Rounds that one record() uses to compute disks.
    std::uint32_t rounds = 2;
    /// Stages and accesses of the caller's commands that read the lists, on the same queue.
    /// record() waits for such commands before it, and makes the lists visible to those after it.
    SyncScope readers{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                      VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT};
};

/// Location of the lists on the device: the neighbours of each source, one source after the other.
/// Offsets are in bytes and aligned for storage buffers.
struct FrameNeighbourLists {
    /// Buffer with the usage of kWorkspaceUsage and of a vertex buffer.
    VkBuffer buffer = VK_NULL_HANDLE;
    /// First of `sources` + 1 words: where the neighbours of each source begin, and one past the
    /// last. The next word is the number of sources whose neighbours are complete. Words of later
    /// sources may be anything.
    VkDeviceSize offsets_offset = 0;
    /// First of `capacity` words: the index of each neighbour, as Neighbours::indices.
    VkDeviceSize indices_offset = 0;
    /// First of `capacity` floats: the distance of each neighbour, in mesh units.
    VkDeviceSize distances_offset = 0;
    std::uint32_t sources = 0;
    std::uint32_t capacity = 0; ///< Number of neighbours that fit.
    /// Number of sources whose neighbours are complete, as far as the host knows. The device may
    /// have more.
    std::uint32_t ready = 0;
    std::uint32_t pairs = 0; ///< Number of neighbours of those.
    /// True if these are all neighbours.
    bool is_complete = false;
    double error = 0; ///< Neighbours::error, for the sources that are ready.
};

/// Finds neighbours over as many frames as it takes: to the bit those of find_neighbours(), or up
/// to rounding if only the nearest are kept, for which disks here are as large as the distance.
///
/// Movable. Use it in one thread at a time. The sampler's device must outlive it. Destroy it only
/// when no command buffer that it recorded into is pending.
class GEODISK_API FrameNeighbours {
  public:
    /// Allocates memory, through DeviceRefs::memory_hooks if set, and records nothing. `mesh` and
    /// all that `query` refers to must outlive the search; the query itself is copied.
    ///
    /// Errors: those of a query that find_neighbours() refuses; `invalid_argument` for a query
    /// without distances, for more than 4,096 joined vertices in one place, or options out of
    /// range; `workspace_too_small` if pool_bytes holds no disk; those of
    /// Sampler::workspace_needs(), Sampler::prepare() and Vulkan.
    static Result<FrameNeighbours> create(std::shared_ptr<const Sampler> sampler,
                                          const PreparedMesh& mesh, const NeighbourQuery& query,
                                          const FrameNeighbourOptions& options = {}) noexcept;
    FrameNeighbours(FrameNeighbours&&) noexcept;
    FrameNeighbours& operator=(FrameNeighbours&&) noexcept;
    ~FrameNeighbours();

    /// Records the next part of the work. Returns true when all neighbours are complete, and
    /// records nothing more. The command buffer must be as for Sampler's recording. Call it only
    /// when the command buffer recorded `frames` calls ago has completed, and submit the command
    /// buffers in the order of the calls.
    ///
    /// Memory that turns out too small is replaced: the lists then move to a larger buffer, with
    /// what they have, and the old one is freed once no frame uses it. Allocates only then.
    ///
    /// Errors: those of Job::advance(); `job_too_large` for more pairs than
    /// NeighbourQuery::max_pairs or than the device binds at once; `invalid_argument` if a command
    /// buffer with uploads was not submitted; `out_of_device_memory`. After an error, the lists of
    /// the sources that are ready remain valid.
    Result<bool> record(VkCommandBuffer commands) noexcept;

    /// Submits with a runner and waits until all neighbours are complete. No command buffer of
    /// record() may be pending. Errors: those of record(); `cancelled`; those of submissions.
    Result<Done> find_and_wait(Runner& runner, const ProgressCallback& progress = {}) noexcept;

    /// Returns where the lists are. Valid until the next call of record() or find_and_wait().
    FrameNeighbourLists lists() const noexcept;

    /// Returns the bytes allocated on the device, including memory that is about to be freed.
    std::uint64_t device_bytes() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit FrameNeighbours(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
