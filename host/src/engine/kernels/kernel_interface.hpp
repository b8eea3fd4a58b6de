// Requirements of a compiled kernel on the host, read from its SPIR-V.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk {

/// A descriptor of set 0.
struct KernelBinding {
    std::uint32_t number; ///< See shaders/shared/bindings.h.
    VkDescriptorType type;
};

struct KernelInterface {
    std::vector<KernelBinding> bindings;  ///< In ascending order of their numbers.
    std::vector<std::uint32_t> constants; ///< Ids of its specialization constants, likewise.

    bool has_constant(std::uint32_t id) const;
};

/// Reads valid SPIR-V of a compute shader.
KernelInterface read_interface(std::span<const std::uint32_t> spirv);

} // namespace geodisk
