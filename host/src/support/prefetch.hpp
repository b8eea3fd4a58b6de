// Asking for memory before it is needed, where its addresses follow no pattern.
#pragma once

namespace geodisk {

/// Starts to load what `address` points to into the cache, on compilers that can say so. Any
/// address will do. To be called from code that does something else too: GCC takes a function that
/// only prefetches to have no effect, and drops calls of it.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(address);
#endif
}

} // namespace geodisk
