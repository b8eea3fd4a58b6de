// The compiled kernels: their SPIR-V, what they serve and what they can be specialized for.
#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "bindings.h"
#include "constants.h"
#include "engine/kernels/kernel_interface.hpp"

namespace geodisk {

/// The kernels that shaders/CMakeLists.txt lists.
enum class Kernel : std::uint32_t {
#define GEODISK_KERNEL(name, domain, spirv, texels_spirv) name,
#include "kernel_list.inc"
#undef GEODISK_KERNEL
};
#define GEODISK_KERNEL(name, domain, spirv, texels_spirv) Kernel::name,
inline constexpr Kernel kEachKernel[] = {
#include "kernel_list.inc"
};
#undef GEODISK_KERNEL
inline constexpr std::size_t kKernels = std::size(kEachKernel);

/// Kind of domain, and the distance it uses. Each has a bit, so that a kernel may serve several.
enum class DomainKind : std::uint8_t {
    surface = 1,  ///< By geodesic distance.
    box = 2,      ///< By straight-line distance, as all that follow.
    space = 4,    ///< A surface in space.
    in_space = 6, ///< For kernels: both with a grid.
    any = 7,
    placement = 8, ///< No domain: of the kernel that places samples for a caller.
    lists = 16,    ///< No domain: of the kernels that put neighbours in lists.
};
/// Surface, box and space.
inline constexpr std::size_t kDomainKinds = 3;
constexpr std::size_t index_of(DomainKind kind) {
    return static_cast<std::size_t>(std::countr_zero(static_cast<std::uint8_t>(kind)));
}

// The switches of a job's kernels: name, specialization constant.
// clang-format off
#define GEODISK_KERNEL_SWITCHES(X)                                                                 \
    X(curved, kSpecCurved)          /* Lengths of curves instead of straight lines in space. */    \
    X(adaptive, kSpecAdaptive)      /* Radii that vary over a surface. */                          \
    X(keyed, kSpecKeyed)            /* Faces are drawn by keys of the caller. */                   \
    X(several, kSpecSeveral)        /* Surfaces with seeds and stages of their own. */             \
    X(many_rows, kSpecManyRows)     /* Faces have several rows of cells. */                        \
    X(event_heap, kSpecEventHeap)   /* Vertex events of a disk wait in a heap, else in a ring. */  \
    X(trims, kSpecTrims)            /* Disks that make very many windows trim them. */             \
    X(avoids, kSpecAvoids)          /* Points to avoid have disks. */                              \
    X(classes, kSpecClasses)        /* Candidates have classes. */                                 \
    X(points, kSpecPoints)          /* Disks tell which candidates they reach, not vertices. */    \
    X(bounded, kSpecBounded)        /* Vertices have bounds where settled disks end. */            \
    X(lanes_apart, kSpecLanesApart) /* Pool blocks of one lane, whatever Tuning::pool_block is. */
// clang-format on

/// Purpose of disks. All but the first are for existing samples alone, by kernels of their own.
enum class Ending : std::uint8_t {
    conflicts, ///< Candidates in them are listed and decided.
    light,     ///< Records how they light faces (gpu::LitRec).
    reach,     ///< Records what they reach, and how far it is (gpu::HitRec).
};

/// Specialization of the kernels of a job, besides what all jobs of a device share.
struct KernelVariant {
    DomainKind domain = DomainKind::surface;
    std::uint32_t dimension = 0; ///< Dimension of a grid.
    bool groups = false;         ///< Work groups compute disks, by a kernel of their own.
    Ending ending = Ending::conflicts;
#define GEODISK_SWITCH(name, constant) bool name = false;
    GEODISK_KERNEL_SWITCHES(GEODISK_SWITCH)
#undef GEODISK_SWITCH

    friend auto operator<=>(const KernelVariant&, const KernelVariant&) = default;

    /// Returns true if disks only record what they find: no candidate is decided.
    bool records() const {
        return ending != Ending::conflicts;
    }
    /// Returns as much of it as a kernel has specialization constants for.
    KernelVariant of(Kernel kernel) const;
};

/// Returns every variant that a job, a placement or lists may need.
std::vector<KernelVariant> all_kernel_variants();

struct KernelInfo {
    const char* name;
    DomainKind domain;
    std::span<const std::uint32_t> spirv; ///< Reads from storage buffers.
    /// Reads from texel buffers, where that is faster on llvmpipe; else empty.
    std::span<const std::uint32_t> texels_spirv;

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

/// Returns the kernel by which lanes compute disks.
Kernel lanes_kernel(const KernelVariant& variant) noexcept;

const KernelInfo& kernel_info(Kernel kernel) noexcept;

/// Returns the interface of KernelInfo::words. The first call reads those of all kernels.
const KernelInterface& interface_of(Kernel kernel, bool texels);

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
