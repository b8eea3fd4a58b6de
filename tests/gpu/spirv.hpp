// Declarations and computations of compiled kernels, read from their SPIR-V words.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk::test {

using Offsets = std::map<std::string, std::uint32_t>;

/// Member offsets of every struct that carries them, by the struct's name.
std::map<std::string, Offsets> struct_offsets(std::span<const std::uint32_t> spirv);

/// A descriptor as a kernel declares it.
struct DeclaredBinding {
    std::uint32_t set;
    std::uint32_t number;
    VkDescriptorType type;

    bool operator==(const DeclaredBinding&) const = default;
};

/// In the order of their numbers. A resource that no kernel may have comes as a descriptor of
/// VK_DESCRIPTOR_TYPE_MAX_ENUM.
std::vector<DeclaredBinding> declared_bindings(std::span<const std::uint32_t> spirv);

/// A float operation whose result Vulkan does not fix to the bit.
struct LooseOperation {
    std::uint32_t result;
    std::string function; ///< Function that it stands in.
    std::string why;
};

/// Division and square root are not among them: shaders/lib/rounding.glsl corrects those.
std::vector<LooseOperation> loose_operations(std::span<const std::uint32_t> spirv);

} // namespace geodisk::test
