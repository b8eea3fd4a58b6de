#include "engine/kernels/loop_bounds.hpp"

#include <vulkan/vulkan_core.h>

#include "constants.h"

namespace geodisk {
namespace {

// llvmpipe ends all loops of a shader after so many iterations per SIMD group.
constexpr std::uint32_t kLlvmpipeIterations = 65535;
// Some iterations of a dispatch of grid_detect come before its trips.
constexpr std::uint32_t kBeforeGridTrips = 64 + gpu::kListPerDispatch;
// Elsewhere a dispatch is to stay well under the watchdogs.
constexpr std::uint32_t kSteps = 128;
constexpr std::uint32_t kGroupSteps = 32;
constexpr std::uint32_t kGridTrips = 1024;

} // namespace

std::uint32_t max_steps(const DeviceReport& report, const KernelVariant& variant) noexcept {
    const bool bounded = report.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE;
    if (variant.domain != DomainKind::surface) {
        return bounded ? (kLlvmpipeIterations - kBeforeGridTrips) / gpu::kIterationsPerGridTrip
                       : kGridTrips;
    }
    if (variant.groups) {
        return bounded ? kLlvmpipeIterations / gpu::kIterationsPerGroupStep : kGroupSteps;
    }
    const std::uint32_t in_heaps = variant.trims        ? gpu::kTrimIterationsPerStep
                                   : variant.event_heap ? gpu::kHeapIterationsPerStep
                                                        : 0;
    return bounded ? kLlvmpipeIterations / (gpu::kIterationsPerStep + in_heaps) : kSteps;
}

} // namespace geodisk
