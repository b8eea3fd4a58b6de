// KernelReport: the driver's statistics of a compiled kernel, such as registers, spills and code
// size. Use it to tune kernels, or to find why one is slow on a device.
// Experimental.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace geodisk {

/// One statistic.
struct KernelStatistic {
    std::string name; ///< The driver's name for it.
    std::string description;
    std::variant<bool, std::int64_t, std::uint64_t, double> value;
};

/// Statistics of one executable. A driver may compile a kernel to several executables.
struct KernelReport {
    std::string kernel;              ///< Name of its file in shaders/kernels.
    std::string variant;             ///< Name of its specialization; empty if all domains share it.
    std::string executable;          ///< The driver's name for the executable.
    std::uint32_t subgroup_size = 0; ///< 0 if the driver does not report it.
    std::vector<KernelStatistic> statistics;
};

} // namespace geodisk
