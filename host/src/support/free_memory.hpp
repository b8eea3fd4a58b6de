// Frees the memory of a vector, which assigning {} keeps.
#pragma once

#include <vector>

namespace geodisk {

template <class T>
void free_memory(std::vector<T>& vector) noexcept {
    std::vector<T>().swap(vector);
}

} // namespace geodisk
