// Memory of the C++ runtime that a test counts.
#pragma once

#include <cstdint>

namespace geodisk::test {

/// Returns the bytes that this thread has allocated so far, freed ones among them.
std::uint64_t allocated_bytes();

} // namespace geodisk::test
