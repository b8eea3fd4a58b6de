// The types that numbers have in binary files.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

#include "files/byte_order.hpp"

namespace geodisk::tools {

/// Type of the numbers of an array in a file.
struct NumberType {
    std::size_t size = 0;  ///< Bytes of a number.
    bool is_whole = false; ///< Integers of any size.
    bool is_byte = false;  ///< Bytes without sign, as colours have.
    /// Returns the number that begins at `bytes`. A double holds all but large integers exactly.
    double (*value)(const char* bytes, bool is_little) = nullptr;
};

template <typename Value>
inline constexpr NumberType kNumberType{sizeof(Value), std::integral<Value>,
                                        std::same_as<Value, std::uint8_t>, number_of_bytes<Value>};

} // namespace geodisk::tools
