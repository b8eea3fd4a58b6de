#include "support/device_abilities.hpp"

namespace geodisk::test {

std::vector<Reads> reads_of(const DeviceReport& report) {
    constexpr std::uint32_t kWordBytes = 4;
    const DeviceLimits& limits = report.limits;
    if (limits.max_texel_buffer_elements < limits.max_storage_buffer_range / kWordBytes) {
        return {Reads::storage};
    }
    return {Reads::storage, Reads::texels};
}

std::vector<Rounding> roundings_of(const DeviceReport& report) {
    if (!report.rounds_natively) {
        return {Rounding::emulated};
    }
    return {Rounding::emulated, Rounding::native};
}

bool compiles_groups(const DeviceReport& report) {
    return report.driver_id != VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
}

bool is_lavapipe(const DeviceReport& report) {
    return report.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE;
}

} // namespace geodisk::test
