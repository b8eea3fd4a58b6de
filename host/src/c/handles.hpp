// Vulkan's handles as the C API has them: pointers or numbers of 64 bits, by platform.
#pragma once

#include <cstdint>
#include <cstring>

namespace geodisk::c {

template <class Handle>
std::uint64_t number_of(Handle handle) noexcept {
    std::uint64_t number = 0;
    std::memcpy(&number, &handle, sizeof handle);
    return number;
}

template <class Handle>
Handle handle_of(std::uint64_t number) noexcept {
    Handle handle;
    std::memcpy(&handle, &number, sizeof handle);
    return handle;
}

} // namespace geodisk::c
