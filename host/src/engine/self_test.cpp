// The start-up check that the device keeps the arithmetic promises decisions rest on.
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "engine/runner_impl.hpp"
#include "support/philox.hpp"
#include "vk/barriers.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kVectors = 4096;
constexpr std::uint32_t kResults = 4;
constexpr std::uint64_t kSeed = 0x67656f6469736b;

float float_of(std::uint32_t mantissa, std::uint32_t exponent) {
    return std::bit_cast<float>((mantissa & 0x007fffffu) | exponent << 23);
}

/// What shaders/kernels/self_test.comp must compute for one index.
std::array<float, kResults> expected(std::uint32_t index) {
    const auto random = philox(kSeed, index);
    const float a = float_of(random[0], 107 + random[3] % 20);
    const float b = float_of(random[1], 127);
    const float c = float_of(random[2], 117 + (random[3] >> 8) % 20);
    const float product = a * b;
    const float sum = c + a;
    return {a >= b ? 1.0f : a / b, std::sqrt(product), product + c, sum - c};
}

const char* const kNames[kResults] = {"division", "square root", "a * b + c", "(c + a) - c"};

Result<Done> compare(std::span<const std::byte> bytes, const std::string& device) {
    for (std::uint32_t i = 0; i < kVectors; ++i) {
        const auto want = expected(i);
        for (std::uint32_t k = 0; k < kResults; ++k) {
            float got;
            std::memcpy(&got, bytes.data() + (std::size_t{i} * kResults + k) * 4, 4);
            if (std::bit_cast<std::uint32_t>(got) != std::bit_cast<std::uint32_t>(want[k])) {
                return Error{Status::device_lacks,
                             device + " does not round " + kNames[k] +
                                 " as IEEE 754 asks (test vector " + std::to_string(i) +
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
    auto results = allocate(VkDeviceSize{kVectors} * kResults * 4,
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::host);
    if (!results) {
        return results.error();
    }
    constexpr auto k = static_cast<std::size_t>(Kernel::self_test);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkResult status = vk.vkCreateDescriptorPool(device, &pool_info, allocator, &pool);
    if (status != VK_SUCCESS) {
        return vk_error("vkCreateDescriptorPool", status);
    }
    VkDescriptorSetAllocateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set_info.descriptorPool = pool;
    set_info.descriptorSetCount = 1;
    set_info.pSetLayouts = &sampler_impl.set_layouts[k];
    VkDescriptorSet set = VK_NULL_HANDLE;
    status = vk.vkAllocateDescriptorSets(device, &set_info, &set);
    if (status != VK_SUCCESS) {
        vk.vkDestroyDescriptorPool(device, pool, allocator);
        return vk_error("vkAllocateDescriptorSets", status);
    }
    const VkDescriptorBufferInfo buffer{results->handle(), 0, results->size()};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = gpu::kBindSums;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &buffer;
    vk.vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    gpu::Push push{};
    push.candidates = kVectors;
    push.seed_low = static_cast<std::uint32_t>(kSeed);
    push.seed_high = static_cast<std::uint32_t>(kSeed >> 32);
    const auto record = [&](VkCommandBuffer commands) {
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, sampler_impl.pipelines[k]);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                   sampler_impl.layouts[k], 0, 1, &set, 0, nullptr);
        vk.vkCmdPushConstants(commands, sampler_impl.layouts[k], VK_SHADER_STAGE_COMPUTE_BIT, 0,
                              sizeof push, &push);
        vk.vkCmdDispatch(commands, groups_for(kVectors, sampler_impl.local_size).x, 1, 1);
        record_barrier(vk, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                       VK_ACCESS_HOST_READ_BIT);
    };
    auto done = submitter->run(std::cref(record)); // Does not allocate, so that nothing leaks.
    if (submitter->abandoned()) {
        results->abandon();
    } else {
        vk.vkDestroyDescriptorPool(device, pool, allocator);
    }
    if (!done) {
        return done.error();
    }
    return compare(results->bytes(), sampler_impl.report.name);
}

} // namespace geodisk
