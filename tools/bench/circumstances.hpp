// Where, when and with what a benchmark ran.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <geodisk/device.hpp>

#include "bench/options.hpp"

namespace geodisk::bench {

/// Everything as text or numbers that mean something without this machine.
struct Circumstances {
    std::string version;   ///< "geodisk 0.1.0".
    std::string commit;    ///< Hexadecimal, or "unknown" when not built from a checkout.
    bool is_dirty = false; ///< The checkout had changes that the commit lacks.
    std::string build_type, compiler;
    std::string device, driver, device_type;
    std::string cpu;    ///< Model name, or "unknown".
    unsigned cores = 0; ///< Cores that may run this process; 0 if unknown.
    std::string date;   ///< UTC, ISO 8601.
    int repeats = 0, warm_ups = 0;
    std::uint64_t seed = 0;
    /// As asked for; 0 for the default.
    std::uint32_t slots = 0, lanes = 0, steps = 0, passes = 0;
    Tuning tuning; ///< As used.
};

Circumstances find_circumstances(const Sampler& sampler, const Options& options);

} // namespace geodisk::bench
