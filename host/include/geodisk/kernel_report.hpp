// KernelReport: what the driver tells of a kernel that it has compiled, such as registers, spills
// and the size of its code. For those who tune kernels, or look why one is slow on a device.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace geodisk {

/// A figure, under the driver's own name for it.
struct KernelStatistic {
    std::string name;
    std::string description;
    std::variant<bool, std::int64_t, std::uint64_t, double> value;
};

/// A driver may make several executables of one kernel; each has a report.
struct KernelReport {
    std::string kernel;     ///< Its file in shaders/kernels.
    std::string variant;    ///< What it is specialized for; empty where all domains share it.
    std::string executable; ///< The driver's name for what it made of it.
    std::uint32_t subgroup_size = 0; ///< 0 when the driver does not tell.
    std::vector<KernelStatistic> statistics;
};

} // namespace geodisk
