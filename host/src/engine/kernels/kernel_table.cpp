#include "engine/kernels/kernel_table.hpp"

#include <array>

#include <geodisk/box.hpp>

namespace geodisk {
namespace {

#include "kernel_binaries.inc"

constexpr std::array<KernelInfo, kKernels> kTable{{
#define GEODISK_KERNEL(name, domain, spirv, texels_spirv)                                          \
    {#name, DomainKind::domain, spirv, texels_spirv},
#include "kernel_list.inc"
#undef GEODISK_KERNEL
}};

/// Interfaces of every kernel, reading from storage buffers and from texel buffers.
using Interfaces = std::array<std::array<KernelInterface, 2>, kKernels>;

Interfaces read_interfaces() {
    Interfaces interfaces;
    for (std::size_t k = 0; k < kKernels; ++k) {
        for (const bool texels : {false, true}) {
            interfaces[k][texels] = read_interface(kTable[k].words(texels));
        }
    }
    return interfaces;
}

} // namespace

const KernelInterface& interface_of(Kernel kernel, bool texels) {
    static const Interfaces kInterfaces = read_interfaces();
    return kInterfaces[static_cast<std::size_t>(kernel)][texels];
}

KernelVariant KernelVariant::of(Kernel kernel) const {
    const KernelInterface& declared = interface_of(kernel, false);
    KernelVariant variant{domain};
    if (declared.has_constant(gpu::kSpecDimension)) {
        variant.dimension = dimension;
    }
#define GEODISK_SWITCH(name, constant)                                                             \
    variant.name = (name) && declared.has_constant(gpu::constant);
    GEODISK_KERNEL_SWITCHES(GEODISK_SWITCH)
#undef GEODISK_SWITCH
    return variant;
}

std::vector<KernelVariant> all_kernel_variants() {
    std::vector<KernelVariant> variants;
    for (const bool adaptive : {false, true}) {
        for (const bool many_rows : {false, true}) {
            KernelVariant surface;
            surface.adaptive = adaptive;
            surface.many_rows = many_rows;
            variants.push_back(surface);
            for (bool KernelVariant::*const also :
                 {&KernelVariant::event_heap, &KernelVariant::trims, &KernelVariant::lanes_apart,
                  &KernelVariant::several, &KernelVariant::keyed, &KernelVariant::avoids}) {
                variants.emplace_back(surface).*also = true;
            }
            if (!adaptive) {
                variants.emplace_back(surface).classes = true;
                variants.emplace_back(surface).bounded = true;
            }
        }
        for (const bool avoids : {false, true}) {
            KernelVariant variant;
            variant.adaptive = adaptive;
            variant.avoids = avoids;
            variants.emplace_back(variant).groups = true;
            variants.emplace_back(variant).ending = Ending::light;
            if (!adaptive) {
                variant.ending = Ending::reach;
                variants.push_back(variant);
                variant.points = true;
                variants.push_back(variant);
                variants.emplace_back(variant).bounded = true;
            }
        }
        if (!adaptive) {
            KernelVariant& classed = variants.emplace_back();
            classed.groups = classed.classes = true;
        }
        for (const bool of_several : {false, true}) {
            KernelVariant& placement = variants.emplace_back();
            placement.domain = DomainKind::placement;
            placement.adaptive = adaptive;
            placement.several = of_several;
        }
    }
    variants.emplace_back().domain = DomainKind::lists;
    for (std::uint32_t dimension = 1; dimension <= kMaxBoxDimensions; ++dimension) {
        KernelVariant& variant = variants.emplace_back();
        variant.domain = DomainKind::box;
        variant.dimension = dimension;
    }
    for (const bool curved : {false, true}) {
        KernelVariant& variant = variants.emplace_back();
        variant.domain = DomainKind::space;
        variant.dimension = 3;
        variant.curved = curved;
    }
    return variants;
}

const KernelInfo& kernel_info(Kernel kernel) noexcept {
    return kTable[static_cast<std::size_t>(kernel)];
}

DomainKernels kernels_of(DomainKind domain) noexcept {
    if (domain == DomainKind::box) {
        return {Kernel::box_count, Kernel::box_bin, Kernel::box_draw, Kernel::box_select,
                Kernel::grid_detect};
    }
    if (domain == DomainKind::space) {
        return {Kernel::space_count, Kernel::space_bin, Kernel::space_draw, Kernel::space_select,
                Kernel::grid_detect};
    }
    return {Kernel::count, Kernel::bin, Kernel::draw, Kernel::select, Kernel::detect};
}

Kernel lanes_kernel(const KernelVariant& variant) noexcept {
    switch (variant.ending) {
    case Ending::light:
        return Kernel::light;
    case Ending::reach:
        return Kernel::reach;
    default:
        return kernels_of(variant.domain).detect;
    }
}

} // namespace geodisk
