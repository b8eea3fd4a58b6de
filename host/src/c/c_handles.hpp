// Vulkan handles as the C API passes them: pointers, or 64-bit numbers.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace geodisk::c {

template <class Handle>
std::uint64_t number_of(Handle handle) noexcept {
    if constexpr (std::is_pointer_v<Handle>) {
        return std::bit_cast<std::uintptr_t>(handle);
    } else {
        return handle;
    }
}

template <class Handle>
Handle handle_of(std::uint64_t number) noexcept {
    if constexpr (std::is_pointer_v<Handle>) {
        return std::bit_cast<Handle>(static_cast<std::uintptr_t>(number));
    } else {
        return number;
    }
}

} // namespace geodisk::c
