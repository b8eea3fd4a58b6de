// The memory that this process has had at most.
#pragma once

#include <cstdint>

namespace geodisk {

/// Returns the peak of its memory so far, in bytes; 0 where the system does not tell.
std::uint64_t peak_memory();

} // namespace geodisk
