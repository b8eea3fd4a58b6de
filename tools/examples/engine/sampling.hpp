// geodisk in the engine: a few rounds in every frame, samples placed where the engine draws them.
#pragma once

#include <optional>

#include <geodisk/placement.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/shaders/records.h>

#include "gpu.hpp"

namespace engine {

/// The engine's own vertex and index buffers, which geodisk reads as well.
struct SurfaceBuffers {
    geodisk::BufferRange vertices, indices;
    std::uint32_t stride, position, normal;
};

/// One job, its memory in the engine's blocks.
class Sampling {
  public:
    /// The access of draws to what `placed` and `arguments` hold.
    static constexpr geodisk::SyncScope kDraw{
        VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT,
        VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT};
    static constexpr std::uint32_t kVerticesEach = 6;

    Sampling(const Gpu& gpu, const geodisk::Domain& domain, const SurfaceBuffers& surface,
             Block& device_block, Block& host_block);

    /// The mesh, once.
    void record_upload(VkCommandBuffer commands);
    /// A bounded part of the work, for the frame of this turn, whose last commands have ended.
    void record(VkCommandBuffer commands, std::uint32_t turn);
    bool is_complete() const { return is_complete_; }

    const geodisk::BufferRange& placed() const { return placed_; }
    const geodisk::BufferRange& arguments() const { return arguments_; }

  private:
    const geodisk::Domain& domain_;
    Block& host_block_;
    geodisk::Sampler sampler_;
    geodisk::RunPlan plan_;
    geodisk::Workspace workspace_;
    std::optional<geodisk::Job> job_;
    std::optional<geodisk::Placement> placement_;
    geodisk::BufferRange placed_, arguments_, staging_;
    geodisk::BufferRange controls_[Frames::kInFlight]; ///< Copies that the host reads.
    bool is_begun_ = false, is_complete_ = false;
};

} // namespace engine
