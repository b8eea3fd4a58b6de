#include <geodisk/placement.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/sampler_impl.hpp"
#include "engine/kernels/kernel_table.hpp"
#include "push.h"
#include "records.h"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"
#include "vk/descriptors.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kPlace = static_cast<std::size_t>(Kernel::place);
constexpr std::uint32_t kPositionBytes = 3 * sizeof(float);
constexpr VkDeviceSize kArgumentBytes = sizeof(VkDrawIndirectCommand);
// Buffers of the job that the kernel reads.
constexpr std::uint32_t kRead[] = {gpu::kBindFans, gpu::kBindControl, gpu::kBindConstants,
                                   gpu::kBindSamples};

struct NamedRange {
    std::uint32_t binding;
    const char* name;
    BufferRange range;
    VkDeviceSize needed;
};
using CallersRanges = std::array<NamedRange, 4>;

/// Returns the bytes up to the end of the last of this many vertices.
VkDeviceSize vertex_bytes(const PlacementSource& source, std::uint64_t vertices) {
    const std::uint32_t normal = source.normal == PlacementSource::kNoNormals ? 0 : source.normal;
    const VkDeviceSize last = std::max(source.position, normal) + kPositionBytes;
    return (std::max<std::uint64_t>(vertices, 1) - 1) * source.stride + last;
}

Result<Done> check_layout(const PlacementSource& source) {
    const bool has_normals = source.normal != PlacementSource::kNoNormals;
    if (source.stride < kPositionBytes || source.stride % 4 != 0 || source.position % 4 != 0 ||
        (has_normals && source.normal % 4 != 0)) {
        return invalid("a stride is at least 12 bytes, and it and the offsets of position and "
                       "normal are multiples of 4");
    }
    if (source.index_bytes != 2 && source.index_bytes != 4) {
        return invalid("an index has 2 bytes or 4, not " + std::to_string(source.index_bytes));
    }
    return Done{};
}

Result<Done> check_ranges(const CallersRanges& ranges, const Workspace& workspace,
                          const Sampler::Impl& sampler) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const NamedRange& own = ranges[i];
        GEODISK_TRY(check_range(own.range, own.name, own.needed, sampler));
        const bool is_written =
            own.binding == gpu::kBindPlaced || own.binding == gpu::kBindArguments;
        if (!is_written) {
            continue;
        }
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            if (k != i && overlap(own.range, ranges[k].range)) {
                return overlap_error(own.name, ranges[k].name);
            }
        }
        for (std::size_t k = 0; k < workspace.size(); ++k) {
            if (workspace[k].buffer != VK_NULL_HANDLE && overlap(own.range, workspace[k])) {
                return overlap_error(own.name, to_string(static_cast<BufferRole>(k)));
            }
        }
    }
    return Done{};
}

} // namespace

struct Placement::Impl {
    const Sampler::Impl* sampler = nullptr;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    gpu::PlacePush push{};
    Workspace workspace;      ///< Workspace that the descriptor set refers to.
    std::uint32_t number = 0; ///< Number of the job.

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (!sampler->abandoned) {
            sampler->vk.vkDestroyDescriptorPool(sampler->device.device, pool,
                                                sampler->device.host_allocator);
        }
    }

    Result<Done> allocate_set();
    void bind(const Job::Impl& job, const CallersRanges& ranges) const;
};

Result<Done> Placement::Impl::allocate_set() {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const KernelBinding& binding : sampler->pipelines.interface_of(Kernel::place).bindings) {
        sizes.push_back({binding.type, 1});
    }
    const VkDescriptorSetLayout layout = sampler->pipelines.set_layout(kPlace);
    auto created = create_descriptor_pool(sampler->device, sampler->vk, sizes, 1, pool);
    return created ? allocate_descriptor_sets(sampler->device, sampler->vk, pool, {&layout, 1},
                                              {&set, 1})
                   : created;
}

void Placement::Impl::bind(const Job::Impl& job, const CallersRanges& ranges) const {
    for (const KernelBinding& binding : sampler->pipelines.interface_of(Kernel::place).bindings) {
        const auto* const callers =
            std::find_if(ranges.begin(), ranges.end(),
                         [&](const NamedRange& own) { return own.binding == binding.number; });
        const BufferRange& range =
            callers != ranges.end() ? callers->range : job.workspace[binding.number];
        write_buffer(sampler->device, sampler->vk, set, binding.number, binding.type,
                     {range.buffer, range.offset, range.size});
    }
}

Result<Placement> Placement::create(const Sampler& sampler, const Domain& domain, const Job& job,
                                    const PlacementSource& source,
                                    const PlacementTarget& target) noexcept {
    return guarded([&]() -> Result<Placement> {
        const Domain::Impl& of = Domain::Impl::of(domain);
        const Job::Impl& own = Job::Impl::of(job);
        if (of.kernels.domain != DomainKind::surface || own.variant.domain != DomainKind::surface ||
            of.units != own.constants.faces) {
            return invalid("only samples of a surface by geodesic distance can be placed, by the "
                           "job's own domain");
        }
        GEODISK_TRY(check_layout(source));
        const bool is_one = !of.kernels.several;
        const std::uint64_t faces = own.constants.faces;
        const CallersRanges ranges{
            {{gpu::kBindVertices, "vertices", source.vertices,
              vertex_bytes(source, is_one ? own.constants.vertices : 0)},
             // Rounded up to whole words.
             {gpu::kBindIndices, "indices", source.indices,
              (faces * 3 * source.index_bytes + 3) / 4 * 4},
             {gpu::kBindPlaced, "placed", target.placed,
              VkDeviceSize{own.plan.sample_capacity} * sizeof(gpu::PlacedRec)},
             {gpu::kBindArguments, "arguments", target.arguments, kArgumentBytes}}};
        const Sampler::Impl& with = Sampler::Impl::of(sampler);
        GEODISK_TRY(check_ranges(ranges, own.workspace, with));
        KernelVariant variant;
        variant.domain = DomainKind::placement;
        variant.adaptive = of.kernels.adaptive;
        variant.several = of.kernels.several;
        const auto pipelines = with.pipelines.of(variant);
        GEODISK_TRY(pipelines);
        auto made = std::make_unique<Impl>();
        made->sampler = &with;
        made->pipeline = (**pipelines)[kPlace];
        made->workspace = own.workspace;
        made->number = own.number;
        const bool has_normals = source.normal != PlacementSource::kNoNormals;
        const VkDeviceSize first = vertex_bytes(source, 1);
        made->push.most = own.plan.sample_capacity;
        made->push.last_vertex = static_cast<std::uint32_t>(std::min<VkDeviceSize>(
            (source.vertices.size - first) / source.stride, gpu::kVertexMask));
        made->push.stride = source.stride / 4;
        made->push.position = source.position / 4;
        made->push.normal = has_normals ? source.normal / 4 : 0;
        made->push.has_normals = has_normals ? 1 : 0;
        made->push.short_indices = source.index_bytes == 2 ? 1 : 0;
        made->push.vertices_each = target.vertices_each;
        made->push.radius = static_cast<float>(of.largest_radius);
        GEODISK_TRY(made->allocate_set());
        made->bind(own, ranges);
        return Placement(std::move(made));
    });
}

Result<Done> Placement::record(VkCommandBuffer commands, const Job& job) const noexcept {
    return guarded([&]() -> Result<Done> {
        const Sampler::Impl& with = *impl_->sampler;
        const Job::Impl& own = Job::Impl::of(job);
        if (own.number != impl_->number) {
            return invalid("the job is another, or was renewed: make a new placement");
        }
        for (const std::uint32_t binding : kRead) {
            if (own.workspace[binding] != impl_->workspace[binding]) {
                return invalid("the job's buffer " +
                               std::string(to_string(static_cast<BufferRole>(binding))) +
                               " is another by now: make a new placement");
            }
        }
        const DeviceTable& vk = with.vk;
        const VkPipelineLayout layout = with.pipelines.layout(kPlace);
        const std::uint32_t local_size = with.choices.tuning.local_size;
        const std::uint32_t groups = (impl_->push.most + local_size - 1) / local_size;
        barrier_compute_to_compute(vk, commands);
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, impl_->pipeline);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1,
                                   &impl_->set, 0, nullptr);
        for (std::uint32_t group = 0; group < groups; group += kMaxGroups) {
            gpu::PlacePush push = impl_->push;
            push.first_group = group;
            push.avoided = own.avoided;
            vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push,
                                  &push);
            vk.vkCmdDispatch(commands, std::min(groups - group, kMaxGroups), 1, 1);
        }
        return Done{};
    });
}

Placement::Placement(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Placement::Placement(Placement&&) noexcept = default;
Placement& Placement::operator=(Placement&&) noexcept = default;
Placement::~Placement() = default;

} // namespace geodisk
