// Check at creation that the device's arithmetic is exact where decisions depend on it.
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/run/runner_impl.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"
#include "vk/descriptors.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kVectors = 8192;
using Vector = std::array<float, 4>;

/// Returns operands a, b, c, d with random mantissas, and exponents in the range of decisions.
/// Every fourth d is next to the square of a float, where roots are hardest to round.
std::vector<Vector> operands() {
    std::mt19937 random(20130901);
    const auto pick = [&random](std::uint32_t low, std::uint32_t count) {
        const std::uint32_t exponent = low + static_cast<std::uint32_t>(random()) % count;
        const auto mantissa = static_cast<std::uint32_t>(random()) & 0x007fffffu;
        return std::bit_cast<float>(mantissa | exponent << 23);
    };
    std::vector<Vector> vectors(kVectors);
    for (std::size_t i = 0; i < kVectors; ++i) {
        const float near_square = pick(120, 10);
        vectors[i] = {pick(107, 20), pick(126, 3), pick(117, 20),
                      i % 4 == 0 ? near_square * near_square : pick(80, 60)};
    }
    return vectors;
}

/// Returns the expected results of shaders/kernels/self_test.comp.
Vector expected(const Vector& operands) {
    const auto [a, b, c, d] = operands;
    const float product = a * b;
    const float sum = c + a;
    return {a >= b ? 1.0f : a / b, std::sqrt(d), product + c, sum - c};
}

const char* const kNames[] = {"division", "square root", "a * b + c", "(c + a) - c"};

Result<Done> compare(const std::vector<Vector>& operands, std::span<const std::byte> results,
                     const std::string& device) {
    for (std::size_t i = 0; i < operands.size(); ++i) {
        const Vector want = expected(operands[i]);
        Vector got;
        std::memcpy(got.data(), results.data() + i * sizeof(Vector), sizeof(Vector));
        for (std::size_t k = 0; k < want.size(); ++k) {
            if (std::bit_cast<std::uint32_t>(got[k]) != std::bit_cast<std::uint32_t>(want[k])) {
                return Error{Status::device_lacks, device + " does not round " + kNames[k] +
                                                       " as IEEE 754 asks (test vector " +
                                                       std::to_string(i) +
                                                       "); its samples could not be trusted"};
            }
        }
    }
    return Done{};
}

} // namespace

Result<Done> Runner::Impl::check_rounding() {
    const Sampler::Impl& sampler_impl = engine();
    const DeviceTable& vk = sampler_impl.vk;
    const VkDevice device = sampler_impl.device.device;
    const VkAllocationCallbacks* allocator = sampler_impl.device.host_allocator;
    const std::vector<Vector> vectors = operands();
    auto results = allocate(vectors.size() * sizeof(Vector), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                            MemoryKind::host);
    GEODISK_TRY(results);
    std::memcpy(results->bytes().data(), vectors.data(), vectors.size() * sizeof(Vector));
    constexpr auto kKernel = static_cast<std::size_t>(Kernel::self_test);
    const VkDescriptorSetLayout set_layout = sampler_impl.pipelines.set_layout(kKernel);
    const VkPipelineLayout layout = sampler_impl.pipelines.layout(kKernel);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    if (auto created = create_descriptor_pool(sampler_impl.device, vk, {&size, 1}, 1, pool);
        !created) {
        return created;
    }
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (auto allocated =
            allocate_descriptor_sets(sampler_impl.device, vk, pool, {&set_layout, 1}, {&set, 1});
        !allocated) {
        vk.vkDestroyDescriptorPool(device, pool, allocator);
        return allocated;
    }
    write_buffer(sampler_impl.device, vk, set, gpu::kBindSums, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                 {results->handle(), 0, results->size()});
    gpu::Push push{};
    push.scan_count = kVectors;
    const auto record = [&](VkCommandBuffer commands) {
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                             sampler_impl.pipelines.common()[kKernel]);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0,
                                   nullptr);
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
        const std::uint32_t local_size = sampler_impl.choices.tuning.local_size;
        vk.vkCmdDispatch(commands, (kVectors + local_size - 1) / local_size, 1, 1);
        record_barrier(vk, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                       VK_ACCESS_HOST_READ_BIT);
    };
    auto done = submitter->run(std::cref(record)); // std::cref does not allocate, so nothing leaks.
    if (submitter->abandoned()) {
        results->abandon();
    } else {
        vk.vkDestroyDescriptorPool(device, pool, allocator);
    }
    GEODISK_TRY(done);
    return compare(vectors, results->bytes(), sampler_impl.report.name);
}

} // namespace geodisk
