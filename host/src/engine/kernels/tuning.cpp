#include <algorithm>
#include <bit>
#include <string>

#include <geodisk/sampler.hpp>

#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kDefaultLocalSize = 64;

bool is_cpu(const DeviceReport& report) {
    return report.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

/// Returns true if a texel buffer of words can be as large as a storage buffer.
bool texels_reach(const DeviceLimits& limits) {
    return limits.max_texel_buffer_elements >= limits.max_storage_buffer_range / 4;
}

/// Returns the default tuning. On a CPU, a work group runs on one thread, so lanes are spread over
/// as many groups as there are SIMD groups, each lane with contiguous memory. A GPU needs whole
/// subgroups, several per group, whose lanes read side by side. A few batches fill a GPU, and most
/// active candidates are still accepted (paper Table 1).
Tuning default_tuning(const DeviceReport& report) {
    const std::uint32_t subgroup =
        std::bit_floor(std::clamp(report.limits.subgroup_size, 1u, kMaxPoolBlock));
    Tuning tuning;
    tuning.local_size = kDefaultLocalSize;
    tuning.slot_local_size =
        is_cpu(report) ? std::min(subgroup, kDefaultLocalSize) : kDefaultLocalSize;
    tuning.group_lanes = is_cpu(report) ? tuning.slot_local_size : kDefaultLocalSize;
    tuning.pool_block = is_cpu(report) ? 1 : subgroup;
    tuning.batches = is_cpu(report) ? 24 : 8;
    const bool fetches_fast = report.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE;
    tuning.reads = fetches_fast && texels_reach(report.limits) ? Reads::texels : Reads::storage;
    return tuning;
}

bool is_power_of_two_up_to(std::uint32_t value, std::uint32_t most) {
    return std::has_single_bit(value) && value <= most;
}

Result<Done> check(const Tuning& tuning, const DeviceReport& report) {
    const std::uint32_t most =
        std::min(report.limits.max_workgroup_invocations, report.limits.max_workgroup_size_x);
    if (!is_power_of_two_up_to(tuning.local_size, most) ||
        !is_power_of_two_up_to(tuning.slot_local_size, most) ||
        !is_power_of_two_up_to(tuning.group_lanes, most)) {
        return Error{Status::invalid_argument,
                     "the local size must be 0 or a power of two up to the device's limit of " +
                         std::to_string(most)};
    }
    if (!is_power_of_two_up_to(tuning.pool_block, kMaxPoolBlock)) {
        return Error{Status::invalid_argument, "the pool block must be 0 or a power of two up to " +
                                                   std::to_string(kMaxPoolBlock)};
    }
    if (tuning.reads == Reads::texels && !texels_reach(report.limits)) {
        return Error{Status::device_lacks,
                     report.name + " cannot read texels: maxTexelBufferElements is " +
                         std::to_string(report.limits.max_texel_buffer_elements) + ", at least " +
                         std::to_string(report.limits.max_storage_buffer_range / 4) +
                         " is needed, a quarter of maxStorageBufferRange"};
    }
    return Done{};
}

} // namespace

const char* to_string(Reads reads) noexcept {
    constexpr const char* kNames[] = {"auto", "storage", "texels"};
    return kNames[static_cast<std::size_t>(reads)];
}

Tuning overridden(Tuning tuning, const Tuning& wanted) noexcept {
    const auto replace = [](std::uint32_t& field, std::uint32_t value) {
        field = value != 0 ? value : field;
    };
    replace(tuning.local_size, wanted.local_size);
    replace(tuning.slot_local_size, wanted.slot_local_size);
    replace(tuning.group_lanes, wanted.group_lanes);
    replace(tuning.pool_block, wanted.pool_block);
    replace(tuning.batches, wanted.batches);
    tuning.reads = wanted.reads != Reads::automatic ? wanted.reads : tuning.reads;
    return tuning;
}

Result<Tuning> chosen_tuning(const Tuning& wanted, const DeviceReport& report) noexcept {
    return guarded([&]() -> Result<Tuning> {
        const Tuning tuning = overridden(default_tuning(report), wanted);
        GEODISK_TRY(check(tuning, report));
        return tuning;
    });
}

} // namespace geodisk
