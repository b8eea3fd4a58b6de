// Prefetches memory whose addresses follow no pattern.
#pragma once

namespace geodisk {

/// Prefetches the cache line of `address`, if the compiler supports it. Any address is allowed.
/// Call it from a function that also does something else: GCC drops calls of functions that only
/// prefetch.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(address);
#endif
}

} // namespace geodisk
