// The compiled kernels: SPIR-V words and the buffers each binds.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "bindings.h"

namespace geodisk {

enum class Kernel : std::uint32_t {
    count,
    sum_blocks,
    scan_sums,
    scan_blocks,
    bin,
    draw,
    begin_chunk,
    select,
    detect,
    resolve,
    count_calls,
    rewind,
    resume,
    count_orders,
    order_count,
    order_place,
    order_write,
    place,
    self_test,
    box_count,
    box_bin,
    box_draw,
    box_select,
    space_count,
    space_bin,
    space_draw,
    space_select,
    grid_detect,
};
inline constexpr std::size_t kKernels = 28;

/// What is sampled, and by what distance: a bit each, so that a kernel may serve several.
enum class DomainKind : std::uint8_t {
    surface = 1,  ///< By geodesic distance.
    box = 2,      ///< By straight-line distance, as all that follow.
    space = 4,    ///< A surface in space.
    in_space = 6, ///< Of kernels: both with a grid.
    any = 7,
    placement = 8, ///< No domain: of the kernel that places samples for a caller.
};
/// Surface, box and space.
inline constexpr std::size_t kDomainKinds = 3;
constexpr std::size_t index_of(DomainKind kind) {
    return static_cast<std::size_t>(std::countr_zero(static_cast<std::uint8_t>(kind)));
}

/// What the kernels of a job are specialized for, besides what all jobs of a device share.
struct KernelVariant {
    DomainKind domain = DomainKind::surface;
    std::uint32_t dimension = 0; ///< Of a grid.
    bool curved = false;         ///< Lengths of curves instead of straight lines in space.
    bool adaptive = false;       ///< Radii that vary over a surface.
    bool several = false;        ///< Surfaces with seeds and stages of their own.
    bool many_rows = false;      ///< Faces have several rows of cells.
    bool event_heap = false;     ///< Vertex events of a disk wait in a heap, else in a ring.
    bool trims = false;          ///< Disks that make very many windows trim them.
    bool lanes_apart = false;    ///< Pool blocks of one lane, whatever Tuning::pool_block is.

    friend auto operator<=>(const KernelVariant&, const KernelVariant&) = default;

    /// As much of it as bears on a kernel: how windows and candidates are gone through, on detect
    /// alone.
    KernelVariant of(Kernel kernel) const noexcept;
};

/// Those of all domains that there may be.
std::vector<KernelVariant> all_kernel_variants();

/// How a kernel reaches a buffer, see shaders/lib/buffers.glsl.
enum class Access : std::uint8_t {
    storage, ///< As a storage buffer.
    read,    ///< Only reads it: as a texel buffer in the variant that reads texels.
    /// Reads through a second binding, in the variant that reads texels alone:
    read_own,    ///< what the invocation wrote;
    read_before, ///< what nobody has written yet.
};

struct Binding {
    std::uint32_t number;
    Access access;
};

struct KernelInfo {
    const char* name;
    std::span<const std::uint32_t> spirv; ///< Reads from storage buffers.
    std::span<const Binding> bindings;    ///< Ascending; at most eight storage buffers.
    bool per_slot; ///< Knows the work-group size of slots and lanes, else that of candidates.
    DomainKind domain = DomainKind::any;
    /// Reads from texel buffers, where that is faster on llvmpipe; else empty.
    std::span<const std::uint32_t> texels_spirv = {};

    std::span<const std::uint32_t> words(bool texels) const {
        return texels && !texels_spirv.empty() ? texels_spirv : spirv;
    }
    bool serves(DomainKind other) const {
        return (static_cast<std::uint8_t>(domain) & static_cast<std::uint8_t>(other)) != 0;
    }
};

/// The kernels that each domain has of its own.
struct DomainKernels {
    Kernel count, bin, draw, select, detect;
};
DomainKernels kernels_of(DomainKind domain) noexcept;

const KernelInfo& kernel_info(Kernel kernel) noexcept;

/// Whether a variant has a binding.
constexpr bool has_binding(Access access, bool texels) noexcept {
    return texels || access == Access::storage || access == Access::read;
}

constexpr VkDescriptorType descriptor_type(Access access, bool texels) noexcept {
    return !texels || access == Access::storage ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
           : access == Access::read_own         ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

/// The texels of the buffer with this number: words, or rows of four.
constexpr VkFormat texel_format(std::uint32_t buffer) noexcept {
    switch (buffer) {
    case gpu::kBindFaces:
    case gpu::kBindFans:
    case gpu::kBindPool:
    case gpu::kBindAccepted:
        return VK_FORMAT_R32G32B32A32_UINT;
    default:
        return VK_FORMAT_R32_UINT;
    }
}

constexpr VkDeviceSize texel_bytes(VkFormat format) noexcept {
    return format == VK_FORMAT_R32G32B32A32_UINT ? 16 : 4;
}

} // namespace geodisk
