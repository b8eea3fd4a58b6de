#include "engine/kernels/pipelines.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "constants.h"
#include "push.h"
#include "support/blocks.hpp"
#include "support/try.hpp"
#include "vk/debug.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

/// Returns true for the kernels of surfaces of which a job has one, lanes_kernel().
constexpr bool computes_by_lanes(Kernel kernel) {
    return kernel == Kernel::detect || kernel == Kernel::light || kernel == Kernel::reach;
}

/// Returns true if a job of the variant has the kernel, or for DomainKind::any if all jobs have it.
bool has_kernel(const KernelVariant& variant, Kernel kernel) {
    const KernelInfo& info = kernel_info(kernel);
    const bool is_common = variant.domain == DomainKind::any;
    return (info.domain == DomainKind::any) == is_common && info.serves(variant.domain) &&
           (kernel != Kernel::group_detect || variant.groups) &&
           (kernel != Kernel::drop || variant.classes) &&
           (!computes_by_lanes(kernel) || kernel == lanes_kernel(variant));
}

} // namespace

Pipelines::~Pipelines() {
    if (abandoned_) {
        return;
    }
    for (const auto& [key, pipeline] : compiled_) {
        vk_.vkDestroyPipeline(device_.device, pipeline, device_.host_allocator);
    }
    for (std::size_t k = 0; k < kKernels; ++k) {
        vk_.vkDestroyPipelineLayout(device_.device, layouts_[k], device_.host_allocator);
        vk_.vkDestroyDescriptorSetLayout(device_.device, set_layouts_[k], device_.host_allocator);
    }
}

Result<Done> Pipelines::create(const std::optional<KernelVariant>& ahead) {
    for (std::size_t k = 0; k < kKernels; ++k) {
        GEODISK_TRY(create_layout(k));
    }
    using Set = std::pair<KernelVariant, KernelPipelines*>;
    const Set common{{DomainKind::any}, &common_};
    if (!ahead) {
        return compile_all({&common, 1});
    }
    return compile_all(std::array{common, Set{*ahead, &own_[*ahead]}});
}

Result<const KernelPipelines*> Pipelines::of(const KernelVariant& variant) {
    const std::lock_guard lock(mutex_);
    if (const auto found = own_.find(variant); found != own_.end()) {
        return &found->second;
    }
    KernelPipelines pipelines{};
    const std::pair<KernelVariant, KernelPipelines*> set{variant, &pipelines};
    if (auto compiled = compile_all({&set, 1}); !compiled) {
        drop_unused();
        return compiled.error();
    }
    return &own_.emplace(variant, pipelines).first->second;
}

void Pipelines::drop_unused() {
    std::erase_if(compiled_, [this](const auto& entry) {
        const auto has = [&entry](const KernelPipelines& pipelines) {
            return pipelines[static_cast<std::size_t>(entry.first.first)] == entry.second;
        };
        if (has(common_) ||
            std::ranges::any_of(own_, [&has](const auto& own) { return has(own.second); })) {
            return false;
        }
        vk_.vkDestroyPipeline(device_.device, entry.second, device_.host_allocator);
        return true;
    });
}

Result<Done>
Pipelines::compile_all(std::span<const std::pair<KernelVariant, KernelPipelines*>> sets) {
    struct Work {
        Kernel kernel;
        KernelVariant variant;
        VkPipeline* pipeline; ///< In compiled_.
        std::optional<Error> error;
    };
    std::vector<Work> all;
    for (const auto& [variant, pipelines] : sets) {
        for (const Kernel kernel : kEachKernel) {
            if (has_kernel(variant, kernel)) {
                const KernelVariant key = variant.of(kernel);
                VkPipeline& pipeline = compiled_[{kernel, key}];
                if (pipeline == VK_NULL_HANDLE) {
                    all.push_back({kernel, key, &pipeline, std::nullopt});
                }
            }
        }
    }
    // The largest takes as long as all others, so it comes first.
    std::ranges::stable_sort(all, std::ranges::greater(), [](const Work& work) {
        return kernel_info(work.kernel).spirv.size();
    });
    std::atomic<bool> has_failed = false;
    for_parts(threads_, all.size(), [&](std::size_t i) {
        if (has_failed) {
            return;
        }
        auto compiled = compile(all[i].kernel, all[i].variant);
        if (compiled) {
            *all[i].pipeline = *compiled;
        } else {
            all[i].error = std::move(compiled).error();
            has_failed = true;
        }
    });
    for (Work& work : all) {
        if (work.error) {
            return *std::move(work.error);
        }
    }
    for (const auto& [variant, pipelines] : sets) {
        for (const Kernel kernel : kEachKernel) {
            if (has_kernel(variant, kernel)) {
                (*pipelines)[static_cast<std::size_t>(kernel)] =
                    compiled_[{kernel, variant.of(kernel)}];
            }
        }
    }
    return Done{};
}

Result<Done> Pipelines::create_layout(std::size_t kernel) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const KernelBinding& binding : interface_of(static_cast<Kernel>(kernel)).bindings) {
        bindings.push_back({binding.number, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout& set_layout = set_layouts_[kernel];
    VkResult result =
        null_unless_success(vk_.vkCreateDescriptorSetLayout(device_.device, &set_info,
                                                            device_.host_allocator, &set_layout),
                            set_layout);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateDescriptorSetLayout", result);
    }
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::Push)};
    VkPipelineLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layout;
    layout_info.pushConstantRangeCount = 1;
    layout_info.pPushConstantRanges = &range;
    result =
        null_unless_success(vk_.vkCreatePipelineLayout(device_.device, &layout_info,
                                                       device_.host_allocator, &layouts_[kernel]),
                            layouts_[kernel]);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreatePipelineLayout", result);
    }
    return Done{};
}

/// All there are: a driver ignores those that a kernel does not have.
std::vector<Pipelines::Specialization>
Pipelines::specializations(const KernelVariant& variant) const {
    const Tuning& tuning = choices_.tuning;
    return {{gpu::kSpecLocalSize, tuning.local_size},
            {gpu::kSpecSlotLocalSize, tuning.slot_local_size},
            {gpu::kSpecGroupLanes, tuning.group_lanes},
            {gpu::kSpecNativeRounding, choices_.native_rounding ? VK_TRUE : VK_FALSE},
            {gpu::kSpecPoolBlock, tuning.pool_block},
            {gpu::kSpecCountedLanes, choices_.counted_lanes},
            {gpu::kSpecDimension, variant.dimension},
#define GEODISK_SWITCH(name, constant) {gpu::constant, variant.name ? VK_TRUE : VK_FALSE},
            GEODISK_KERNEL_SWITCHES(GEODISK_SWITCH)
#undef GEODISK_SWITCH
    };
}

Result<VkPipeline> Pipelines::compile(Kernel kernel, const KernelVariant& variant) const {
    const KernelInfo& info = kernel_info(kernel);
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    const std::span<const std::uint32_t> spirv = info.words(reads_texels());
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    VkResult result =
        vk_.vkCreateShaderModule(device_.device, &module_info, device_.host_allocator, &module);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateShaderModule", result);
    }
    const std::vector<Specialization> constants = specializations(variant);
    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) {
        entries.push_back({constants[i].constant,
                           static_cast<std::uint32_t>(i * sizeof(Specialization) +
                                                      offsetof(Specialization, value)),
                           sizeof constants[i].value});
    }
    const VkSpecializationInfo specialization{
        static_cast<std::uint32_t>(entries.size()), entries.data(),
        constants.size() * sizeof(Specialization), constants.data()};
    VkComputePipelineCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    if (device_.pipeline_statistics) {
        pipeline_info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    }
    pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline_info.stage.module = module;
    pipeline_info.stage.pName = "main";
    pipeline_info.stage.pSpecializationInfo = &specialization;
    pipeline_info.layout = layouts_[static_cast<std::size_t>(kernel)];
    VkPipeline pipeline = VK_NULL_HANDLE;
    result = null_unless_success(
        vk_.vkCreateComputePipelines(device_.device, device_.pipeline_cache, 1, &pipeline_info,
                                     device_.host_allocator, &pipeline),
        pipeline);
    vk_.vkDestroyShaderModule(device_.device, module, device_.host_allocator);
    if (result != VK_SUCCESS) {
        Error error = vk_error("vkCreateComputePipelines", result);
        error.message += std::string(" (kernel ") + info.name + ")";
        return error;
    }
    name_object(vk_, device_.device, VK_OBJECT_TYPE_PIPELINE, pipeline,
                (std::string("geodisk ") + info.name).c_str());
    return pipeline;
}

} // namespace geodisk
