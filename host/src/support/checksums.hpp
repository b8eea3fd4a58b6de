// Switch that decides whether readers compare checksums.
#pragma once

namespace geodisk {

/// False for fuzzers, which are to get past checksums.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr bool kComparesChecksums = false;
#else
inline constexpr bool kComparesChecksums = true;
#endif

} // namespace geodisk
