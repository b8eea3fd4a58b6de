#include "engine/run/frame_memory.hpp"

#include <cstring>
#include <string>
#include <utility>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/sampler_impl.hpp"
#include "samples.h"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kPositionFloats = 3;
constexpr std::uint64_t kMaxVertices = 0xffffffffu;

Result<Done> check_surface(const MeshView& mesh, std::uint64_t faces, const std::string& name) {
    if (mesh.dimension != 2 && mesh.dimension != 3) {
        return invalid(name + " has " + std::to_string(mesh.dimension) +
                       " coordinates per vertex; samples are placed by 2 or 3");
    }
    if (mesh.face_count() != faces) {
        return invalid(name + " has " + std::to_string(mesh.face_count()) +
                       " faces, but that of the domain has " + std::to_string(faces));
    }
    if (mesh.positions.data() == nullptr || mesh.triangles.data() == nullptr) {
        return invalid(name + " has no positions or no triangles");
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangles[i] >= mesh.vertex_count()) {
            return invalid("a face of " + name + " names vertex " +
                               std::to_string(mesh.triangles[i]) + " of " +
                               std::to_string(mesh.vertex_count()),
                           i / 3);
        }
    }
    return Done{};
}

std::span<const std::byte> bytes_of(const auto& values) {
    return std::as_bytes(std::span(values));
}

} // namespace

Result<FrameMesh> FrameMesh::copy(const Domain& domain, std::span<const MeshView> meshes) {
    const std::span<const std::uint32_t> first = domain.first_faces();
    if (first.empty() || meshes.size() + 1 != first.size()) {
        return invalid("there are " + std::to_string(meshes.size()) + " meshes for a domain of " +
                       std::to_string(first.empty() ? 0 : first.size() - 1) + " surfaces");
    }
    FrameMesh all;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const MeshView& mesh = meshes[i];
        const std::string name = meshes.size() == 1 ? "the mesh" : "mesh " + std::to_string(i);
        GEODISK_TRY(check_surface(mesh, first[i + 1] - first[i], name));
        const std::uint64_t base = all.positions.size() / kPositionFloats;
        if (base + mesh.vertex_count() > kMaxVertices) {
            return invalid("the meshes have more vertices than can be numbered");
        }
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            for (std::uint32_t axis = 0; axis < kPositionFloats; ++axis) {
                all.positions.push_back(
                    axis < mesh.dimension ? static_cast<float>(mesh.coordinate(v, axis)) : 0.0f);
            }
        }
        for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
            all.indices.push_back(static_cast<std::uint32_t>(base + mesh.triangles[k]));
        }
    }
    return all;
}

Result<std::unique_ptr<FrameMemory>> FrameMemory::create(const Sampler& sampler,
                                                         const Domain& domain,
                                                         const FrameMesh& mesh, const RunPlan& plan,
                                                         const FrameSamplerOptions& options) {
    auto made = std::make_unique<FrameMemory>();
    made->plan_ = plan;
    GEODISK_TRY(made->allocate(sampler, domain, mesh, options));
    auto job = sampler.make_job(domain, plan, made->layout_.in(made->buffer_.handle()));
    GEODISK_TRY(job);
    made->job_.emplace(std::move(*job));
    PlacementSource source;
    source.vertices = made->range(made->vertices_, bytes_of(mesh.positions).size());
    source.indices = made->range(made->indices_, bytes_of(mesh.indices).size());
    const PlacementTarget target{
        made->range(made->placed_, VkDeviceSize{plan.sample_capacity} * sizeof(gpu::PlacedRec)),
        made->range(made->arguments_, sizeof(VkDrawIndirectCommand)), options.vertices_each};
    auto placement = Placement::create(sampler, domain, *made->job_, source, target);
    GEODISK_TRY(placement);
    made->placement_.emplace(std::move(*placement));
    GEODISK_TRY(made->stage(sampler, domain, mesh));
    return made;
}

Result<Done> FrameMemory::allocate(const Sampler& sampler, const Domain& domain,
                                   const FrameMesh& mesh, const FrameSamplerOptions& options) {
    const auto needs = sampler.workspace_needs(domain, plan_);
    GEODISK_TRY(needs);
    layout_ = sampler.lay_out(*needs);
    RangeCutter cutter(layout_.alignment);
    cutter.cut(layout_.bytes);
    vertices_ = cutter.cut(bytes_of(mesh.positions).size());
    indices_ = cutter.cut(bytes_of(mesh.indices).size());
    placed_ = cutter.cut(VkDeviceSize{plan_.sample_capacity} * sizeof(gpu::PlacedRec));
    arguments_ = cutter.cut(sizeof(VkDrawIndirectCommand));

    auto buffer =
        make_frame_buffer(sampler, cutter.end(),
                          kWorkspaceUsage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::device);
    GEODISK_TRY(buffer);
    buffer_ = std::move(*buffer);
    auto uploads = FrameUploads::create(
        sampler, domain, bytes_of(mesh.positions).size() + bytes_of(mesh.indices).size());
    GEODISK_TRY(uploads);
    uploads_ = std::move(*uploads);
    auto controls =
        make_frame_buffer(sampler, VkDeviceSize{options.frames} * sizeof(gpu::ControlRec),
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::host);
    GEODISK_TRY(controls);
    controls_ = std::move(*controls);
    return Done{};
}

Result<Done> FrameMemory::stage(const Sampler& sampler, const Domain& domain,
                                const FrameMesh& mesh) {
    GEODISK_TRY(uploads_.stage_domain(sampler, domain, plan_, layout_));
    uploads_.stage(vertices_, bytes_of(mesh.positions));
    uploads_.stage(indices_, bytes_of(mesh.indices));
    std::memset(controls_.bytes().data(), 0, controls_.bytes().size());
    return Done{};
}

FrameSamples FrameMemory::samples() const {
    FrameSamples samples;
    samples.buffer = buffer_.handle();
    samples.placed_offset = placed_;
    samples.capacity = plan_.sample_capacity;
    samples.arguments_offset = arguments_;
    return samples;
}

void FrameMemory::record_upload(const DeviceTable& vk, VkCommandBuffer commands) {
    uploads_.record(vk, commands, buffer_.handle());
    // Nothing to draw until samples are placed.
    vk.vkCmdFillBuffer(commands, buffer_.handle(), arguments_, sizeof(VkDrawIndirectCommand), 0);
}

void FrameMemory::record_control(const DeviceTable& vk, VkCommandBuffer commands,
                                 std::uint32_t turn) const {
    const VkBufferCopy region{layout_.offsets[static_cast<std::size_t>(BufferRole::control)],
                              VkDeviceSize{turn} * sizeof(gpu::ControlRec),
                              sizeof(gpu::ControlRec)};
    vk.vkCmdCopyBuffer(commands, buffer_.handle(), controls_.handle(), 1, &region);
}

gpu::ControlRec FrameMemory::control(std::uint32_t turn) const {
    gpu::ControlRec record;
    std::memcpy(&record, controls_.bytes().data() + turn * sizeof record, sizeof record);
    return record;
}

} // namespace geodisk
