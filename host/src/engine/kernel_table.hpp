// The compiled kernels: SPIR-V words and the buffers each binds.
#pragma once

#include <cstdint>
#include <span>

#include "bindings.h"

namespace geodisk {

enum class Kernel : std::uint32_t {
    candidates, scan_blocks, scan_sums, scan_add, bin_fill, find_idle, select, activate, detect,
    block, resolve, rewind, compact_mark, compact_gather, compact_fill, self_test,
};
inline constexpr std::size_t kKernels = 16;

struct KernelInfo {
    const char* name;
    std::span<const std::uint32_t> spirv;
    std::span<const std::uint32_t> bindings; ///< Binding numbers, ascending; at most eight.
    bool per_slot; ///< Knows the work-group size of slots and lanes, else that of candidates.
};

const KernelInfo& kernel_info(Kernel kernel) noexcept;

} // namespace geodisk
