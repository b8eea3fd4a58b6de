#include "parts/peak_memory.hpp"

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace geodisk {

std::uint64_t peak_memory() {
#if defined(__linux__)
    rusage usage{};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) * 1024
                                               : 0;
#else
    return 0;
#endif
}

} // namespace geodisk
