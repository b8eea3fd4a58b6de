// The hash FNV-1a, and hashes as text.
#pragma once

#include <cstdint>
#include <string>

namespace geodisk::detail {

/// FNV-1a with 64 bits.
class Fnv1a {
  public:
    /// Adds a byte, or a wider unit of text.
    void add(std::uint64_t unit) { hash_ = (hash_ ^ unit) * 0x100000001b3; }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// Returns 16 hexadecimal digits.
inline std::string hexadecimal(std::uint64_t number) {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) {
        digits += "0123456789abcdef"[number >> shift & 15];
    }
    return digits;
}

} // namespace geodisk::detail
