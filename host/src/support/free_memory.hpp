// Frees memory that would be kept for later.
#pragma once

#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace geodisk {

/// Frees the memory of a vector, which assigning {} keeps.
template <class T>
void free_memory(std::vector<T>& vector) noexcept {
    std::vector<T>().swap(vector);
}

/// Gives what is freed back to the system, where the C library keeps it for the same thread.
inline void trim_memory() noexcept {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace geodisk
