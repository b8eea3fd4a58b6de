#include "spirv.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace geodisk::test {
namespace {

// From the SPIR-V specification, version 1.3, and its extended instructions for GLSL.
enum Operation : std::uint32_t {
    op_name = 5,
    op_member_name = 6,
    op_ext_inst = 12,
    op_type_image = 25,
    op_type_sampled_image = 27,
    op_type_pointer = 32,
    op_function = 54,
    op_variable = 59,
    op_decorate = 71,
    op_member_decorate = 72,
    op_f_add = 129,
    op_f_sub = 131,
    op_f_mul = 133,
    op_f_rem = 140,
    op_f_mod = 141,
    op_vector_times_scalar = 142,
    op_matrix_times_scalar = 143,
    op_vector_times_matrix = 144,
    op_matrix_times_vector = 145,
    op_matrix_times_matrix = 146,
    op_outer_product = 147,
    op_dot = 148,
};
constexpr std::uint32_t kDecorationBinding = 33;
constexpr std::uint32_t kDecorationDescriptorSet = 34;
constexpr std::uint32_t kDecorationOffset = 35;
constexpr std::uint32_t kDecorationNoContraction = 42;
constexpr std::uint32_t kStorageUniformConstant = 0;
constexpr std::uint32_t kStorageUniform = 2;
constexpr std::uint32_t kStorageBuffer = 12;
constexpr std::uint32_t kDimBuffer = 5;
constexpr std::uint32_t kImageSampled = 1;

/// One rounding per component, unless contracted with what follows.
bool rounds_once(std::uint32_t operation) {
    return operation == op_f_add || operation == op_f_sub || operation == op_f_mul ||
           operation == op_vector_times_scalar || operation == op_matrix_times_scalar;
}

/// The order and number of its roundings are the driver's own, decorated or not.
bool rounds_at_will(std::uint32_t operation) {
    return operation == op_f_rem || operation == op_f_mod || operation == op_vector_times_matrix ||
           operation == op_matrix_times_vector || operation == op_matrix_times_matrix ||
           operation == op_outer_product || operation == op_dot;
}

/// Returns true for these extended instructions for GLSL: RoundEven to Ceil, Sqrt, minima to
/// clamps, FindILsb to FindUMsb, NMin to NClamp.
bool is_exact_function(std::uint32_t number) {
    constexpr std::pair<std::uint32_t, std::uint32_t> kExact[] = {
        {2, 9}, {31, 31}, {37, 45}, {73, 75}, {79, 81}};
    return std::any_of(std::begin(kExact), std::end(kExact), [&](const auto& range) {
        return number >= range.first && number <= range.second;
    });
}

std::string text_at(std::span<const std::uint32_t> words) {
    return reinterpret_cast<const char*>(words.data());
}

/// Calls visit(operation, words) for each instruction; words[0] holds its length and operation.
template <class Visit>
void for_each_instruction(std::span<const std::uint32_t> spirv, Visit&& visit) {
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t at = kHeaderWords; at < spirv.size(); at += spirv[at] >> 16) {
        visit(spirv[at] & 0xffffu, spirv.subspan(at, spirv[at] >> 16));
    }
}

/// Facts about the ids before the functions start.
struct Declarations {
    std::map<std::uint32_t, std::string> names;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> decorations; ///< With operand.
    std::map<std::uint32_t, VkDescriptorType> types; ///< Types of what a descriptor can be.
    std::map<std::uint32_t, std::uint32_t> pointees;

    bool decorated(std::uint32_t id, std::uint32_t decoration) const {
        const auto found = decorations.find(id);
        return found != decorations.end() && found->second.contains(decoration);
    }
};

VkDescriptorType type_of_image(std::span<const std::uint32_t> words) {
    const std::uint32_t dim = words[3];
    const std::uint32_t sampled = words[7];
    return dim != kDimBuffer          ? VK_DESCRIPTOR_TYPE_MAX_ENUM
           : sampled == kImageSampled ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                      : VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

Declarations declarations_of(std::span<const std::uint32_t> spirv) {
    Declarations all;
    for_each_instruction(spirv, [&](std::uint32_t operation, const auto& words) {
        if (operation == op_name) {
            all.names[words[1]] = text_at(words.subspan(2));
        } else if (operation == op_decorate) {
            all.decorations[words[1]][words[2]] = words.size() > 3 ? words[3] : 0;
        } else if (operation == op_type_image) {
            all.types[words[1]] = type_of_image(words);
        } else if (operation == op_type_sampled_image) {
            all.types[words[1]] = all.types[words[2]];
        } else if (operation == op_type_pointer) {
            all.pointees[words[1]] = words[3];
        }
    });
    return all;
}

VkDescriptorType descriptor_type(const Declarations& all, std::uint32_t pointer,
                                 std::uint32_t storage_class) {
    if (storage_class == kStorageBuffer) {
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    if (storage_class == kStorageUniform) {
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    }
    const auto found = all.types.find(all.pointees.at(pointer));
    return storage_class == kStorageUniformConstant && found != all.types.end()
               ? found->second
               : VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

/// Nothing where the operation is fixed to the bit.
std::string why_loose(const Declarations& all, std::uint32_t operation,
                      std::span<const std::uint32_t> words) {
    if (rounds_once(operation) && !all.decorated(words[2], kDecorationNoContraction)) {
        return "operation " + std::to_string(operation) + " lacks NoContraction";
    }
    if (rounds_at_will(operation)) {
        return "operation " + std::to_string(operation) + " has roundings of its own";
    }
    if (operation == op_ext_inst && !is_exact_function(words[4])) {
        return "GLSL function " + std::to_string(words[4]) + " is not exact";
    }
    return {};
}

} // namespace

std::map<std::string, Offsets> struct_offsets(std::span<const std::uint32_t> spirv) {
    std::map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> members;
    std::map<std::string, Offsets> result;
    for_each_instruction(spirv, [&](std::uint32_t operation, const auto& words) {
        if (operation == op_name) {
            names[words[1]] = text_at(words.subspan(2));
        } else if (operation == op_member_name) {
            members[{words[1], words[2]}] = text_at(words.subspan(3));
        } else if (operation == op_member_decorate && words[3] == kDecorationOffset) {
            result[names[words[1]]][members[{words[1], words[2]}]] = words[4];
        }
    });
    return result;
}

std::vector<DeclaredBinding> declared_bindings(std::span<const std::uint32_t> spirv) {
    const Declarations all = declarations_of(spirv);
    std::vector<DeclaredBinding> result;
    for_each_instruction(spirv, [&](std::uint32_t operation, const auto& words) {
        if (operation == op_variable && all.decorated(words[2], kDecorationBinding)) {
            const auto& decorations = all.decorations.at(words[2]);
            result.push_back({decorations.at(kDecorationDescriptorSet),
                              decorations.at(kDecorationBinding),
                              descriptor_type(all, words[1], words[3])});
        }
    });
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    return result;
}

std::vector<LooseOperation> loose_operations(std::span<const std::uint32_t> spirv) {
    const Declarations all = declarations_of(spirv);
    std::vector<LooseOperation> result;
    std::uint32_t function = 0;
    for_each_instruction(spirv, [&](std::uint32_t operation, const auto& words) {
        if (operation == op_function) {
            function = words[2];
        }
        if (std::string why = why_loose(all, operation, words); !why.empty()) {
            result.push_back({words[2], all.names.at(function), std::move(why)});
        }
    });
    return result;
}

} // namespace geodisk::test
