#include "engine/kernels/kernel_interface.hpp"

#include <algorithm>
#include <map>

namespace geodisk {
namespace {

// Numbers of the SPIR-V specification, sections 3.2 to 3.49.
constexpr std::size_t kFirstInstruction = 5;
constexpr std::uint32_t kOpTypeImage = 25, kOpTypeSampledImage = 27, kOpTypePointer = 32,
                        kOpVariable = 59, kOpDecorate = 71;
constexpr std::uint32_t kDecorationSpecId = 1, kDecorationBinding = 33;
constexpr std::uint32_t kClassUniform = 2;

/// The kinds of types behind a binding that are no blocks.
using ImageTypes = std::map<std::uint32_t, VkDescriptorType>;

VkDescriptorType type_of(std::uint32_t storage_class, std::uint32_t type,
                         const ImageTypes& images) {
    if (const auto image = images.find(type); image != images.end()) {
        return image->second;
    }
    return storage_class == kClassUniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                          : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

} // namespace

bool KernelInterface::has_constant(std::uint32_t id) const {
    return std::ranges::binary_search(constants, id);
}

KernelInterface read_interface(std::span<const std::uint32_t> spirv) {
    KernelInterface read;
    std::map<std::uint32_t, std::uint32_t> numbers; // Of bindings, by variable.
    std::map<std::uint32_t, std::uint32_t> pointees;
    ImageTypes images;
    for (std::size_t at = kFirstInstruction; at < spirv.size(); at += spirv[at] >> 16) {
        const std::uint32_t* const words = &spirv[at];
        switch (words[0] & 0xffffu) {
        case kOpDecorate:
            if (words[2] == kDecorationSpecId) {
                read.constants.push_back(words[3]);
            } else if (words[2] == kDecorationBinding) {
                numbers[words[1]] = words[3];
            }
            break;
        case kOpTypeImage: // Texels that are written have a format, and "sampled" is 2.
            images[words[1]] = words[7] == 2 ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                             : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
            break;
        case kOpTypeSampledImage:
            images[words[1]] = images[words[2]];
            break;
        case kOpTypePointer:
            pointees[words[1]] = words[3];
            break;
        case kOpVariable:
            if (const auto number = numbers.find(words[2]); number != numbers.end()) {
                read.bindings.push_back(
                    {number->second, type_of(words[3], pointees[words[1]], images)});
            }
            break;
        default:
            break;
        }
    }
    std::ranges::sort(read.bindings, {}, &KernelBinding::number);
    std::ranges::sort(read.constants);
    return read;
}

} // namespace geodisk
