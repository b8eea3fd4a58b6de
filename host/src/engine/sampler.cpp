#include <geodisk/sampler.hpp>

#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "engine/device_mesh.hpp"
#include "engine/sampler_impl.hpp"
#include "support/guard.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

std::string join(const std::vector<std::string>& reasons) {
    std::string text;
    for (const std::string& reason : reasons) {
        text += (text.empty() ? "" : "; ") + reason;
    }
    return text;
}

} // namespace

Sampler::Sampler(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

const DeviceReport& Sampler::report() const noexcept {
    return impl_->report;
}
const Tuning& Sampler::tuning() const noexcept {
    return impl_->tuning;
}

Result<Sampler> Sampler::create(const DeviceRefs& device, const SamplerOptions& options) noexcept {
    return guarded([&] { return Impl::create_for(Domain::surface, 0, device, options); });
}

Result<Sampler> Sampler::Impl::create_for(Domain domain, std::uint32_t dimension,
                                          const DeviceRefs& device, const SamplerOptions& options,
                                          bool takes_curves) {
    auto report =
        query_device(device.get_instance_proc_addr, device.instance, device.physical_device);
    if (!report) {
        return report.error();
    }
    if (!report->usable()) {
        return Error{Status::device_lacks,
                     report->name + " cannot run geodisk: " + join(report->reasons_against)};
    }
    auto tuning = chosen_tuning(options.tuning, *report);
    if (!tuning) {
        return tuning.error();
    }
    auto table = load_device_table(device);
    if (!table) {
        return table.error();
    }
    auto impl = std::make_unique<Impl>();
    impl->device = device;
    impl->vk = *table;
    impl->native_rounding = options.rounding == Rounding::native ||
                            (options.rounding == Rounding::automatic && report->rounds_natively);
    impl->domain = domain;
    impl->dimension = dimension;
    impl->takes_curves = takes_curves;
    impl->count_calls = options.count_calls;
    impl->adaptive = options.adaptive && domain == Domain::surface;
    impl->tuning = *tuning;
    impl->counted_lanes = options.count_trips ? std::max(report->limits.subgroup_size, 1u) : 0;
    impl->report = std::move(*report);
    if (auto created = impl->create_pipelines(); !created) {
        return created.error();
    }
    return Sampler(std::move(impl));
}

Sampler::Impl::~Impl() {
    if (abandoned) {
        return;
    }
    for (std::size_t k = 0; k < kKernels; ++k) {
        vk.vkDestroyPipeline(device.device, pipelines[k], device.host_allocator);
        vk.vkDestroyPipelineLayout(device.device, layouts[k], device.host_allocator);
        vk.vkDestroyDescriptorSetLayout(device.device, set_layouts[k], device.host_allocator);
    }
}

Result<Done> Sampler::Impl::check_radii(const SampleParams& params) const {
    if (adaptive != (params.radii != nullptr)) {
        return Error{Status::invalid_argument,
                     adaptive
                         ? "the sampler is for radii that vary (SamplerOptions::adaptive), but "
                           "SampleParams::radii is null"
                         : "SampleParams::radii needs a sampler made with "
                           "SamplerOptions::adaptive"};
    }
    return Done{};
}

Result<Done> Sampler::Impl::create_pipelines() {
    for (std::uint32_t k = 0; k < kKernels; ++k) {
        if (!has(k)) {
            continue;
        }
        if (auto created = create_pipeline(static_cast<Kernel>(k)); !created) {
            return created.error();
        }
    }
    return Done{};
}

Result<Done> Sampler::Impl::create_pipeline(Kernel kernel) {
    const auto k = static_cast<std::size_t>(kernel);
    const KernelInfo& info = kernel_info(kernel);
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Binding& binding : info.bindings) {
        if (has_binding(binding.access, reads_texels())) {
            bindings.push_back({binding.number, descriptor_type(binding.access, reads_texels()), 1,
                                VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
        }
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkResult result =
        null_unless_success(vk.vkCreateDescriptorSetLayout(device.device, &set_info,
                                                           device.host_allocator, &set_layouts[k]),
                            set_layouts[k]);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateDescriptorSetLayout", result);
    }
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::Push)};
    VkPipelineLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layouts[k];
    layout_info.pushConstantRangeCount = 1;
    layout_info.pPushConstantRanges = &range;
    result = null_unless_success(
        vk.vkCreatePipelineLayout(device.device, &layout_info, device.host_allocator, &layouts[k]),
        layouts[k]);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreatePipelineLayout", result);
    }
    if (kernel == Kernel::count_calls && !count_calls) {
        return Done{}; // Never dispatched.
    }
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    const std::span<const std::uint32_t> spirv = reads_texels() ? info.texels_spirv : info.spirv;
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    result = vk.vkCreateShaderModule(device.device, &module_info, device.host_allocator, &module);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateShaderModule", result);
    }
    constexpr std::uint32_t kWord = sizeof(std::uint32_t);
    const std::array<std::uint32_t, 8> constants{info.per_slot ? tuning.slot_local_size
                                                               : tuning.local_size,
                                                 native_rounding ? VK_TRUE : VK_FALSE,
                                                 tuning.pool_block,
                                                 counted_lanes,
                                                 count_calls ? VK_TRUE : VK_FALSE,
                                                 dimension,
                                                 takes_curves ? VK_TRUE : VK_FALSE,
                                                 adaptive ? VK_TRUE : VK_FALSE};
    const std::array<VkSpecializationMapEntry, 8> entries{{
        {gpu::kSpecLocalSize, 0, kWord},
        {gpu::kSpecNativeRounding, kWord, kWord},
        {gpu::kSpecPoolBlock, 2 * kWord, kWord},
        {gpu::kSpecCountedLanes, 3 * kWord, kWord},
        {gpu::kSpecCountCalls, 4 * kWord, kWord},
        {gpu::kSpecDimension, 5 * kWord, kWord},
        {gpu::kSpecCurved, 6 * kWord, kWord},
        {gpu::kSpecAdaptive, 7 * kWord, kWord},
    }};
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()),
                                              entries.data(), sizeof constants, constants.data()};
    VkComputePipelineCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline_info.stage.module = module;
    pipeline_info.stage.pName = "main";
    pipeline_info.stage.pSpecializationInfo = &specialization;
    pipeline_info.layout = layouts[k];
    result = null_unless_success(vk.vkCreateComputePipelines(device.device, device.pipeline_cache,
                                                             1, &pipeline_info,
                                                             device.host_allocator, &pipelines[k]),
                                 pipelines[k]);
    vk.vkDestroyShaderModule(device.device, module, device.host_allocator);
    if (result != VK_SUCCESS) {
        Error error = vk_error("vkCreateComputePipelines", result);
        error.message += std::string(" (kernel ") + info.name + ")";
        return error;
    }
    return Done{};
}

std::size_t Sampler::mesh_bytes_size(const PreparedMesh& mesh, const SampleParams& params,
                                     BufferRole role) const noexcept {
    switch (role) {
    case BufferRole::faces:
        return face_bytes(mesh);
    case BufferRole::fans:
        return fan_bytes(mesh, impl_->adaptive);
    case BufferRole::keys:
        return key_bytes(params);
    default:
        return 0;
    }
}

Result<Done> Sampler::mesh_bytes(const PreparedMesh& mesh, const SampleParams& params,
                                 BufferRole role, std::span<std::byte> out) const noexcept {
    return guarded([&]() -> Result<Done> {
        if (out.size() != mesh_bytes_size(mesh, params, role) || out.empty()) {
            return Error{Status::invalid_argument, "not a mesh buffer, or not of its size"};
        }
        if (auto checked = impl_->check_radii(params); !checked) {
            return checked;
        }
        if (auto checked = pool_size(mesh, params); !checked) {
            return checked.error();
        }
        switch (role) {
        case BufferRole::faces:
            write_faces(mesh, params, out);
            return Done{};
        case BufferRole::fans:
            return write_fans(mesh, params, out);
        default:
            write_keys(params, out);
            return Done{};
        }
    });
}

} // namespace geodisk
