#include "sampling.hpp"

#include <cstring>

namespace engine {
namespace {

constexpr std::uint64_t kPoolBytes = std::uint64_t{8} << 20;
// Maximum of dispatches and rounds of a frame.
constexpr std::uint32_t kDispatches = 16;
constexpr std::uint32_t kRounds = 2;

constexpr geodisk::SyncScope kCopy{VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr geodisk::SyncScope kHost{VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT};

constexpr geodisk::BufferRole kRoles[] = {geodisk::BufferRole::faces, geodisk::BufferRole::fans};

} // namespace

Sampling::Sampling(const Gpu& gpu, const geodisk::Domain& domain, const SurfaceBuffers& surface,
                   Block& device_block, Block& host_block)
    : domain_(domain), host_block_(host_block),
      sampler_(take(geodisk::Sampler::create(gpu.refs()))),
      plan_(take(sampler_.plan_run(domain, kPoolBytes))) {
    const auto needs = take(sampler_.workspace_needs(domain, plan_));
    for (std::size_t i = 0; i < needs.bytes.size(); ++i) {
        if (needs.bytes[i] > 0) {
            workspace_[i] = device_block.cut(needs.bytes[i]);
        }
    }
    job_.emplace(take(sampler_.make_job(domain, plan_, workspace_)));

    placed_ = device_block.cut(plan_.sample_capacity * sizeof(geodisk::gpu::PlacedRec));
    arguments_ = device_block.cut(sizeof(VkDrawIndirectCommand));
    geodisk::PlacementSource source;
    source.vertices = surface.vertices;
    source.indices = surface.indices;
    source.stride = surface.stride;
    source.position = surface.position;
    source.normal = surface.normal;
    placement_.emplace(take(geodisk::Placement::create(sampler_, domain, *job_, source,
                                                       {placed_, arguments_, kVerticesEach})));

    VkDeviceSize upload = 0;
    for (const geodisk::BufferRole role : kRoles) {
        upload += sampler_.upload_size(domain, role);
    }
    staging_ = host_block.cut(upload);
    for (geodisk::BufferRange& control : controls_) {
        control = host_block.cut(sizeof(geodisk::gpu::ControlRec));
        std::memset(host_block.bytes(control).data(), 0, control.size);
    }
}

void Sampling::record_upload(VkCommandBuffer commands) {
    std::size_t at = 0;
    for (const geodisk::BufferRole role : kRoles) {
        const std::size_t size = sampler_.upload_size(domain_, role);
        take(sampler_.write_upload(domain_, plan_, role,
                                   host_block_.bytes(staging_).subspan(at, size)));
        const geodisk::BufferRange from{staging_.buffer, staging_.offset + at, size};
        copy(commands, from, workspace_[static_cast<std::size_t>(role)], size);
        at += size;
    }
    // Nothing to draw until samples are placed.
    vkCmdFillBuffer(commands, arguments_.buffer, arguments_.offset, arguments_.size, 0);
    barrier(commands, kCopy,
            {geodisk::Sampler::kFirstUse.stages | kDraw.stages,
             geodisk::Sampler::kFirstUse.access | kDraw.access});
}

void Sampling::record(VkCommandBuffer commands, std::uint32_t turn) {
    // Reads what the frame before the last left. If something was recorded since that it does not
    // report, advance says so.
    geodisk::gpu::ControlRec control;
    const auto bytes = host_block_.bytes(controls_[turn]);
    std::memcpy(&control, bytes.data(), sizeof control);
    const geodisk::Advice advice = take(job_->advance(control));
    switch (advice.next) {
    case geodisk::Next::begin:
        is_begun_ = sampler_.record_begin(commands, *job_, kDispatches);
        break;
    case geodisk::Next::go_on:
    case geodisk::Next::finish:
        if (is_begun_) {
            sampler_.record_rounds(commands, *job_, kRounds);
        } else {
            is_begun_ = sampler_.record_begin(commands, *job_, kDispatches);
        }
        break;
    case geodisk::Next::count:
        sampler_.record_count(commands, *job_, kDispatches);
        break;
    case geodisk::Next::larger_pool: // Within the one there is: fewer lanes with more each.
        take(job_->set_plan(advice.plan));
        sampler_.record_rewind(commands, *job_);
        break;
    case geodisk::Next::complete:
        is_complete_ = true;
        break;
    default:
        throw std::runtime_error("an engine would make larger buffers here, or a new job");
    }
    if (is_begun_ && !is_complete_) {
        // Samples decided so far are final, so they may be drawn in this very frame. Draws of the
        // frame before come first.
        sampler_.record_finish(commands, *job_);
        barrier(commands, kDraw,
                {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT});
        take(placement_->record(commands, *job_));
    }
    barrier(commands, geodisk::Sampler::kLastUse,
            {kCopy.stages | kDraw.stages, kCopy.access | kDraw.access});
    copy(commands, workspace_[static_cast<std::size_t>(geodisk::BufferRole::control)],
         controls_[turn], sizeof control);
    barrier(commands, kCopy,
            {kHost.stages | geodisk::Sampler::kFirstUse.stages,
             kHost.access | geodisk::Sampler::kFirstUse.access});
}

} // namespace engine
