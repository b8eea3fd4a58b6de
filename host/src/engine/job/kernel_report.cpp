// Sampler::report_kernels: queries VK_KHR_pipeline_executable_properties for every pipeline.
#include <geodisk/kernel_report.hpp>

#include <utility>

#include "engine/job/sampler_impl.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"
#include "vk/enumerate.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

/// Functions of the extension, loaded separately.
struct ReportTable {
    PFN_vkGetPipelineExecutablePropertiesKHR properties = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;
};

Result<ReportTable> load_report_table(const DeviceRefs& refs) {
    const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        refs.get_instance_proc_addr(refs.instance, "vkGetDeviceProcAddr"));
    ReportTable table;
    table.properties = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
        get(refs.device, "vkGetPipelineExecutablePropertiesKHR"));
    table.statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        get(refs.device, "vkGetPipelineExecutableStatisticsKHR"));
    if (table.properties == nullptr || table.statistics == nullptr) {
        return Error{Status::device_lacks,
                     "the Vulkan device does not provide the functions of "
                     "VK_KHR_pipeline_executable_properties; was it enabled?"};
    }
    return table;
}

/// Returns the specialization of a kernel as text.
std::string text_of(const KernelVariant& variant) {
    std::string surfaces = std::string(variant.several ? "surfaces, " : "surface, ") +
                           (variant.adaptive ? "varying radii" : "one radius");
    switch (variant.domain) {
    case DomainKind::surface:
        return surfaces + (variant.many_rows ? ", rows of cells" : "") +
               (variant.event_heap ? ", heap" : ", ring") + (variant.trims ? ", trimming" : "") +
               (variant.lanes_apart ? ", lanes apart" : "") + (variant.keyed ? ", keys" : "") +
               (variant.avoids ? ", points to avoid" : "") + (variant.classes ? ", classes" : "") +
               (variant.bounded ? ", bounds" : "");
    case DomainKind::placement:
        return surfaces;
    case DomainKind::lists:
        return "lists of neighbours";
    case DomainKind::box:
        return "box, dimension " + std::to_string(variant.dimension);
    case DomainKind::space:
        return std::string("space, ") + (variant.curved ? "closed form" : "straight lines");
    default:
        return "";
    }
}

KernelStatistic statistic_of(const VkPipelineExecutableStatisticKHR& from) {
    KernelStatistic to{from.name, from.description, false};
    switch (from.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
        to.value = from.value.i64;
        break;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
        to.value = from.value.u64;
        break;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR:
        to.value = from.value.f64;
        break;
    default:
        to.value = from.value.b32 != VK_FALSE;
    }
    return to;
}

/// Adds a report of each executable of the pipeline.
Result<Done> add_reports(const ReportTable& vk, VkDevice device, VkPipeline pipeline,
                         const KernelReport& of_kernel, std::vector<KernelReport>& reports) {
    VkPipelineInfoKHR pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
    pipeline_info.pipeline = pipeline;
    VkPipelineExecutablePropertiesKHR blank_executable{};
    blank_executable.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    std::vector<VkPipelineExecutablePropertiesKHR> executables;
    VkResult result = enumerate(
        executables,
        [&](auto* count, auto* elements) {
            return vk.properties(device, &pipeline_info, count, elements);
        },
        blank_executable);
    if (result != VK_SUCCESS) {
        return vk_error("vkGetPipelineExecutablePropertiesKHR", result);
    }
    VkPipelineExecutableStatisticKHR blank_statistic{};
    blank_statistic.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    for (std::size_t i = 0; i < executables.size(); ++i) {
        VkPipelineExecutableInfoKHR executable_info{};
        executable_info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
        executable_info.pipeline = pipeline;
        executable_info.executableIndex = static_cast<std::uint32_t>(i);
        std::vector<VkPipelineExecutableStatisticKHR> statistics;
        result = enumerate(
            statistics,
            [&](auto* count, auto* elements) {
                return vk.statistics(device, &executable_info, count, elements);
            },
            blank_statistic);
        if (result != VK_SUCCESS) {
            return vk_error("vkGetPipelineExecutableStatisticsKHR", result);
        }
        KernelReport report = of_kernel;
        report.executable = executables[i].name;
        report.subgroup_size = executables[i].subgroupSize;
        for (const VkPipelineExecutableStatisticKHR& statistic : statistics) {
            report.statistics.push_back(statistic_of(statistic));
        }
        reports.push_back(std::move(report));
    }
    return Done{};
}

} // namespace

Result<std::vector<KernelReport>> Sampler::report_kernels() const noexcept {
    return guarded([&]() -> Result<std::vector<KernelReport>> {
        if (!impl_->device.pipeline_statistics) {
            return Error{Status::invalid_argument,
                         "kernels are reported on where DeviceRefs::pipeline_statistics is set"};
        }
        const auto vk = load_report_table(impl_->device);
        GEODISK_TRY(vk);
        std::vector<KernelReport> reports;
        const auto add = [&](const KernelPipelines& pipelines,
                             const KernelVariant& variant) -> Result<Done> {
            KernelReport report;
            report.variant = text_of(variant);
            for (std::size_t k = 0; k < kKernels; ++k) {
                if (pipelines[k] == VK_NULL_HANDLE) {
                    continue;
                }
                report.kernel = kernel_info(static_cast<Kernel>(k)).name;
                if (auto added =
                        add_reports(*vk, impl_->device.device, pipelines[k], report, reports);
                    !added) {
                    return added;
                }
            }
            return Done{};
        };
        GEODISK_TRY(add(impl_->pipelines.common(), {DomainKind::any}));
        for (const KernelVariant& variant : all_kernel_variants()) {
            const auto pipelines = impl_->pipelines.of(variant);
            GEODISK_TRY(pipelines);
            GEODISK_TRY(add(**pipelines, variant));
        }
        return reports;
    });
}

} // namespace geodisk
